// A robot's pose as a frame.
#pragma once

#include <Eigen/Geometry>
#include <muster/tables.hpp>

namespace muster {

inline Eigen::Isometry3d frame_of(const Pose& p) {
  return Eigen::Translation3d(p.x, p.y, p.z) * Eigen::Quaterniond(p.qw, p.qx, p.qy, p.qz);
}

}  // namespace muster
