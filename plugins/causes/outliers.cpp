// Outliers: a wrong packet, a glitch of the register.
#include <muster/plugin.hpp>

#include "reading_stream.hpp"
#include "rssi_stage.hpp"

namespace {

using namespace muster;

struct Outliers {
  static constexpr auto id = "effect.outliers/1";
  static constexpr auto summary = "some readings are far off, without a pattern";
  static constexpr auto manual =
      "To a share of `share` of the readings, drawn for each sender, receiver and time, adds what is uniform within "
      "+-half_width. Expected: 0. Stream: outliers.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("share", 0, 0, 1, "", "of readings that are off").free(),
      real("half_width", 20, 0, 100, "dB", "the most that they are off").free(),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_LAW,
      "a share of {share} of the readings is off by up to {half_width}",
      "",
      "",
      "effect.fading_law effect.people effect.channel_mixture",
      "stand still: outliers come alone, people come in bursts",
      nullptr,
  };

  explicit Outliers(Setup& s)
      : share(s.value("share")),
        half_width(s.value("half_width")),
        endpoint(s.read<Endpoint>("endpoint/*/radio")),
        ends(s.read<Ends>("link/*/ends")),
        random(s.stream("outliers")),
        rssi(s) {}

  void step(const Step& k) const {
    rssi.each(k, [&](double reading, std::size_t i) {
      const Endpoint& from = k[endpoint][static_cast<std::size_t>(k[ends][i].tx)];
      const Endpoint& to = k[endpoint][static_cast<std::size_t>(k[ends][i].rx)];
      const Stream own = random.of(k.key("radio", static_cast<std::size_t>(from.radio)))
                             .of(k.key("radio", static_cast<std::size_t>(to.radio)));
      if (k.expected() || own.uniform(time_key(to.t), 0) >= k[share]) return reading;
      return reading + k[half_width] * (2 * own.uniform(time_key(to.t), 1) - 1);
    });
  }

  Value share, half_width;
  In<Endpoint> endpoint;
  In<Ends> ends;
  Stream random;
  RssiStage rssi;
};

}  // namespace

MUSTER_PLUGIN_IS(Outliers)
