// A constant speed, sideways speed and turn rate for one robot, up to a time.
#include <muster/ground_drives.hpp>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct TestTwist {
  static constexpr auto id = "test.twist/1";
  static constexpr auto summary = "one twist";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {reference("robot", "robot", "the robot it drives").required(),
                                     real("v", 0, -10, 10, "m/s", "forward"), real("side", 0, -10, 10, "m/s", "left"),
                                     real("w", 0, -100, 100, "rad/s", "turn rate"),
                                     real("until", 1e9, 0, 1e9, "s", "then rest")};

  explicit TestTwist(Setup& s)
      : v(s.value("v")),
        side(s.value("side")),
        w(s.value("w")),
        until(s.value("until")),
        command(s.write<Command>("robot/{robot}/command")),
        sideways(s.write<Sideways>("robot/{robot}/sideways")) {}

  void step(const Step& k) const {
    const bool goes = k.time() < k[until];
    *k[command] = goes ? Command{k[v], k[w]} : Command{0, 0};
    *k[sideways] = {goes ? k[side] : 0};
  }

  Value v, side, w, until;
  Out<Command> command;
  Out<Sideways> sideways;
};

}  // namespace

MUSTER_PLUGIN_IS(TestTwist)
