// A receiver whose reading grows too slowly at strong levels.
#include <algorithm>
#include <muster/plugin.hpp>

#include "rssi_stage.hpp"

namespace {

using namespace muster;

struct RssiCompression {
  static constexpr auto id = "effect.rssi_compression/1";
  static constexpr auto summary = "strong levels are read too low: the receiver compresses them";
  static constexpr auto manual =
      "Takes away share x (reading - knee) from each reading above `knee`. Receivers whose gain control runs out do "
      "so; "
      "those of impulse radio above -85 dBm (Decawave, DW1000 user manual 2.18, section 4.7.2).";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("knee", -60, -150, 50, "dBm", "level above which the receiver compresses").free(),
      real("share", 0, 0, 1, "dB/dB", "of the excess over the knee that is lost").free().with(MUSTER_LINEAR),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_STAGE,
      "above {knee} the receiver reads {share} too little",
      "",
      "",
      "effect.rssi_saturation effect.dual_slope effect.two_ray",
      "add an attenuator of known loss near the sender, and see what the reading loses",
      nullptr,
      0,
  };

  explicit RssiCompression(Setup& s) : knee(s.value("knee")), share(s.value("share")), rssi(s) {}

  void step(const Step& k) const {
    rssi.each(k, [&](double reading, std::size_t) { return reading - k[share] * std::max(reading - k[knee], 0.0); });
  }

  Value knee, share;
  RssiStage rssi;
};

}  // namespace

MUSTER_PLUGIN_IS(RssiCompression)
