// Worlds of toy plugins, written into a folder of their own and run.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <string>
#include <vector>

#include "kernel/simulation.hpp"
#include "tests/folder.hpp"

namespace muster {

class ToyWorld : public testing::Test {
 protected:
  std::filesystem::path put(const std::string& name, const std::string& bytes) const {
    return temporary.write(name, bytes);
  }

  // The first of `elements` is in line 2; dt is 0.5 s.
  World world(const std::string& elements,
              const std::string& attributes = "dt=\"0.5\" until=\"1000\" seed=\"7\"") const {
    return read_world(put("world.xml", "<world " + attributes + ">\n" + elements + "</world>\n"), standard());
  }
  Options options(int workers = 1) const { return {{folder, MUSTER_BUILD_DIR "/tests/toys"}, workers, {}}; }
  Simulation run(const std::string& elements, int workers = 1) const {
    return {world(elements), standard(), options(workers)};
  }

  // The message of the Error that a call throws, without the folder, and with the exit code in front unless it is 2.
  template <class Call>
  std::string error_of(Call&& call) const {
    try {
      call();
    } catch (const Error& e) {
      const std::string text = temporary.inside(e.what());
      return (e.exit() == Exit::invalid_input ? "" : std::to_string(static_cast<int>(e.exit())) + ' ') + text;
    }
    return "no error";
  }
  std::string error_of_world(const std::string& elements) const {
    return error_of([&] { run(elements); });
  }

  const test::Folder temporary;
  const std::filesystem::path& folder = temporary.path();
};

inline void step(Simulation& run, int ticks = 1) {
  for (int i = 0; i < ticks; ++i) run.step();
}

inline double cell(const Simulation& run, const std::string& table, std::size_t column = 0, std::size_t row = 0) {
  return run.table(table).at(row, column);
}

// A whole column.
inline std::vector<double> column(const Simulation& run, const std::string& table, std::size_t number = 0) {
  const TableView view = run.table(table);
  std::vector<double> result;
  for (std::size_t r = 0; r < view.rows(); ++r) result.push_back(view.at(r, number));
  return result;
}

using Attributes = std::vector<std::pair<std::string, std::string>>;

// <plugin name="name" .../>, as the command line makes one.
inline InstanceDeclaration instance(const std::string& plugin, const std::string& name,
                                    const Attributes& attributes = {}, uint64_t every = 1) {
  InstanceDeclaration result{plugin, name, every, {}, {}, {}, {"command line"}};
  for (const auto& [key, value] : attributes)
    result.attributes.push_back({key, value, {"command line"}, {"command line"}});
  return result;
}

inline std::vector<std::string> messages(const Simulation& run) {
  std::vector<std::string> result;
  for (const auto& event : run.events())
    result.push_back(std::to_string(event.tick) + ' ' + event.instance + ": " + event.message);
  return result;
}

inline bool same_bits(double a, double b) { return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b); }

inline const std::string two_robots = "<robot name=\"a\" at=\"1 0 0\"/>\n<robot name=\"b\" at=\"2 0 0\"/>\n";
inline const std::string pose = "x[m] y[m] z[m] qw qx qy qz";
inline const std::string twist = "vx[m/s] vy[m/s] vz[m/s] wx[rad/s] wy[rad/s] wz[rad/s]";

}  // namespace muster
