// From a controller's command to wheel rates.
#include <cmath>
#include <muster/ground_drives.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "description/file_text.hpp"
#include "description/world_robots.hpp"
#include "plugins/periods.hpp"
#include "plugins/world_folder.hpp"
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
      "model has no wheels, and robots that nobody commands, are asked for zero.\n"
      "A car steers by atan(w wheelbase / v) within its limit, and its rear wheels turn at the rates of that circle; "
      "a\n"
      "turn out of reach gives a warning. A mecanum drive also takes robot/*/sideways, a speed to the left.";
  static constexpr auto phase = MUSTER_ACTUATE;
  static constexpr bool keeps_only_caches = true;  // and what it has told
  static constexpr Param params[] = {
      real("noise", 0, 0, 10, "rad/s", "standard deviation of a wheel's rate from the rate asked for").free()};

  // The rates without noise at the end of the step: the next ramp's start.
  struct Reached {
    static constexpr const char* columns = "left[rad/s] right[rad/s] model";
    double left, right, model;  // model: as in description::Model; left of a robot without a drive: 1 after the warning
  };

  // Steering at the end of the step, and 1 after the warning of a turn out of reach.
  struct Steered {
    static constexpr const char* columns = "angle[rad] warned";
    double angle, warned;
  };

  struct RearReached {
    static constexpr const char* columns = "left[rad/s] right[rad/s]";
    double left, right;
  };

  explicit RobotsDrive(Setup& s)
      : noise(s.value("noise")),
        stream(s.stream("actuation")),
        robots(s, description::Meshes::skip),
        folder(world_folder(s.host())),
        command(s.read_if_any<Command>("robot/*/command")),
        flight(s.read_if_any<AttitudeThrust>("robot/*/attitude_thrust")),
        sideways(s.read_if_any<Sideways>("robot/*/sideways")),
        drive(s.write<Drive>("robot/*/drive")),
        reached(s.write<Reached>("robot/*/drive_reached")) {
    if (robots.any_steers()) {
      steering = s.write<SteeringAngle>("robot/*/steering");
      steered = s.write<Steered>("robot/*/steering_reached");
    }
    if (!robots.any_mecanum()) return;
    rear_drive = s.write<Drive>("robot/*/rear_drive");
    rear_reached = s.write<RearReached>("robot/*/rear_drive_reached");
  }

  void step(const Step& k) const {
    const auto commands = k[command];
    for (std::size_t i = 0; i < k[drive].size(); ++i) {
      const double model = WorldRobots::model_of(k.last(reached)[i].model, i);
      k[drive][i] = {0, 0, 0, 0};
      k[reached][i] = {0, 0, model};
      if (steering) {
        k[*steering][i] = {k.last(*steered)[i].angle, 0};  // it stays as it is
        k[*steered][i] = k.last(*steered)[i];
      }
      if (rear_drive) k[*rear_drive][i] = {0, 0, 0, 0}, k[*rear_reached][i] = {0, 0};
      const auto* motors = robots.drive_of(model);
      if (i >= commands.size() || !k.alive("robot", i)) continue;
      if (!motors || !motors->mecanum) warn_of_sideways(k, i);
      if (motors && is_first_step(k.time(), k.dt())) warn_of_slow(k, i, commands[i], *motors);
      if (motors && motors->steering)
        steer(k, i, commands[i], *motors);
      else if (motors && motors->mecanum)
        slide(k, i, commands[i], *motors);
      else if (motors)
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
    if (const std::string others = description::wheels_about_others(*robot); !others.empty())
      return k.warn("robot/" + name, robot_is + "has no drive, so that it does not move: " + beside_the_world(others));
    k.warn("robot/" + name, robot_is + "has no drive, so that it does not move" +
                                beside_the_world(wheels_in_words(*robot)) +
                                "<muster><differential left=\"\" right=\"\" "
                                ".../></muster> in " +
                                beside_the_world(robot->file) + ", or in a file of fittings");
  }

  // Paths of files in the world's folder without it.
  std::string beside_the_world(std::string words) const {
    const std::string begin = folder + '/';
    for (auto at = words.find(begin); at != words.npos; at = words.find(begin, at)) words.erase(at, begin.size());
    return words;
  }

  // Once of each robot that is asked to go sideways and has no rollers.
  void warn_of_sideways(const Step& k, std::size_t i) const {
    const auto* robot = robots.of(k[reached][i].model);
    if (i >= k[sideways].size() || k[sideways][i].v == 0 || !robot) return;
    warned_of_sideways.resize(k[drive].size());
    if (std::exchange(warned_of_sideways[i], 1)) return;
    const std::string name(k.name("robot", i));
    k.warn("robot/" + name, "robot '" + name + "' is commanded to go sideways (robot/" + name +
                                "/sideways), and its model '" + robot->name +
                                "' has no wheels with rollers (<mecanum>), so that it does not; expected a "
                                "controller that turns, such as control.waypoint in place of control.strafe, or a "
                                "model with rollers, such as youbot");
  }

  // Of the first command that is far beyond the drive. One of which the description says itself that it creeps is not
  // told again.
  void warn_of_slow(const Step& k, std::size_t i, const Command& asked,
                    const description::DifferentialDrive& motors) const {
    constexpr double far = 2;
    const double top = motors.max_speed * motors.wheel_radius, v = std::abs(asked.v);
    if (top < description::slowest_drive || v <= far * top) return;
    const std::string name(k.name("robot", i));
    const auto number = [](double value) { return description::print_number(value); };
    k.warn("robot/" + name, "robot '" + name + "' is asked for " + number(v) + " m/s, and its drive reaches " +
                                number(top) + " m/s (max_speed " + number(motors.max_speed) +
                                " rad/s, wheels of radius " + number(motors.wheel_radius) +
                                " m); expected a lower speed of its controller, or max_speed=\"" +
                                number(v / motors.wheel_radius) + "\" in its description; is that in m/s there?");
  }

  static std::string wheels_in_words(const description::Robot& robot) {
    const std::string wheels = description::wheels_that_stand(robot);
    return wheels.empty() ? "; expected "
                          : ": " + wheels + "; expected type=\"continuous\" of them, which makes them its drive, or ";
  }

  void turn(const Step& k, std::size_t i, const Command& asked, const description::DifferentialDrive& motors) const {
    const WheelRates from{k.last(reached)[i].left, k.last(reached)[i].right};
    const WheelRates goal{motors.left_rate(asked.v, asked.w), motors.right_rate(asked.v, asked.w)};
    set(k, i, from, ramped(from, limited(goal, motors.max_speed), motors.max_acceleration * k.dt()));
  }

  void set(const Step& k, std::size_t i, const WheelRates& from, const WheelRates& to) const {
    k[drive][i] = {from.left + error(k, i, 0, from.left, to.left), from.right + error(k, i, 1, from.right, to.right),
                   (to.left - from.left) / k.dt(), (to.right - from.right) / k.dt()};
    k[reached][i].left = to.left;
    k[reached][i].right = to.right;
  }

  // Steering first, then the speed within the outer wheel's limit: so the rear wheels turn at the rates of the circle
  // that the front ones steer.
  void steer(const Step& k, std::size_t i, const Command& asked, const description::DifferentialDrive& motors) const {
    const description::Steering& car = *motors.steering;
    const WheelRates from{k.last(reached)[i].left, k.last(reached)[i].right};
    const Steered& before = k.last(*steered)[i];
    const double wanted = asked.v != 0 ? car.angle(asked.v, asked.w) : before.angle;
    warn_of_reach(k, i, asked, car, wanted);
    const double most = car.max_rate * k.dt(), goal = std::clamp(wanted, -car.limit, car.limit);
    const double angle = before.angle + std::clamp(goal - before.angle, -most, most);
    k[*steering][i] = {before.angle, (angle - before.angle) / k.dt()};
    k[*steered][i].angle = angle;
    const double outer = 1 + std::abs(std::tan(angle)) * motors.wheel_base / (2 * car.wheelbase);
    const double fastest = motors.max_speed * motors.wheel_radius / outer;
    const double change = motors.max_acceleration * k.dt() * motors.wheel_radius / outer;
    const double v = motors.forward(from.left, from.right), to = std::clamp(asked.v, -fastest, fastest);
    const double then = v + std::clamp(to - v, -change, change), w = car.turn(then, angle);
    set(k, i, from, {motors.left_rate(then, w), motors.right_rate(then, w)});
  }

  // Once of each car that is asked for a turn that it cannot make.
  void warn_of_reach(const Step& k, std::size_t i, const Command& asked, const description::Steering& car,
                     double wanted) const {
    constexpr double rounded = 1e-9;  // [rad]
    const bool turns_on_the_spot = asked.v == 0 && asked.w != 0;
    if (k[*steered][i].warned != 0 || (!turns_on_the_spot && std::abs(wanted) <= car.limit + rounded)) return;
    k[*steered][i].warned = 1;
    const std::string name(k.name("robot", i));
    const auto number = [](double value) { return description::print_number(value); };
    k.warn("robot/" + name,
           "robot '" + name + "' is asked for " +
               (turns_on_the_spot ? std::string("a turn on the spot")
                                  : "a circle of radius " + number(std::abs(asked.v / asked.w)) + " m") +
               ", which its steering cannot make; its smallest circle has a radius of " +
               number(car.wheelbase / std::tan(car.limit)) + " m (wheelbase / tan(steering_limit)); it " +
               (turns_on_the_spot ? "stands" : "drives that one"));
  }

  void slide(const Step& k, std::size_t i, const Command& asked, const description::DifferentialDrive& motors) const {
    const Reached& front = k.last(reached)[i];
    const RearReached& rear = k.last(*rear_reached)[i];
    const FourRates from{front.left, front.right, rear.left, rear.right};
    const double across = i < k[sideways].size() ? k[sideways][i].v : 0;
    const FourRates goal = limited(motors.mecanum->rates({asked.v, across, asked.w}), motors.max_speed);
    const FourRates to = ramped(from, goal, motors.max_acceleration * k.dt());
    set(k, i, {from[0], from[1]}, {to[0], to[1]});
    k[*rear_drive][i] = {from[2] + error(k, i, 2, from[2], to[2]), from[3] + error(k, i, 3, from[3], to[3]),
                         (to[2] - from[2]) / k.dt(), (to[3] - from[3]) / k.dt()};
    k[*rear_reached][i] = {to[2], to[3]};
  }

  double error(const Step& k, std::size_t robot, unsigned wheel, double from, double to) const {
    const bool rests = from == 0 && to == 0;
    if (rests || k.expected() || k[noise] == 0) return 0;
    return k[noise] * stream.of(k.key("robot", robot)).normal(k.tick(), wheel);
  }

  Value noise;
  Stream stream;
  WorldRobots robots;
  std::string folder;
  In<Command> command;
  In<AttitudeThrust> flight;  // by which some controller flies robots
  In<Sideways> sideways;
  Out<Drive> drive;
  Out<Reached> reached;
  std::optional<Out<SteeringAngle>> steering;  // where a robot has any
  std::optional<Out<Steered>> steered;
  mutable std::vector<char> warned_of_sideways;  // not of the run's state: after a restore, it is told again
  std::optional<Out<Drive>> rear_drive;
  std::optional<Out<RearReached>> rear_reached;
};

}  // namespace

MUSTER_PLUGIN_IS(RobotsDrive)
