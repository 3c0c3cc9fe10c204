// Dead reckoning on legs that do not slip.
#pragma once

#include "description/robot.hpp"

namespace muster {

struct Sides {
  double left, right;  // [m]
};

// Path of each side while six legs turn from one angle to another, each by a small angle. Upright in its gait, the body
// is carried by the tripod with the higher hip. A hip's speed is its leg's rate times its height over the ground,
// whether the leg is on its end or rolls on its arc.
inline Sides walked(const description::LegDrive& drive, const double* from, const double* to) {
  using description::LegDrive;
  const auto height = [&](double angle) {
    return -drive.place(angle, LegDrive::lowest_way(angle, Eigen::Vector3d::UnitZ())).z();
  };
  double held[2] = {0, 0};
  for (std::size_t i = 0; i < LegDrive::count; ++i) held[drive.legs[i].tripod] += height((from[i] + to[i]) / 2);
  const int carries = held[1] > held[0] ? 1 : 0;
  double way[2] = {0, 0};
  int legs[2] = {0, 0};
  for (std::size_t i = 0; i < LegDrive::count; ++i) {
    if (drive.legs[i].tripod != carries) continue;
    const int right = drive.legs[i].hip.y() < 0;
    way[right] += (to[i] - from[i]) * (height(from[i]) + 4 * height((from[i] + to[i]) / 2) + height(to[i])) / 6;
    ++legs[right];
  }
  return {way[0] / legs[0], way[1] / legs[1]};
}

}  // namespace muster
