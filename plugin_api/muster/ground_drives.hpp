// What robots on wheels have beyond two sides: steering, and sideways motion on rollers. Tables of a world that has
// such robots; the rear wheels of a mecanum drive have robot/*/rear_drive (Drive) and robot/*/rear_wheels (Wheels).
#pragma once

namespace muster {

// robot/*/steering: angle of the front axle at the tick's start, positive to the left, and its slope over the tick. A
// circle has the radius wheelbase / tan(angle); each wheel's own angle follows from it.
struct SteeringAngle {
  static constexpr const char* columns = "angle[rad] rate[rad/s]";
  double angle, rate;
};

// robot/*/sideways: commanded speed to the left in the robot's own frame, beside the v and w of robot/*/command.
struct Sideways {
  static constexpr const char* columns = "v[m/s]";
  double v;
};

}  // namespace muster
