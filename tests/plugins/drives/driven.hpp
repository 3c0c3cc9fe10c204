// A world with one robot on a backend, and runs that must have the same bits.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <muster/ground_drives.hpp>
#include <string>

#include "description/robot.hpp"
#include "tests/backends.hpp"
#include "tests/run_world.hpp"

namespace muster::test {

inline const std::vector<const char*> backends =
    built({"physics.planar", "physics.simbody", "physics.ode", "physics.mujoco"});
inline const std::string models = MUSTER_SOURCE_DIR "/plugins/robots/models/";

inline std::string name_of(const testing::TestParamInfo<const char*>& made) {
  return std::string(made.param).substr(8);
}

inline double yaw_of(const Pose& p) {
  return std::atan2(2 * (p.qw * p.qz + p.qx * p.qy), 1 - 2 * (p.qy * p.qy + p.qz * p.qz));
}

inline Simulation driven(const Folder& folder, const std::string& model, const std::string& physics,
                         const std::string& inside, const std::string& more = "", const std::string& dt = "0.01") {
  const auto file = folder.write(
      "world.xml", "<world name=\"w\" dt=\"" + dt + "\" until=\"600\" seed=\"1\"><robot name=\"r\" model=\"" + model +
                       "\" at=\"0 0 0\"/><" + physics + " name=\"physics\"" + more + "/>" + inside + "</world>");
  return {read_world(file, standard()), standard(), options()};
}

inline void run_to(Simulation& run, double time) {
  while (run.time() < time - 1e-9) run.step();
}

// A model of the project's with the first text of each pair replaced by the second, as changed_NAME.urdf of the folder.
inline std::string model_with(const Folder& folder, const std::string& name,
                              const std::vector<std::pair<std::string, std::string>>& changes) {
  std::ifstream file(models + name + ".urdf");
  std::string urdf{std::istreambuf_iterator<char>(file), {}};
  for (const auto& [was, is] : changes) {
    const auto at = urdf.find(was);
    if (at == std::string::npos) throw std::runtime_error("the model lacks " + was);
    urdf.replace(at, was.size(), is);
  }
  folder.write("changed_" + name + ".urdf", urdf);
  return "changed_" + name + ".urdf";
}

// The fault of a changed model, from its line on.
inline std::string fault(const std::string& name, const std::vector<std::pair<std::string, std::string>>& changes) {
  const Folder folder;
  const std::string file = model_with(folder, name, changes);
  try {
    description::read_robot((folder / file).string());
    return "nothing was thrown";
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();
    return what.substr(what.find(".urdf:") + 6);
  }
}

// Straight on; restored half way; remade now and then: the same bits.
inline void expect_same_bits(const Folder& folder, const std::function<Simulation()>& begun) {
  Simulation straight = begun();
  run_to(straight, 1);
  straight.snapshot().save(folder / "then");
  run_to(straight, 2);
  Simulation restored = begun();
  restored.restore(Snapshot::load(folder / "then"));
  run_to(restored, 2);
  EXPECT_EQ(straight.digest(), restored.digest());
  Simulation remade = begun();
  while (remade.tick() < straight.tick()) {
    if (remade.tick() % 17 == 5) remade.remake("physics");
    remade.step();
  }
  EXPECT_EQ(straight.digest(), remade.digest());
}

}  // namespace muster::test
