// A receiver that reports nothing below a level, or its lowest code instead.
#include <muster/plugin.hpp>

#include "rssi_stage.hpp"

namespace {

using namespace muster;

struct RssiFloor {
  static constexpr auto id = "effect.rssi_floor/1";
  static constexpr auto summary = "below a level the receiver reports nothing, or its lowest code";
  static constexpr auto manual =
      "A reading below `level` is lost, as if not received; without `silent` it comes out as `level`. Expectations "
      "stay as they are: a fit takes what is missing as upper bounds, a diagnosis also what is piled up.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("level", -250, -250, 50, "dBm", "lowest reading").free(),
      flag("silent", true, "nothing is reported below it"),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_STAGE,
      "the receiver reads nothing below {level}",
      "",
      "",
      "effect.multiwall_saturation effect.dual_slope effect.noise_floor_rssi",
      "look at the pile of readings at the lowest code, and at how many are missing where levels are low",
      nullptr,
      0,
  };
  static constexpr muster_clip clip{sizeof(muster_clip), MUSTER_BELOW, "level", 1, "silent"};

  explicit RssiFloor(Setup& s) : level(s.value("level")), silent(s.value("silent")), rssi(s) {}

  void step(const Step& k) const {
    rssi.each(k, [&](double reading, std::size_t) {
      if (k.expected() || reading >= k[level]) return reading;
      return k[silent] != 0 ? null() : k[level];
    });
  }

  Value level, silent;
  RssiStage rssi;
};

}  // namespace

MUSTER_PLUGIN_IS(RssiFloor)
