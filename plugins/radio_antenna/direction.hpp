// Directions in an antenna's frame: x along the lobe, y to its left, z up.
#pragma once

#include <algorithm>
#include <cmath>
#include <muster/tables.hpp>

namespace muster {

constexpr double half_turn = 3.141592653589793;

// A unit vector; all zero for no direction.
struct Direction {
  double x, y, z;
};

inline double azimuth(const Direction& d) { return std::atan2(d.y, d.x); }
inline double elevation(const Direction& d) { return std::asin(std::clamp(d.z, -1.0, 1.0)); }

// From one antenna to the other, in the world. No direction if both are in one place.
inline Direction from_to(const Pose& from, const Pose& to) {
  const double x = to.x - from.x, y = to.y - from.y, z = to.z - from.z, length = std::sqrt(x * x + y * y + z * z);
  if (length == 0) return {0, 0, 0};
  return {x / length, y / length, z / length};
}

// A direction in the world, transformed to the frame of a body: v + 2 u x (u x v - w v) for its quaternion (w, u).
inline Direction in_frame(const Pose& body, const Direction& v) {
  const double cx = body.qy * v.z - body.qz * v.y - body.qw * v.x;
  const double cy = body.qz * v.x - body.qx * v.z - body.qw * v.y;
  const double cz = body.qx * v.y - body.qy * v.x - body.qw * v.z;
  return {v.x + 2 * (body.qy * cz - body.qz * cy), v.y + 2 * (body.qz * cx - body.qx * cz),
          v.z + 2 * (body.qx * cy - body.qy * cx)};
}

// Orientation of an antenna on its radio: by `azimuth` to the left, then by `elevation` upward, then by `roll` about
// its own x axis. The place is left at zero.
inline Pose turn(double azimuth, double elevation, double roll) {
  const double ca = std::cos(azimuth / 2), sa = std::sin(azimuth / 2);
  const double ce = std::cos(elevation / 2), se = -std::sin(elevation / 2);  // about y, downward is positive
  const double cr = std::cos(roll / 2), sr = std::sin(roll / 2);
  return {0,
          0,
          0,
          ca * ce * cr + sa * se * sr,
          ca * ce * sr - sa * se * cr,
          ca * se * cr + sa * ce * sr,
          sa * ce * cr - ca * se * sr};
}

// The mean over all directions of value(direction), by the midpoint rule over the sphere's height and azimuth: fine
// enough for lobes from 0.1 rad.
template <class Value>
double mean_over_sphere(const Value& value) {
  constexpr int heights = 256, turns = 256;
  double sum = 0;
  for (int i = 0; i < heights; ++i) {
    const double z = (2 * i + 1.0) / heights - 1, across = std::sqrt(1 - z * z);
    for (int j = 0; j < turns; ++j) {
      const double turned = (2 * j + 1.0) / turns * half_turn;
      sum += value(Direction{across * std::cos(turned), across * std::sin(turned), z});
    }
  }
  return sum / (heights * turns);
}

}  // namespace muster
