// Opens all doors at a tick.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Porter {
  static constexpr auto id = "test.porter/1", summary = "opens all doors";
  static constexpr auto phase = MUSTER_PHYSICS;
  static constexpr Param params[] = {integer("at", 1, 1, 1e9, "the tick")};

  explicit Porter(Setup& s) : at(s.value("at")), state(s.write<DoorState>("door/*/state")) {}

  void step(const Step& k) const {
    for (DoorState& door : k[state]) door.open = static_cast<double>(k.tick()) >= k[at];
  }

  Value at;
  Out<DoorState> state;
};

}  // namespace

MUSTER_PLUGIN_IS(Porter)
