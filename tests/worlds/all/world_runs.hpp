// The worlds of the tree, and runs of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "kernel/simulation.hpp"

namespace muster::test {

// The files of worlds, by folder and name; of a folder's world.xml, the folder.
inline std::vector<std::string> worlds() {
  std::vector<std::string> result;
  for (const auto& folder : std::filesystem::directory_iterator(MUSTER_SOURCE_DIR "/worlds")) {
    if (!std::filesystem::exists(folder.path() / "world.xml")) continue;
    for (const auto& file : std::filesystem::directory_iterator(folder)) {
      if (file.path().extension() != ".xml") continue;
      const bool is_main = file.path().filename() == "world.xml";
      result.push_back(is_main ? folder.path().filename() : folder.path().filename() / file.path().filename());
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

inline std::filesystem::path place_of(const std::string& world) {
  return std::filesystem::path(MUSTER_SOURCE_DIR "/worlds") / world;
}

// Long enough that each phase has run many times, and that the swap of hot_swap is among them.
constexpr uint64_t most_ticks = 500;

inline Simulation start(const std::string& name, int workers = 1, Isolations isolated = {}) {
  World world = read_world(place_of(name), standard());
  world.ticks = std::min(world.ticks, most_ticks);
  Options options{{MUSTER_PLUGINS_DIR}, workers, {}};
  options.isolated = std::move(isolated);
  return {std::move(world), standard(), std::move(options)};
}

inline void run_until(Simulation& run, uint64_t tick) {
  while (run.tick() < tick) run.step();
}
inline uint64_t finish(Simulation& run) {
  run_until(run, run.world().ticks);
  return run.digest();
}

// The digest of an undisturbed run on one thread.
inline uint64_t plain_digest(const std::string& name) {
  Simulation run = start(name);
  return finish(run);
}

inline std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string result = info.param;
  std::replace_if(
      result.begin(), result.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return result;
}

}  // namespace muster::test
