// Runs of worlds/target_tracking, reference [23] of the seed.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "plugins/tracking/navigation_function.hpp"
#include "tests/run_world.hpp"

namespace muster::test {

// As in plugins/tracking/observe_target.cpp.
struct Estimate {
  double x, y, vx, vy, pp, pv, vv, error, heard, silence;
};

inline World tracking_world(bool aware, uint64_t seed) {
  const auto folder = std::filesystem::path(MUSTER_SOURCE_DIR) / "worlds/target_tracking";
  World world = read_world(folder / (aware ? "world.xml" : "unaware.xml"), standard());
  world.seed = seed;
  return world;
}

class Tracked : public Simulation {
 public:
  explicit Tracked(bool aware, uint64_t seed = 1)
      : Simulation(tracking_world(aware, seed), standard(), {{MUSTER_PLUGINS_DIR}, 1, {}}) {}
  Estimate known() const { return row<Estimate>(*this, "instance/known/estimate"); }
  tracking::Vector2 place(const std::string& robot) const {
    const Pose p = row<Pose>(*this, "robot/" + robot + "/pose");
    return {p.x, p.y};
  }
  // Share of the scouts' messages that did not arrive.
  double lost() const {
    double asked = 0, delivered = 0;
    for (const char* scout : {"scout1", "scout2", "scout3"}) {
      const Traffic t = row<Traffic>(*this, std::string("radio/") + scout + "/traffic");
      asked += t.asked, delivered += t.delivered;
    }
    return 1 - delivered / asked;
  }
};

}  // namespace muster::test
