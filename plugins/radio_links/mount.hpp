// The pose of a radio's antenna, from the body that carries it.
#pragma once

#include <cmath>
#include <muster/tables.hpp>

namespace muster {

// The product of two rotations: first b, then a. Places are left at zero.
inline Pose turned(const Pose& a, const Pose& b) {
  return {0,
          0,
          0,
          a.qw * b.qw - a.qx * b.qx - a.qy * b.qy - a.qz * b.qz,
          a.qw * b.qx + a.qx * b.qw + a.qy * b.qz - a.qz * b.qy,
          a.qw * b.qy - a.qx * b.qz + a.qy * b.qw + a.qz * b.qx,
          a.qw * b.qz + a.qx * b.qy - a.qy * b.qx + a.qz * b.qw};
}

// The antenna's pose in the world; `body` is the world's own frame for a radio that does not move.
inline Pose antenna_in_world(const Mount& mount, const Pose& body) {
  Pose result = turned(body, {0, 0, 0, std::cos(mount.yaw / 2), 0, 0, std::sin(mount.yaw / 2)});
  // v + 2 u x (u x v + w v) for the unit quaternion (w, u).
  const double cx = body.qy * mount.z - body.qz * mount.y + body.qw * mount.x;
  const double cy = body.qz * mount.x - body.qx * mount.z + body.qw * mount.y;
  const double cz = body.qx * mount.y - body.qy * mount.x + body.qw * mount.z;
  result.x = body.x + mount.x + 2 * (body.qy * cz - body.qz * cy);
  result.y = body.y + mount.y + 2 * (body.qz * cx - body.qx * cz);
  result.z = body.z + mount.z + 2 * (body.qx * cy - body.qy * cx);
  return result;
}

}  // namespace muster
