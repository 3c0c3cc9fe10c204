// Drives while the station "base" is heard well, and turns back while it is not: by the table of links alone.
#include <muster/plugin.hpp>
#include <muster/senses.hpp>

namespace {

using namespace muster;

struct TestHoming {
  static constexpr auto id = "test.homing/1", summary = "keeps within reach by its table of links";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {reference("robot", "robot", "which").required(),
                                     reference("base", "radio", "to be heard").required(),
                                     real("least", -60, -200, 0, "dBm", "rssi at which it turns back")};
  explicit TestHoming(Setup& s)
      : base(s.value("base")),
        least(s.value("least")),
        heard(s.read<Heard>("heard/{robot}/peer")),
        command(s.write<Command>("robot/{robot}/command")) {}
  void step(const Step& k) const {
    *k[command] = {-0.3, 0};
    for (const Heard& link : k[heard])
      if (link.peer == k[base] && !is_null(link.rssi) && link.rssi >= k[least]) *k[command] = {0.3, 0};
  }
  Value base, least;
  In<Heard> heard;
  Out<Command> command;
};

}  // namespace

MUSTER_PLUGIN_IS(TestHoming)
