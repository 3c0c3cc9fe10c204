// RSSI that a chip reports relative to its own noise.
#include <muster/plugin.hpp>
#include <utility>

#include "rssi_stage.hpp"
#include "settings.hpp"

namespace {

using namespace muster;

struct Noise {
  static constexpr const char* columns = "t[s]? tx:radio rx:radio noise[dBm]";
  double t, tx, rx, noise;
};

using Pair = std::pair<double, double>;

struct NoiseFloorRssi {
  static constexpr auto id = "effect.noise_floor_rssi/2";
  static constexpr auto summary = "the reported RSSI follows the noise: it is a ratio to it";
  static constexpr auto manual =
      "Takes away share x (noise - reference) from each reading, the noise at the receiver being the column "
      "noise[dBm] of `file` (t, tx, rx and noise: two packets of one tick meet two noises; what stood last for the "
      "pair at or before a time holds, else for the receiver; the measured readings will do, and without t have to: "
      "row for row). With share 1 the reading is a signal-to-noise ratio. A diagnosis holds `reference` at its "
      "default: another one shifts all levels alike, as l0 does.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {
      file("file", "the noise at each receiver, a CSV table").required(),
      real("share", 0, -2, 2, "", "of the noise's changes that the reading follows").free().with(MUSTER_LINEAR),
      real("reference", -95, -250, 50, "dBm", "noise at which the reading is right"),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_STAGE,
      "the RSSI falls as the noise rises: it is a share of {share} of a ratio to it",
      "",
      "noise",
      "effect.drift effect.periodic effect.rssi_floor",
      "stand still and let others talk: levels do not change, noise does",
      nullptr,
      0,
  };

  explicit NoiseFloorRssi(Setup& s)
      : share(s.value("share")),
        reference(s.value("reference")),
        noises(s.file<Noise>("file")),
        endpoint(s.read<Endpoint>("endpoint/*/radio")),
        ends(s.read<Ends>("link/*/ends")),
        rssi(s) {}

  void step(const Step& k) {
    of_pairs.read(k[noises], [](const Noise& row) { return Setting<Pair>{row.t, {row.tx, row.rx}, row.noise}; });
    of_receivers.read(k[noises], [](const Noise& row) { return Setting<double>{row.t, row.rx, row.noise}; });
    rssi.each(k, [&](double reading, std::size_t i) {
      const Endpoint& from = k[endpoint][static_cast<std::size_t>(k[ends][i].tx)];
      const Endpoint& to = k[endpoint][static_cast<std::size_t>(k[ends][i].rx)];
      const double of_pair = of_pairs.at({from.radio, to.radio}, to.t, i, k[ends].size());
      const double noise = is_null(of_pair) ? of_receivers.at(to.radio, to.t, i, k[ends].size()) : of_pair;
      return is_null(noise) ? reading : reading - k[share] * (noise - k[reference]);
    });
  }

  Value share, reference;
  In<Noise> noises;
  In<Endpoint> endpoint;
  In<Ends> ends;
  Settings<Pair> of_pairs;
  Settings<double> of_receivers;
  RssiStage rssi;
};

}  // namespace

MUSTER_PLUGIN_IS(NoiseFloorRssi)
