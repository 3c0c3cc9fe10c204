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
      "When expectations are asked for the floor is not applied: a fit treats what was not received itself.\n"
      "Measured readings below it count as any other. Only a `sensitivity` that the world writes states a floor to a\n"
      "fit and a diagnosis, and the default where a log ends at it.";
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
    const std::size_t links = k[rssi].size();
    if (links == 0) return;
    const Level* const levels = k[level].begin();  // a row a link, as out
    const Fading* const gains = k[fading].begin();
    const bool fades = !k[fading].empty(), expected = k.expected();
    Rssi* const out = k[rssi].begin();
    const double least = k[sensitivity];
    for (std::size_t i = 0; i < links; ++i) out[i].rssi = fades ? gains[i].gain : 1;
    log10_of_all(&out->rssi, links);
    for (std::size_t i = 0; i < links; ++i) {
      const double received = levels[i].level + 10 * out[i].rssi;
      out[i].rssi = received >= least || expected ? received : null();
    }
  }

  Value sensitivity;
  In<Level> level;
  In<Fading> fading;
  Out<Rssi> rssi;
};

}  // namespace

MUSTER_PLUGIN_IS(RadioReceiver)
