// Outliers: a wrong packet, a glitch of the register.
#include <cmath>
#include <limits>
#include <muster/laws.hpp>
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
      0,
  };

  static void log_density(const double* params, uint32_t, const double* db, uint32_t count, double* out) {
    const double share = params[0], half_width = params[1];
    for (uint32_t i = 0; i < count; ++i)
      out[i] = half_width > 0 && std::abs(db[i]) <= half_width ? std::log(share / (2 * half_width))
                                                               : -std::numeric_limits<double>::infinity();
  }
  static uint32_t as_they_are(const double* params, double* db, double* probability, uint32_t) {
    *db = 0;
    *probability = params[1] > 0 ? 1 - params[0] : 1;
    return 1;
  }
  static constexpr double shares[] = {0.001, 0.003, 0.006, 0.012, 0.025, 0.05, 0.1}, half_widths[] = {7, 12, 20, 30};
  static constexpr auto law =
      law_of_readings("share", log_density).from(shares).with_form("half_width", half_widths).with_atoms(as_they_are);

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
