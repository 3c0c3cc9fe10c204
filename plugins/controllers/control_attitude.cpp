// Attitude and thrust from a table, such as a pilot's record.
#include <algorithm>
#include <cmath>
#include <limits>
#include <muster/plugin.hpp>
#include <utility>

#include "description/world_robots.hpp"
#include "plugins/periods.hpp"
#include "plugins/table_times.hpp"
#include "robot_model.hpp"

namespace {

using namespace muster;
using description::WorldRobots;

struct ControlAttitude {
  static constexpr auto id = "control.attitude/1";
  static constexpr auto summary = "asks a quadrotor for thrust, roll, pitch and turn rate from a table";
  static constexpr auto manual =
      "The file's columns are t[s],cmd_thrust[N],cmd_roll[rad],cmd_pitch[rad],cmd_yaw_rate[rad/s] and, for a file of\n"
      "several robots, robot; others are not read. Each row holds until the robot's next; before the first there is "
      "no\n"
      "thrust.";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {reference("robot", "robot", "the robot it flies").required(),
                                     file("file", "commands by rising time").required()};

  struct Row {
    static constexpr const char* columns =
        "t[s] robot:robot? cmd_thrust[N] cmd_roll[rad] cmd_pitch[rad] cmd_yaw_rate[rad/s]";
    double t, robot;  // null: the robot that is flown
    AttitudeThrust asked;
  };

  explicit ControlAttitude(Setup& s)
      : robot(s.value("robot")),
        times(s, "file"),
        commands(s.file<Row>("file")),
        command(s.write<AttitudeThrust>("robot/{robot}/attitude_thrust")) {
    const WorldRobots robots(s, description::Meshes::skip);
    const double model = s.param("robot") + 1;
    if (!robots.quadrotor_of(model))
      throw BadInput(model_in_words(s) + " has no rotors (<muster>, <quadrotor>) and does not fly; expected " +
                     "<control.recorded/>, which drives by a table of v and w" + or_a_model(s, "<quadrotor", "flies"));
    weight = description::whole_mass(*robots.of(model)).mass * gravity;
  }

  void step(const Step& k) const {
    const double tick = k.time() / static_cast<double>(k.tick());
    const double now = k.time() - tick / 2;  // commands hold over the tick: of two, that for most of it
    *k[command] = {0, 0, 0, 0};
    const bool is_first = is_first_step(k.time(), k.dt());
    if (is_first) warn_of_units(k);
    double last = -std::numeric_limits<double>::infinity(), second = last, most = 0;  // s, s, N
    std::size_t number = 0, own = 0, first = 0;
    for (const Row& row : k[commands]) {
      ++number;
      if (!is_null(row.robot) && row.robot != k[robot]) continue;
      if (!(row.t > last))
        throw BadInput(times.rows().at(number - 1, "t") + "t does not rise: " + TableTimes::print(row.t) + " s after " +
                       TableTimes::print(last) + " s; expected the rows of a robot in the order of time");
      last = row.t;
      if (++own == 1) first = number - 1;
      if (own <= 2) second = row.t;
      most = std::max(most, row.asked.thrust);
      if (row.t <= now) *k[command] = row.asked;
    }
    if (own == 0) throw BadInput("the file has no commands for it");
    if (is_first && most > 0 && most < little * weight) warn_of_little(k, most, first);
    if (is_first && last >= 0)  // what was asked before the run holds
      times.warn_of(
          k, {k[commands][first].t, second, last, first},
          "the commands of robot '" + std::string(k.name("robot", static_cast<std::size_t>(k[robot]))) + "' are",
          "none is ever given");
  }

  // Warns of the first tilt that is plainly in degrees, and of the first thrust that points down or is no newtons.
  void warn_of_units(const Step& k) const {
    constexpr double quarter_turn = 1.5708, degree = 0.017453292519943295;
    bool is_tilted = false, is_odd = false;
    for (std::size_t i = 0; i < k[commands].size() && !(is_tilted && is_odd); ++i) {
      const Row& row = k[commands][i];
      if (!is_null(row.robot) && row.robot != k[robot]) continue;
      for (const auto& [name, angle] : {std::pair("cmd_roll", row.asked.roll), {"cmd_pitch", row.asked.pitch}}) {
        if (!(std::abs(angle) > quarter_turn) || is_tilted) continue;
        is_tilted = true;
        k.event("warning: " + times.rows().at(i, name) + name + " is " + TableTimes::print(angle) +
                " rad, on its head; are these degrees? " + TableTimes::print(angle) + " degrees are " +
                TableTimes::print(std::round(angle * degree * 1e4) / 1e4) + " rad");
      }
      const double thrust = row.asked.thrust;
      const std::string odd =
          thrust < 0 ? "points down; is it negative upward, as in PX4? "
          : thrust > most_weights * weight
              ? "is " + TableTimes::print(std::round(thrust / weight)) + " times the robot's weight; " + meant(thrust)
              : "";
      if (odd.empty() || is_odd) continue;
      is_odd = true;
      k.event("warning: " + times.rows().at(i, "cmd_thrust") + "cmd_thrust of " + TableTimes::print(thrust) + " N " +
              odd + "expected newtons, positive upward");
    }
  }

  static std::string meant(double thrust) {
    constexpr double least_pulse = 900, most_pulse = 2100;  // us, of radio control
    return thrust >= least_pulse && thrust <= most_pulse
               ? "are these pulses in microseconds, or grams? "
               : "are these grams? " + TableTimes::print(thrust) + " g are " +
                     TableTimes::print(std::round(thrust * gravity) / 1000) + " N; ";
  }

  // `row` is the robot's first.
  void warn_of_little(const Step& k, double most, std::size_t row) const {
    const std::string share =
        most <= 1 ? "; is it a share of the largest thrust, from 0 to 1? multiply it by that" : "";
    k.event("warning: " + times.rows().at(row, "cmd_thrust") + "cmd_thrust is at most " + TableTimes::print(most) +
            " N, and hovering takes " + TableTimes::print(std::round(100 * weight) / 100) + " N, so that robot '" +
            std::string(k.name("robot", static_cast<std::size_t>(k[robot]))) + "' never flies; expected newtons" +
            share);
  }

  static constexpr double gravity = 9.81;     // m/s^2
  static constexpr double little = 0.9;       // of the weight: a fall that a record may end with is no fault
  static constexpr double most_weights = 20;  // of a thrust; racing quadrotors reach 10
  double weight = 0;                          // N
  Value robot;
  TableTimes times;
  In<Row> commands;
  Out<AttitudeThrust> command;
};

}  // namespace

MUSTER_PLUGIN_IS(ControlAttitude)
