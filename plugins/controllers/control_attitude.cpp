// Attitude and thrust from a table, as a pilot's record has them.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct ControlAttitude {
  static constexpr auto id = "control.attitude/1";
  static constexpr auto summary = "asks a quadrotor for thrust, roll, pitch and turn rate from a table";
  static constexpr auto manual =
      "The file's columns are t[s],cmd_thrust[N],cmd_roll[rad],cmd_pitch[rad],cmd_yaw_rate[rad/s]; others are not "
      "read. "
      "Each row\n"
      "holds until the next; before the first there is no thrust.";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {reference("robot", "robot", "the robot it flies").required(),
                                     file("file", "commands by rising time").required()};

  struct Row {
    static constexpr const char* columns = "t[s] cmd_thrust[N] cmd_roll[rad] cmd_pitch[rad] cmd_yaw_rate[rad/s]";
    double t;
    AttitudeThrust asked;
  };

  explicit ControlAttitude(Setup& s)
      : commands(s.file<Row>("file")), command(s.write<AttitudeThrust>("robot/{robot}/attitude_thrust")) {}

  void step(const Step& k) const {
    const double tick = k.time() / static_cast<double>(k.tick());
    const double now = k.time() - tick / 2;  // commands hold over the tick: of two, the one for most of it
    *k[command] = {0, 0, 0, 0};
    const auto rows = k[commands];
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i > 0 && !(rows[i].t > rows[i - 1].t))
        throw BadInput("commands, row " + std::to_string(i + 1) + ": t does not rise");
      if (rows[i].t <= now) *k[command] = rows[i].asked;
    }
  }

  In<Row> commands;
  Out<AttitudeThrust> command;
};

}  // namespace

MUSTER_PLUGIN_IS(ControlAttitude)
