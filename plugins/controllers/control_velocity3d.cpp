// Velocity controller of a flying robot: commands thrust, roll and pitch.
#include <algorithm>
#include <cmath>

#include "description/world_robots.hpp"
#include "robot_model.hpp"

namespace {

using namespace muster;
using description::WorldRobots;

struct ControlVelocity3d {
  static constexpr auto id = "control.velocity3d/1";
  static constexpr auto summary = "flies a quadrotor at the velocity asked for";
  static constexpr auto manual =
      "The acceleration wanted is `p` for each m/s that position3d is off velocity3d, `i` for each metre of its "
      "integral, and\n"
      "what velocity3d says of acceleration. The force for it, against weight and the rotors' drag, by the model's "
      "mass "
      "and\n"
      "constants, gives roll and pitch at the heading that is seen, at most `max_tilt` from upright; thrust is its "
      "part "
      "along\n"
      "the rotors' axes as the body stands. The integral stops while the tilt is at its limit.";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {reference("robot", "robot", "the robot it flies").required(),
                                     real("p", 4, 0, 100, "1/s", "acceleration for each m/s"),
                                     real("i", 1, 0, 100, "1/s2", "and for each m"),
                                     real("max_tilt", 0.6, 0.01, 1.5, "rad", "of the rotors' axes from upright")};

  struct Integral {
    static constexpr const char* columns = "x[m] y[m] z[m]";
    double x, y, z;  // integrals of the velocity error
  };

  explicit ControlVelocity3d(Setup& s)
      : p(s.value("p")),
        i(s.value("i")),
        max_tilt(s.value("max_tilt")),
        seen(s.read<Position3d>("robot/{robot}/position3d")),
        asked(s.read<Velocity3d>("robot/{robot}/velocity3d")),
        command(s.write<AttitudeThrust>("robot/{robot}/attitude_thrust")),
        integral(s.write<Integral>("self/integral")) {
    const WorldRobots robots(s, description::Meshes::skip);
    const double model = s.param("robot") + 1;
    const auto* drive = robots.quadrotor_of(model);
    if (!drive)
      throw BadInput(model_in_words(s) + " has no rotors (<muster>, <quadrotor>) and does not fly; expected " +
                     (robots.drive_of(model) || robots.legs_of(model) ? "<control.waypoint/>, which drives"
                                                                      : "rotors in its model") +
                     or_a_model(s, "<quadrotor", "flies"));
    mass = whole_mass(*robots.of(model)).mass;
    drag = drive->hover_drag(mass * gravity);
  }

  void step(const Step& k) const {
    const Position3d& here = *k[seen];
    const Velocity3d& goal = *k[asked];
    const Integral& sum = *k.last(integral);
    const double error[] = {goal.vx - here.vx, goal.vy - here.vy, goal.vz - here.vz};
    double fx = mass * (k[p] * error[0] + k[i] * sum.x + goal.ax) + drag * goal.vx;
    double fy = mass * (k[p] * error[1] + k[i] * sum.y + goal.ay) + drag * goal.vy;
    const double lift = mass * (k[p] * error[2] + k[i] * sum.z + goal.az + gravity);
    const double fz = std::max(lift, least_lift * mass * gravity);  // it descends without turning upside down

    const double sideways = std::hypot(fx, fy), most = fz * std::tan(k[max_tilt]);
    const bool limited = sideways > most;
    if (limited) fx *= most / sideways, fy *= most / sideways;
    const double dt = limited ? 0 : k.dt();
    *k[integral] = {sum.x + error[0] * dt, sum.y + error[1] * dt, sum.z + error[2] * dt};
    *k[command] = {along_axes(here, fx, fy, fz), roll(here.yaw, fx, fy, fz), pitch(here.yaw, fx, fy, fz),
                   goal.yaw_rate};
  }

  // Component of the force along the rotors' axes.
  static double along_axes(const Position3d& at, double fx, double fy, double fz) {
    const double cr = std::cos(at.roll), sr = std::sin(at.roll), sp = std::sin(at.pitch), cp = std::cos(at.pitch);
    const double cy = std::cos(at.yaw), sy = std::sin(at.yaw);
    return fx * (cy * sp * cr + sy * sr) + fy * (sy * sp * cr - cy * sr) + fz * cp * cr;
  }
  static double roll(double yaw, double fx, double fy, double fz) {
    return std::asin((fx * std::sin(yaw) - fy * std::cos(yaw)) / std::hypot(fx, fy, fz));
  }
  static double pitch(double yaw, double fx, double fy, double fz) {
    return std::atan2(fx * std::cos(yaw) + fy * std::sin(yaw), fz);
  }

  static constexpr double gravity = 9.81;     // [m/s2]
  static constexpr double least_lift = 0.25;  // of the weight

  Value p, i, max_tilt;
  In<Position3d> seen;
  In<Velocity3d> asked;
  Out<AttitudeThrust> command;
  Out<Integral> integral;
  double mass = 0, drag = 0;  // [kg], [N s/m]
};

}  // namespace

MUSTER_PLUGIN_IS(ControlVelocity3d)
