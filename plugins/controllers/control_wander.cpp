// Every robot on random arcs, ignoring all others.
#include <algorithm>
#include <cmath>
#include <muster/plugin.hpp>
#include <muster/printed.hpp>
#include <string>

namespace {

using namespace muster;

struct ControlWander {
  static constexpr auto id = "control.wander/1";
  static constexpr auto summary = "drives all robots on random arcs";
  static constexpr auto manual =
      "Each `period` every robot draws a forward speed from [slowest, fastest] and a turn rate from [-turn, turn], "
      "both\n"
      "uniform, by its own name: neither other robots nor their order change them. Commands move to what was drawn at\n"
      "an even rate within `ramp`. All start at rest; nothing is sensed, so that robots among walls and others run\n"
      "into them.";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {real("slowest", -0.2, -10, 10, "m/s", "least forward speed"),
                                     real("fastest", 0.6, -10, 10, "m/s", "largest forward speed"),
                                     real("turn", 2, 0, 100, "rad/s", "largest turn rate"),
                                     real("period", 1, 1e-3, 1e6, "s", "time between two draws"),
                                     real("ramp", 0.25, 0, 1e6, "s", "time in which a command follows a draw")};

  explicit ControlWander(Setup& s)
      : slowest(s.value("slowest")),
        fastest(s.value("fastest")),
        turn(s.value("turn")),
        period(s.value("period")),
        ramp(s.value("ramp")),
        stream(s.stream("wander")),
        command(s.write<Command>("robot/*/command")) {
    check(s.param("slowest"), s.param("fastest"), s.param("period"), s.param("ramp"));
  }

  static void check(double slowest, double fastest, double period, double ramp) {
    if (slowest > fastest) throw BadInput("attribute \"slowest\": is above \"fastest\"; expected at most that");
    if (ramp > period)  // a command would jump on its way, to the next draw
      throw BadInput("attribute \"ramp\": " + printed(ramp) + " s is above the period of " + printed(period) +
                     " s; expected at most that");
  }

  void step(const Step& k) const {
    check(k[slowest], k[fastest], k[period], k[ramp]);  // they may have been set
    const double draws = std::floor(k.time() / k[period] + 1e-9), since = k.time() - draws * k[period];
    const double share = since < k[ramp] ? std::max(0.0, since / k[ramp]) : 1;
    const auto number = static_cast<uint64_t>(draws);
    for (std::size_t i = 0; i < k[command].size(); ++i) {
      k[command][i] = {0, 0};
      if (!k.alive("robot", i)) continue;
      const Command from = drawn(k, i, number), to = drawn(k, i, number + 1);
      k[command][i] = {from.v + share * (to.v - from.v), from.w + share * (to.w - from.w)};
    }
  }

  Command drawn(const Step& k, std::size_t robot, uint64_t number) const {
    if (number == 0) return {0, 0};
    const Stream own = stream.of(k.key("robot", robot));
    return {k[slowest] + (k[fastest] - k[slowest]) * own.uniform(number, 0),
            k[turn] * (2 * own.uniform(number, 1) - 1)};
  }

  Value slowest, fastest, turn, period, ramp;
  Stream stream;
  Out<Command> command;
};

}  // namespace

MUSTER_PLUGIN_IS(ControlWander)
