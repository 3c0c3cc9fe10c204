// Limbs of robots: bodies on joints without a motor.
#pragma once

#include <cstddef>

namespace muster {

// State of a limb's joint: angle about a hinge's axis, or way along a slider's. A ball joint has its orientation from
// that at 0, body to joint, and its turn rate relative to its carrier. Both are in the joint's axes at 0. Fields that
// the kind of joint lacks are 0; a quaternion of zeros is the identity.
struct Limb {
  double angle = 0, rate = 0;  // [rad], [rad/s]
  double way = 0, speed = 0;   // [m], [m/s]
  double qw = 0, qx = 0, qy = 0, qz = 0;
  double wx = 0, wy = 0, wz = 0;  // [rad/s]
};

// robot/*/limbs: in the order of the robot's model.
struct Limbs {
  static constexpr std::size_t most = 4;
  static constexpr const char* columns =
      "angle1[rad] rate1[rad/s] way1[m] speed1[m/s] qw1 qx1 qy1 qz1 wx1[rad/s] wy1[rad/s] wz1[rad/s] "
      "angle2[rad] rate2[rad/s] way2[m] speed2[m/s] qw2 qx2 qy2 qz2 wx2[rad/s] wy2[rad/s] wz2[rad/s] "
      "angle3[rad] rate3[rad/s] way3[m] speed3[m/s] qw3 qx3 qy3 qz3 wx3[rad/s] wy3[rad/s] wz3[rad/s] "
      "angle4[rad] rate4[rad/s] way4[m] speed4[m/s] qw4 qx4 qy4 qz4 wx4[rad/s] wy4[rad/s] wz4[rad/s]";
  Limb limb[most];
};

}  // namespace muster
