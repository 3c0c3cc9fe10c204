// Turns as URDF writes them.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "description/file_text.hpp"

namespace muster::description {

// Roll, pitch and yaw as URDF has them: R = Rz(yaw) Ry(pitch) Rx(roll).
inline std::string rpy_text(const Eigen::Matrix3d& r) {
  const auto clean = [](double v) { return print_exactly(std::abs(v) < 1e-12 ? 0 : v); };
  return clean(std::atan2(r(2, 1), r(2, 2))) + " " + clean(std::atan2(-r(2, 0), std::hypot(r(2, 1), r(2, 2)))) + " " +
         clean(std::atan2(r(1, 0), r(0, 0)));
}

}  // namespace muster::description
