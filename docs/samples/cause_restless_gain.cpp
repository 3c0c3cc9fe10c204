// A receiver whose gain is restless: each reading has an error of its own, Laplace-distributed.
#include <cmath>
#include <cstring>
#include <muster/laws.hpp>
#include <muster/plugin.hpp>
using namespace muster;

struct RestlessGain {
  static constexpr auto id = "cause.restless_gain/1", summary = "each reading is off, to either side alike";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {real("scale", 1, 0.01, 20, "dB", "mean size of the errors").free()};
  static constexpr muster_cause cause = {
      sizeof(muster_cause), MUSTER_LAW, "readings are off by {scale} on average, each alone", "", "",
      "effect.outliers effect.channel_mixture effect.fading_law", "fix the receiver's gain and measure again",
      nullptr, 0};
  static void log_density(const double* params, uint32_t, const double* db, uint32_t count, double* out) {
    for (uint32_t i = 0; i < count; ++i) out[i] = -std::log(2 * params[0]) - std::abs(db[i]) / params[0];
  }
  static constexpr double scales[] = {0.3, 0.6, 1.2, 2.4, 4.8};
  static constexpr auto law = law_of_readings("scale", log_density).from(scales);

  explicit RestlessGain(Setup& s)
      : scale(s.value("scale")), endpoint(s.read<Endpoint>("endpoint/*/radio")), ends(s.read<Ends>("link/*/ends")),
        rssi(s.modify<Rssi>("link/*/rssi")), random(s.stream("restless_gain")) {}
  void step(const Step& k) const {
    for (size_t i = 0; i < k[rssi].size(); ++i) {
      const double before = k.before(rssi)[i].rssi;  // null where nothing was received
      k[rssi][i].rssi = k.expected() || is_null(before) ? before : before + error(k, k[ends][i]);
    }
  }
  double error(const Step& k, const Ends& link) const {
    const Endpoint &from = k[endpoint][size_t(link.tx)], &to = k[endpoint][size_t(link.rx)];
    uint64_t time;
    std::memcpy(&time, &to.t, sizeof time);
    const Stream own = random.of(k.key("radio", size_t(from.radio))).of(k.key("radio", size_t(to.radio)));
    return k[scale] * own.exponential(time, 0) * (own.uniform(time, 1) < 0.5 ? -1 : 1);
  }
  Value scale;
  In<Endpoint> endpoint;
  In<Ends> ends;
  Stage<Rssi> rssi;
  Stream random;
};
MUSTER_PLUGIN_IS(RestlessGain)
