// The connectivity world in tests: what its chain looks like.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "tests/plugins/robots/robot_world.hpp"

namespace muster::test {

// As observe.chain writes it; a link is named by its further end.
struct ChainLink {
  double level, rssi, smooth, distance, walls, below, share, worst, constant;
};
struct Chain {
  ChainLink follower1, follower2, leader;
  const ChainLink& operator[](std::size_t i) const { return (&follower1)[i]; }
};
inline Chain chain_of(const Simulation& run) { return row<Chain>(run, "instance/chain/chain"); }

// As control.connectivity keeps it.
struct Steering {
  double arclength, parent, child, parent_heard, child_heard, speed;
};
inline Steering steering_of(const Simulation& run, const std::string& instance) {
  return row<Steering>(run, "instance/" + instance + "/state");
}

inline World connectivity(const std::string& file = "world.xml", const std::string& physics = "physics.planar") {
  World world = read_world(std::string(MUSTER_SOURCE_DIR "/worlds/connectivity/") + file, standard());
  for (auto& instance : world.instances) {
    if (instance.name == "physics") instance.plugin = physics;
  }
  return world;
}

inline InstanceDeclaration& instance_of(World& world, const std::string& name) {
  for (auto& instance : world.instances) {
    if (instance.name == name) return instance;
  }
  throw std::runtime_error("no " + name);
}

inline void set(InstanceDeclaration& instance, const std::string& attribute, const std::string& value) {
  for (auto& given : instance.attributes) {
    if (given.name == attribute) return void(given.value = value);
  }
  instance.attributes.push_back({attribute, value, {"test"}, {"test"}});
}

inline void run_until(Simulation& run, double time) {
  while (run.time() < time - 1e-9) run.step();
}

}  // namespace muster::test
