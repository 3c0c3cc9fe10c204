// All doors are open until a time, then shut.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct ShutDoors {
  static constexpr auto id = "test.shut_doors/1", summary = "shuts all doors";
  static constexpr auto phase = MUSTER_ACTUATE;
  static constexpr Param params[] = {real("at", 0, 0, 1e6, "s", "when")};

  explicit ShutDoors(Setup& s) : at(s.value("at")), state(s.write<DoorState>("door/*/state")) {}

  void step(const Step& k) const {
    for (DoorState& door : k[state]) door.open = k.time() < k[at];
  }

  Value at;
  Out<DoorState> state;
};

}  // namespace

MUSTER_PLUGIN_IS(ShutDoors)
