// A robot on two wheels driven like a car: Player's car-like commands.
#include <algorithm>
#include <cmath>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct ControlCar {
  static constexpr auto id = "control.car/1";
  static constexpr auto summary = "drives a robot as a car would go, by speed and steering angle";
  static constexpr auto manual =
      "The turn rate is that of a car whose axles are `wheel_base` apart and whose front wheels are turned by the\n"
      "angle asked for, at most `max_steering`: v tan(steering) / wheel_base, about the middle of the rear axle.\n"
      "Standing, it does not turn.";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {reference("robot", "robot", "the robot it steers").required(),
                                     real("wheel_base", 0.3, 0.001, 100, "m", "between the axles"),
                                     real("max_steering", 0.6, 0.001, 1.5, "rad", "of the front wheels")};

  explicit ControlCar(Setup& s)
      : wheel_base(s.value("wheel_base")),
        max_steering(s.value("max_steering")),
        asked(s.read<CarCommand>("robot/{robot}/car_command")),
        command(s.write<Command>("robot/{robot}/command")) {}

  void step(const Step& k) const {
    const double steering = std::clamp(k[asked]->steering, -k[max_steering], k[max_steering]);
    *k[command] = {k[asked]->v, k[asked]->v * std::tan(steering) / k[wheel_base]};
  }

  Value wheel_base, max_steering;
  In<CarCommand> asked;
  Out<Command> command;
};

}  // namespace

MUSTER_PLUGIN_IS(ControlCar)
