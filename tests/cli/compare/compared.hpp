// muster compare as a user calls it, on worlds of a line or two.
#pragma once

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/errors/program.hpp"

namespace muster::test {

// A robot that drives east for 4 s at 0.3 m/s.
inline std::string drive_world(const std::string& more = "", const std::string& attributes = "seed=\"1\"") {
  return "<world name=\"line\" dt=\"0.05\" until=\"4\" " + attributes +
         "><robot name=\"r\" at=\"0 0 0\"/><physics.planar name=\"physics\"/>"
         "<control.waypoint name=\"steer\" robot=\"r\" path=\"way.csv\" speed=\"0.3\"/>" +
         more + "</world>";
}

struct CompareFolder : ProgramFolder {
  CompareFolder() { write("way.csv", "x[m],y[m]\n100,0\n"); }

  nlohmann::json json(std::vector<std::string> words) const {
    words.insert(words.begin(), "compare");
    words.emplace_back("--json");
    const auto outcome = muster(words);
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }
};

// The course of a number of a row; null if it does not differ.
inline nlohmann::json course(const nlohmann::json& comparison, const std::string& table, const std::string& row,
                             const std::string& quantity) {
  for (const auto& one : comparison["differences"]) {
    if (one["table"] == table && one["row"] == row && one["quantity"] == quantity) return one;
  }
  return nullptr;
}

}  // namespace muster::test
