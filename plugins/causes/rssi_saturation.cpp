// A receiver that saturates at its highest code.
#include <algorithm>
#include <muster/plugin.hpp>

#include "rssi_stage.hpp"

namespace {

using namespace muster;

struct RssiSaturation {
  static constexpr auto id = "effect.rssi_saturation/1";
  static constexpr auto summary = "the receiver reads nothing above a level";
  static constexpr auto manual =
      "A reading above `level` comes out as `level`. Expectations stay as they are: a fit takes readings at the "
      "ceiling as levels, a diagnosis as lower bounds.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("level", 50, -150, 50, "dBm", "highest reading").free(),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_STAGE,
      "the receiver reads no more than {level}",
      "",
      "",
      "effect.rssi_floor effect.dual_slope effect.multiwall_saturation",
      "look at the pile of readings at the highest code; add an attenuator of known loss",
      nullptr,
      0,
  };
  static constexpr muster_clip clip{sizeof(muster_clip), MUSTER_ABOVE, "level", 0, nullptr};

  explicit RssiSaturation(Setup& s) : level(s.value("level")), rssi(s) {}

  void step(const Step& k) const {
    rssi.each(k, [&](double reading, std::size_t) { return k.expected() ? reading : std::min(reading, k[level]); });
  }

  Value level;
  RssiStage rssi;
};

}  // namespace

MUSTER_PLUGIN_IS(RssiSaturation)
