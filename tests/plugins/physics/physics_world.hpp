// Worlds from text, with a physics backend each.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "tests/run_world.hpp"

namespace muster::test {

inline Simulation world_of(const Folder& folder, const std::string& inside, int workers = 1,
                           const std::string& dt = "0.01") {
  const auto file = folder.write(
      "world.xml", "<world name=\"test\" dt=\"" + dt + "\" until=\"600\" seed=\"1\">" + inside + "</world>");
  return {read_world(file, standard()), standard(), options(workers)};
}

inline void run_to(Simulation& run, uint64_t tick) {
  while (run.tick() < tick) run.step();
}

inline InstanceDeclaration instance(const std::string& plugin,
                                    const std::map<std::string, std::string>& attributes = {}) {
  InstanceDeclaration made;
  made.plugin = plugin;
  for (const auto& [name, value] : attributes) made.attributes.push_back({name, value, {}, {}});
  return made;
}

inline const char* two_scarabs =
    R"(<robot name="a" at="0 0 0" heading="0.3"/><robot name="b" at="3 1 0" heading="2"/>)";

}  // namespace muster::test
