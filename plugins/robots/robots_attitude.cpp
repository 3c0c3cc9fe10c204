// The controller on board a quadrotor: from a controller's command to rotors' rates.
#include "attitude_law.hpp"
#include "description/world_robots.hpp"

namespace {

using namespace muster;
using description::WorldRobots;

struct RobotsAttitude {
  static constexpr auto id = "robots.attitude/1";
  static constexpr auto summary = "thrust, roll, pitch and turn rate to the rates of four rotors";
  static constexpr auto manual =
      "The attitude controller on board of each quadrotor, at the instance's own rate: a world of dt=\"0.001\" gives "
      "it\n"
      "1 kHz, `every` divides that. Its rates hold over the period; the sampling delays them by half of it. Gains are\n"
      "the model's: a PID on the shortest turn from how the body stands to the roll and pitch asked for, with the "
      "body's\n"
      "rates as derivative, and a PI on the turn rate about the body's z axis, both in angular acceleration, so that\n"
      "inertia does not change the response. What rotors cannot give gives way in this order: turning, thrust, roll "
      "and\n"
      "pitch. Integrals stop where they ask for as much as an error of 0.2 rad does. Attitude and rates are true: an\n"
      "ideal inertial unit. A robot that nobody commands, or that is asked for no thrust, has its rotors stand. Other\n"
      "robots have no rotors: zero.";
  static constexpr auto phase = MUSTER_ACTUATE;

  struct Integral {
    static constexpr const char* columns = "roll[rad*s] pitch[rad*s] turn[rad] model";
    double roll, pitch, turn, model;  // integrals of the errors; model: as in description::Model
  };

  explicit RobotsAttitude(Setup& s)
      : robots(s, description::Meshes::skip),
        command(s.read_if_any<AttitudeThrust>("robot/*/attitude_thrust")),
        pose(s.read<Pose>("robot/*/pose")),
        twist(s.read<Twist>("robot/*/twist")),
        rotor_drive(s.write<RotorDrive>("robot/*/rotor_drive")),
        integral(s.write<Integral>("robot/*/attitude_integral")) {
    for (std::size_t row = 0; row < robots.size(); ++row) {
      const auto* robot = robots.of(WorldRobots::model_of(0, row));
      inertia.emplace_back(robot ? whole_mass(*robot).inertia : Eigen::Matrix3d::Zero().eval());
    }
  }

  void step(const Step& k) const {
    const auto commands = k[command];
    for (std::size_t i = 0; i < k[rotor_drive].size(); ++i) {
      const double model = WorldRobots::model_of(k.last(integral)[i].model, i);
      k[rotor_drive][i] = {0, 0, 0, 0};
      k[integral][i] = {0, 0, 0, model};
      const auto* drive = robots.quadrotor_of(model);
      if (drive && i < commands.size() && k.alive("robot", i)) turn(k, i, commands[i], *drive);
    }
  }

  void turn(const Step& k, std::size_t i, const AttitudeThrust& asked, const description::Quadrotor& drive) const {
    const Pose& p = k[pose][i];
    const Twist& t = k[twist][i];
    const Integral& before = k.last(integral)[i];
    const double model = k[integral][i].model;
    const Eigen::Quaterniond q(p.qw, p.qx, p.qy, p.qz);
    const Eigen::Vector3d w = q.conjugate() * Eigen::Vector3d(t.wx, t.wy, t.wz);
    Eigen::Vector3d sums(before.roll, before.pitch, before.turn);
    const AttitudeLaw law{drive, inertia[static_cast<std::size_t>(model) - 1]};
    const auto rates = law.step(asked, q, w, sums, k.dt());
    k[rotor_drive][i] = {rates[0], rates[1], rates[2], rates[3]};
    k[integral][i] = {sums.x(), sums.y(), sums.z(), model};
  }

  WorldRobots robots;
  In<AttitudeThrust> command;
  In<Pose> pose;
  In<Twist> twist;
  Out<RotorDrive> rotor_drive;
  Out<Integral> integral;
  std::vector<Eigen::Matrix3d> inertia;  // of each model, about its centre of mass
};

}  // namespace

MUSTER_PLUGIN_IS(RobotsAttitude)
