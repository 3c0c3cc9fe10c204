// Takes a radio out of the world at a tick.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Leaver {
  static constexpr auto id = "test.leaver/1", summary = "takes a radio away";
  static constexpr auto phase = MUSTER_PHYSICS;
  static constexpr Param params[] = {
      reference("radio", "radio", "which").required(),
      integer("at", 1, 1, 1e9, "the tick"),
  };

  explicit Leaver(Setup& s)
      : radio(s.value("radio")), at(s.value("at")), mount(s.write<Mount>("radio/*/mount", MUSTER_JOINS)) {}

  void step(const Step& k) const {
    if (static_cast<double>(k.tick()) != k[at]) return;
    k.host()->leave(k.host(), mount.index, static_cast<uint32_t>(k[radio]));
  }

  Value radio, at;
  Out<Mount> mount;
};

}  // namespace

MUSTER_PLUGIN_IS(Leaver)
