// A constant command for one robot: the same arc for ever.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct ControlSteady {
  static constexpr auto id = "control.steady/1";
  static constexpr auto summary = "asks a robot for one forward speed and turn rate";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {reference("robot", "robot", "the robot it drives").required(),
                                     real("v", 0, -10, 10, "m/s", "forward speed"),
                                     real("w", 0, -100, 100, "rad/s", "turn rate, to the left"),
                                     real("until", 1e9, 0, 1e9, "s", "then it asks for rest")};

  explicit ControlSteady(Setup& s)
      : v(s.value("v")), w(s.value("w")), until(s.value("until")), command(s.write<Command>("robot/{robot}/command")) {}

  void step(const Step& k) const { *k[command] = k.time() < k[until] ? Command{k[v], k[w]} : Command{0, 0}; }

  Value v, w, until;
  Out<Command> command;
};

}  // namespace

MUSTER_PLUGIN_IS(ControlSteady)
