// Attitude and thrust from a table, such as a pilot's record.
#include <limits>
#include <muster/plugin.hpp>

#include "plugins/table_times.hpp"

namespace {

using namespace muster;

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
        command(s.write<AttitudeThrust>("robot/{robot}/attitude_thrust")) {}

  void step(const Step& k) const {
    const double tick = k.time() / static_cast<double>(k.tick());
    const double now = k.time() - tick / 2;  // commands hold over the tick: of two, that for most of it
    *k[command] = {0, 0, 0, 0};
    double last = -std::numeric_limits<double>::infinity(), second = last;
    std::size_t number = 0, own = 0, first = 0;
    for (const Row& row : k[commands]) {
      ++number;
      if (!is_null(row.robot) && row.robot != k[robot]) continue;
      if (!(row.t > last))
        throw BadInput(times.rows().at(number - 1) + "t does not rise: " + TableTimes::print(row.t) + " s after " +
                       TableTimes::print(last) + " s; expected the rows of a robot in the order of time");
      last = row.t;
      if (++own == 1) first = number - 1;
      if (own <= 2) second = row.t;
      if (row.t <= now) *k[command] = row.asked;
    }
    if (own == 0) throw BadInput("the file has no commands for it");
    if (k.tick() == 1 && last >= 0)  // what was asked before the run holds
      times.warn_of(
          k, {k[commands][first].t, second, last, first},
          "the commands of robot '" + std::string(k.name("robot", static_cast<std::size_t>(k[robot]))) + "' are",
          "none is ever given");
  }

  Value robot;
  TableTimes times;
  In<Row> commands;
  Out<AttitudeThrust> command;
};

}  // namespace

MUSTER_PLUGIN_IS(ControlAttitude)
