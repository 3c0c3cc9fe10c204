// Drives on while somebody is heard, turns on the spot when nobody is, and calls all the time.
#include <muster/plugin.hpp>
using namespace muster;

struct KeepInTouch {
  static constexpr auto id = "control.keep_in_touch/1", summary = "drives on while somebody is heard";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {reference("robot", "robot", "which robot decides so").required()};
  explicit KeepInTouch(Setup& s)
      : heard(s.read<Incoming>("inbox/{robot}/message")), calls(s.write<Outgoing>("outbox/{robot}/message")),
        command(s.write<Command>("robot/{robot}/command")) {}
  void step(const Step& k) const {
    *k[command] = k[heard].empty() ? Command{0, 0.5} : Command{0.3, 0};  // m/s, rad/s
    k.send(calls, 0, "here").to = null();                                // to all
  }
  In<Incoming> heard;
  Out<Outgoing> calls;
  Out<Command> command;
};
MUSTER_PLUGIN_IS(KeepInTouch)
