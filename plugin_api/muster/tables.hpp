// The rows of the standard tables. The columns string is the type: reader and writer must agree on it.
// SI units, radians, world frame ENU, body frame FLU (REP-103), quaternions w first and body to world.
#pragma once

namespace muster {

struct Pose {
  static constexpr const char* columns = "x[m] y[m] z[m] qw qx qy qz";
  double x, y, z, qw, qx, qy, qz;
};

// Velocity of the body's origin and angular velocity, both in the world frame.
struct Twist {
  static constexpr const char* columns = "vx[m/s] vy[m/s] vz[m/s] wx[rad/s] wy[rad/s] wz[rad/s]";
  double vx, vy, vz, wx, wy, wz;
};

// Command to a ground robot (Player's position2d): forward speed and turn rate in its own frame.
struct Command {
  static constexpr const char* columns = "v[m/s] w[rad/s]";
  double v, w;
};

// Command to a car: speed, and steering angle of the front wheels, positive to the left.
struct CarCommand {
  static constexpr const char* columns = "v[m/s] steering[rad]";
  double v, steering;
};

// Goal pose of a ground robot in its odometry frame, heading optional (null). x null: no goal.
struct Goal2d {
  static constexpr const char* columns = "x[m]? y[m]? yaw[rad]?";
  double x, y, yaw;
};

// Commanded wheel rates and their slopes: a backend takes the value at the middle of its step.
struct Drive {
  static constexpr const char* columns = "left[rad/s] right[rad/s] left_rate[rad/s2] right_rate[rad/s2]";
  double left, right, left_rate, right_rate;
};

// Wheel state: angle since the start, and rate.
struct Wheels {
  static constexpr const char* columns = "left[rad] right[rad] left_rate[rad/s] right_rate[rad/s]";
  double left, right, left_rate, right_rate;
};

// Commanded leg angles at the tick's start and their slopes over it, six legs in the order of the robot's model.
struct Gait {
  static constexpr const char* columns =
      "angle1[rad] angle2[rad] angle3[rad] angle4[rad] angle5[rad] angle6[rad] "
      "rate1[rad/s] rate2[rad/s] rate3[rad/s] rate4[rad/s] rate5[rad/s] rate6[rad/s]";
  double angle[6], rate[6];
};

// Leg state: angle since the start, rate, and motor torque as a mean over the last step.
struct Legs {
  static constexpr const char* columns =
      "angle1[rad] angle2[rad] angle3[rad] angle4[rad] angle5[rad] angle6[rad] "
      "rate1[rad/s] rate2[rad/s] rate3[rad/s] rate4[rad/s] rate5[rad/s] rate6[rad/s] "
      "torque1[N*m] torque2[N*m] torque3[N*m] torque4[N*m] torque5[N*m] torque6[N*m]";
  double angle[6], rate[6], torque[6];
};

// Pose and speed of a robot, estimated from its wheels.
struct Odometry {
  static constexpr const char* columns = "x[m] y[m] yaw[rad] v[m/s] w[rad/s]";
  double x, y, yaw, v, w;
};

// New start of a robot's odometry: applied once, each time that `count` changes.
struct OdometryReset {
  static constexpr const char* columns = "x[m] y[m] yaw[rad] count";
  double x, y, yaw, count;
};

// Stall of a robot's motors, which fail to turn its wheels (Player's position2d).
struct Stall {
  static constexpr const char* columns = "stalled";
  double stalled;  // 0 or 1
};

// Bounding box of a robot with every joint at zero: its middle in the robot's frame, and its edges along x, y, z.
struct Geometry {
  static constexpr const char* columns = "x[m] y[m] z[m] length[m] width[m] height[m]";
  double x, y, z, length, width, height;
};

// One laser scan: ranges as doubles, counter-clockwise from `min_angle` on and `step` apart in the x-y plane of the
// laser's frame. No echo within `max_range` is infinite, anything nearer than `min_range` is minus infinity (REP 117).
// `sensor` counts the lasers of the robot's model from 0, `id` the scans of that laser that were due before. x, y, yaw:
// the robot's odometry pose; null without odometry. The rest is the laser's pose in the robot's frame.
struct Scan {
  static constexpr const char* columns =
      "robot:robot sensor id t[s] x[m]? y[m]? yaw[rad]? at_x[m] at_y[m] at_z[m] qw qx qy qz min_angle[rad] step[rad] "
      "min_range[m] max_range[m] ranges{}";
  static constexpr unsigned payload_column = 18;
  double robot, sensor, id, t, x, y, yaw, at_x, at_y, at_z, qw, qx, qy, qz, min_angle, step, min_range, max_range,
      ranges;
};

// Command to a flying robot (attitude_thrust): sum of its rotors' thrusts, roll and pitch of its body (about x, then y,
// of axes that have its heading), and turn rate about its own z axis.
struct AttitudeThrust {
  static constexpr const char* columns = "thrust[N] roll[rad] pitch[rad] yaw_rate[rad/s]";
  double thrust, roll, pitch, yaw_rate;
};

// Commanded velocity in the world's frame, its feed-forward acceleration, and a turn rate.
struct Velocity3d {
  static constexpr const char* columns = "vx[m/s] vy[m/s] vz[m/s] yaw_rate[rad/s] ax[m/s2] ay[m/s2] az[m/s2]";
  double vx, vy, vz, yaw_rate, ax, ay, az;
};

// Measured pose and velocity of a robot (Player's position3d): roll, pitch, yaw turn it about x, y and z, in this
// order; the velocity is in the world's frame.
struct Position3d {
  static constexpr const char* columns = "x[m] y[m] z[m] roll[rad] pitch[rad] yaw[rad] vx[m/s] vy[m/s] vz[m/s]";
  double x, y, z, roll, pitch, yaw, vx, vy, vz;
};

// Commanded rates of four rotors, held over the tick.
struct RotorDrive {
  static constexpr const char* columns = "front[rad/s] left[rad/s] back[rad/s] right[rad/s]";
  double front, left, back, right;
};

// Rotor state.
struct Rotors {
  static constexpr const char* columns = "front[rad/s] left[rad/s] back[rad/s] right[rad/s]";
  double front, left, back, right;
};

struct Loss {
  static constexpr const char* columns = "loss[dB]";
  double loss;
};

// Colour of a material, each share from 0 to 1.
struct Colouring {
  static constexpr const char* columns = "red green blue";
  double red, green, blue;
};

struct Wall {
  static constexpr const char* columns = "x0[m] y0[m] x1[m] y1[m] base[m] height[m] thickness[m] material:material";
  double x0, y0, x1, y1, base, height, thickness, material;
};

// A gap in a wall, `at` metres from the wall's first end; closed, it is of `material`, or of the wall's own if null.
struct Door {
  static constexpr const char* columns = "wall:wall at[m] width[m] height[m] material:material?";
  double wall, at, width, height, material;
};

struct DoorState {
  static constexpr const char* columns = "open";
  double open;  // 0 or 1
};

// Mounting of a radio: on a robot (a place in its body frame), or, with no robot, in the world.
struct Mount {
  static constexpr const char* columns = "robot:robot? x[m] y[m] z[m] yaw[rad]";
  double robot, x, y, z, yaw;
};

// An endpoint is a radio at a place and time: live, or one end of a measured reading.
struct Endpoint {
  static constexpr const char* columns = "radio:radio t[s]";
  double radio, t;
};

// A link: its two endpoints' row numbers, grouped by sender.
struct Ends {
  static constexpr const char* columns = "tx:endpoint rx:endpoint";
  double tx, rx;
};

// Mean received level: the sum of the terms of a channel in dB.
struct Level {
  static constexpr const char* columns = "level[dBm]";
  double level;
};

// Small-scale fading as a factor on received power, of mean one.
struct Fading {
  static constexpr const char* columns = "gain";
  double gain;
};

// RSSI as the receiver's hardware reports it; null: nothing was received.
struct Rssi {
  static constexpr const char* columns = "rssi[dBm]?";
  double rssi;
};

// A request to send; `to` is null for a broadcast.
struct Outgoing {
  static constexpr const char* columns = "radio:radio to:radio? payload{}";
  static constexpr unsigned payload_column = 2;
  double radio, to, payload;
};

// A received message; the receiving side fills all but the payload. lqi is link quality from 0 to 255; null where a
// network has none.
struct Incoming {
  static constexpr const char* columns = "radio:radio from:radio rssi[dBm] t_sent[s] t_received[s] lqi? payload{}";
  static constexpr unsigned payload_column = 6;
  double radio, from, rssi, t_sent, t_received, lqi, payload;
};

// Outcomes of a radio's requests: copies asked for (one a receiver of a broadcast) and how they ended; the rest are
// still under way. Each network defines which outcomes occur.
struct Traffic {
  static constexpr const char* columns = "asked delivered too_weak no_link collided no_access queue_full no_ack gone";
  double asked, delivered, too_weak, no_link, collided, no_access, queue_full, no_ack, gone;
};

}  // namespace muster
