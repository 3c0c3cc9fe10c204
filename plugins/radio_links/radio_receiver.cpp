// The first stage of every receiver: received power in dBm, nothing below its sensitivity.
#include <muster/logarithm.hpp>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct RadioReceiver {
  static constexpr auto id = "radio.receiver/2";
  static constexpr auto summary = "rssi = mean level + fading in dB, null below the sensitivity";
  static constexpr auto manual =
      "rssi = level + 10 log10(fading gain), in dBm; null below `sensitivity`. What a chip does to it (saturation,\n"
      "quantisation, its own floor) is a matter of stages that modify link/*/rssi.\n"
      "When expectations are asked for the floor is not applied: a fit treats what was not received itself.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("sensitivity", -95, -250, 50, "dBm", "below this nothing is received")};  // -95: a CC2420's data sheet
  static constexpr muster_clip clip{sizeof(muster_clip), MUSTER_BELOW, "sensitivity", 1, nullptr};

  explicit RadioReceiver(Setup& s)
      : sensitivity(s.value("sensitivity")),
        level(s.read<Level>("link/*/level")),
        fading(s.read_if_any<Fading>("link/*/fading")),
        rssi(s.write<Rssi>("link/*/rssi")) {}

  void step(const Step& k) const {
    const auto levels = k[level];
    const auto gains = k[fading];
    const auto out = k[rssi];
    const double least = k[sensitivity];
    for (std::size_t i = 0; i < out.size(); ++i) out[i].rssi = gains.empty() ? 1 : gains[i].gain;
    if (!out.empty()) log10_of_all(&out[0].rssi, out.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double received = levels[i].level + 10 * out[i].rssi;
      out[i].rssi = received >= least || k.expected() ? received : null();
    }
  }

  Value sensitivity;
  In<Level> level;
  In<Fading> fading;
  Out<Rssi> rssi;
};

}  // namespace

MUSTER_PLUGIN_IS(RadioReceiver)
