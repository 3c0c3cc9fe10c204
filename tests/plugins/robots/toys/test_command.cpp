// Commands from a table, each held until the next: `t[s],v[m/s],w[rad/s]`.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct TestCommand {
  static constexpr auto id = "test.command/1";
  static constexpr auto summary = "commands from a table";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {reference("robot", "robot", "the robot it steers").required(),
                                     file("plan", "commands and when they begin").required()};
  struct Planned {
    static constexpr const char* columns = "t[s] v[m/s] w[rad/s]";
    double t, v, w;
  };

  explicit TestCommand(Setup& s) : plan(s.file<Planned>("plan")), command(s.write<Command>("robot/{robot}/command")) {}

  void step(const Step& k) const {
    *k[command] = {0, 0};
    for (const Planned& p : k[plan]) {
      if (p.t < k.time() - k.dt() / 2) *k[command] = {p.v, p.w};
    }
  }

  In<Planned> plan;
  Out<Command> command;
};

}  // namespace

MUSTER_PLUGIN_IS(TestCommand)
