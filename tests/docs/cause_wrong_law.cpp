// A law whose density is not that of its draws, a clip that does not clip, a burst on every link: plugin-check says so.
#include <cmath>
#include <cstring>
#include <muster/laws.hpp>
#include <muster/plugin.hpp>
using namespace muster;

struct WrongLaw {
  static constexpr auto id = "cause.wrong_law/1", summary = "declares what it does not do";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {real("scale", 1, 0.01, 20, "dB", "of its errors").free(),
                                     real("level", -60, -150, 50, "dBm", "at which nothing happens"),
                                     reference("one", "radio", "an end"),
                                     reference("other", "radio", "the other end"),
                                     real("loss", 0, 0, 40, "dB", "on all links"),
                                     real("share", 0, 0, 1, "", "of no use"),
                                     real("duration", 1, 0.1, 100, "s", "of no use")};
  static constexpr muster_cause cause = {
      sizeof(muster_cause), MUSTER_LAW, "wrong by {scale}", "", "", "", "", nullptr, 0};
  static void log_density(const double* params, uint32_t, const double* db, uint32_t count, double* out) {
    for (uint32_t i = 0; i < count; ++i) out[i] = -std::log(1.5 * params[0]) - std::abs(db[i]) / params[0];
  }
  static constexpr double scales[] = {1, 2, 4};
  static constexpr auto law = law_of_readings("scale", log_density).from(scales);
  static constexpr muster_clip clip{sizeof(muster_clip), MUSTER_BELOW, "level", 1, nullptr};
  static constexpr muster_burst burst{sizeof(muster_burst), "one", "other", "loss", "share", "duration"};

  explicit WrongLaw(Setup& s)
      : scale(s.value("scale")),
        loss(s.value("loss")),
        rssi(s.modify<Rssi>("link/*/rssi")),
        random(s.stream("wrong")) {}
  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[rssi].size(); ++i) {
      const double before = k.before(rssi)[i].rssi;
      k[rssi][i].rssi =
          is_null(before) ? before : before - k[loss] + (k.expected() ? 1 : 3 * k[scale] * random.normal(i));
    }
  }
  Value scale, loss;
  Stage<Rssi> rssi;
  Stream random;
};
MUSTER_PLUGIN_IS(WrongLaw)
