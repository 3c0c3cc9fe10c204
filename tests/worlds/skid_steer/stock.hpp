// Worlds of robots as people have them, and the backends on which they run.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <muster/sets.hpp>
#include <string>

#include "tests/backends.hpp"
#include "tests/run_world.hpp"

namespace muster::test {

// A model of the project's own, or a URDF of ../shared/data, which is not part of the project.
struct StockRobot {
  const char* name;
  const char* model;
  const char* fittings = "";
  bool is_shared = false;

  std::string path() const {
    const auto shared = std::filesystem::path(MUSTER_SOURCE_DIR).parent_path() / "shared/data/urdf";
    return is_shared ? (shared / model).string() : model;
  }
  bool is_absent() const { return is_shared && !std::filesystem::exists(path()); }
  std::string element() const {
    return "<robot name=\"r\" model=\"" + path() + "\" fittings=\"" + fittings + "\" at=\"0 0 0\"/>";
  }
};

inline const StockRobot burger{"burger", "turtlebot3_burger.urdf", "burger_fittings.xml", true};
inline const StockRobot bare_burger{"bare_burger", "turtlebot3_burger.urdf", "", true};
inline const StockRobot waffle{"waffle", "waffle"}, husky{"husky", "husky"};
inline const StockRobot husky_like{"husky_like", "husky_like.urdf", "", true};

inline const std::vector<const char*> backends =
    built({"physics.planar", "physics.simbody", "physics.ode", "physics.mujoco"});

inline Simulation stock_world(const Folder& folder, const StockRobot& robot, const std::string& physics,
                              const std::string& inside, const std::string& until) {
  const auto file =
      folder.write("world.xml", "<world name=\"w\" dt=\"0.01\" until=\"" + until + "\" seed=\"1\">" + robot.element() +
                                    "<" + physics + " name=\"physics\"/>" + inside + "</world>");
  return {read_world(file, standard()), standard(), {{MUSTER_PLUGINS_DIR}, 1, {}}};
}

inline double yaw_of(const Pose& p) {
  return std::atan2(2 * (p.qw * p.qz + p.qx * p.qy), 1 - 2 * (p.qy * p.qy + p.qz * p.qz));
}

}  // namespace muster::test
