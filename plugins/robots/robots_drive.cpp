// From a controller's command to wheel rates.
#include "description/world_robots.hpp"
#include "ramp.hpp"

namespace {

using namespace muster;
using description::WorldRobots;

struct RobotsDrive {
  static constexpr auto id = "robots.drive/1";
  static constexpr auto summary = "commands to wheel rates, within a drive's speed and acceleration limits";
  static constexpr auto manual =
      "Forward speed and turn rate become the rates of two wheels. A command beyond the model's max_speed or\n"
      "max_acceleration is scaled: both wheels alike, so that the turning radius stays what was asked. A rate holds\n"
      "at the start of the step, its slope over the step: a backend takes the value at the middle. `noise` is added\n"
      "to each wheel's rate, white and Gaussian, one draw a wheel and tick; a wheel at rest holds. Robots whose\n"
      "model has no differential drive, and robots that nobody commands, are asked for zero.";
  static constexpr auto phase = MUSTER_ACTUATE;
  static constexpr Param params[] = {
      real("noise", 0, 0, 10, "rad/s", "standard deviation of a wheel's rate from the rate asked for").free()};

  // The rates without noise at the end of the step: the next ramp's start.
  struct Reached {
    static constexpr const char* columns = "left[rad/s] right[rad/s] model";
    double left, right, model;  // model: as in description::Model; left of a robot without a drive: 1 after the warning
  };

  explicit RobotsDrive(Setup& s)
      : noise(s.value("noise")),
        stream(s.stream("actuation")),
        robots(s, description::Meshes::skip),
        command(s.read_if_any<Command>("robot/*/command")),
        flight(s.read_if_any<AttitudeThrust>("robot/*/attitude_thrust")),
        drive(s.write<Drive>("robot/*/drive")),
        reached(s.write<Reached>("robot/*/drive_reached")) {}

  void step(const Step& k) const {
    const auto commands = k[command];
    for (std::size_t i = 0; i < k[drive].size(); ++i) {
      const double model = WorldRobots::model_of(k.last(reached)[i].model, i);
      k[drive][i] = {0, 0, 0, 0};
      k[reached][i] = {0, 0, model};
      const auto* motors = robots.drive_of(model);
      if (i >= commands.size() || !k.alive("robot", i)) continue;
      if (motors)
        turn(k, i, commands[i], *motors);
      else
        warn_if_asked(k, i, commands[i]);
    }
  }

  // Once of each robot that nothing can move as it is asked to.
  void warn_if_asked(const Step& k, std::size_t i, const Command& asked) const {
    const auto* robot = robots.of(k[reached][i].model);
    if (!robot || robot->drive || robot->legs) return;
    // A controller of all robots may command flying ones beside those that fly them.
    if (robot->quadrotor && k[flight].size() > 0) return;
    const bool told = k.last(reached)[i].left != 0;
    k[reached][i].left = told || asked.v != 0 || asked.w != 0 ? 1 : 0;
    if (told || k[reached][i].left == 0) return;
    const std::string name(k.name("robot", i));
    const std::string robot_is = "robot '" + name + "' is commanded, but its model '" + robot->name + "' ";
    if (robot->quadrotor) {
      k.warn("robot/" + name, robot_is +
                                  "flies, so that a command of wheels (robot/*/command) does not move it; "
                                  "expected <control.velocity3d robot=\"" +
                                  name + "\"/> and <control.path3d robot=\"" + name + "\" path=\"...\"/>");
      return;
    }
    k.warn("robot/" + name,
           robot_is +
               "has no drive, so that it does not move; expected <muster><differential left=\"\" right=\"\" "
               ".../></muster> in " +
               robot->file + ", or in a file of fittings");
  }

  void turn(const Step& k, std::size_t i, const Command& asked, const description::DifferentialDrive& motors) const {
    const WheelRates from{k.last(reached)[i].left, k.last(reached)[i].right};
    const WheelRates goal{motors.left_rate(asked.v, asked.w), motors.right_rate(asked.v, asked.w)};
    const WheelRates to = ramped(from, limited(goal, motors.max_speed), motors.max_acceleration * k.dt());
    k[drive][i] = {from.left + error(k, i, 0, from.left, to.left), from.right + error(k, i, 1, from.right, to.right),
                   (to.left - from.left) / k.dt(), (to.right - from.right) / k.dt()};
    k[reached][i].left = to.left;
    k[reached][i].right = to.right;
  }

  double error(const Step& k, std::size_t robot, unsigned wheel, double from, double to) const {
    const bool rests = from == 0 && to == 0;
    if (rests || k.expected() || k[noise] == 0) return 0;
    return k[noise] * stream.of(k.key("robot", robot)).normal(k.tick(), wheel);
  }

  Value noise;
  Stream stream;
  WorldRobots robots;
  In<Command> command;
  In<AttitudeThrust> flight;  // by which some controller flies robots
  Out<Drive> drive;
  Out<Reached> reached;
};

}  // namespace

MUSTER_PLUGIN_IS(RobotsDrive)
