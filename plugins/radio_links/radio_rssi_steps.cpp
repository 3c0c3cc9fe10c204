// A receiver whose rssi is quantised in whole steps.
#include <algorithm>
#include <cmath>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct RadioRssiSteps {
  static constexpr auto id = "radio.rssi_steps/1";
  static constexpr auto summary = "the receiver reports rssi in steps, between its lowest and its highest code";
  static constexpr auto manual =
      "A reading comes out as the nearest multiple of `step`, at least `least` and at most `most`; what was not\n"
      "received stays so. By default 1 dB in 8 bits, as chips for IEEE 802.15.4, 802.11 and Bluetooth have it.\n"
      "Expectations stay as they are. To a fit, readings at `least` and `most` are levels as all others are;\n"
      "a diagnosis takes those that pile up there as bounds (docs/reference/table_format.md).";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("step", 1, 0.001, 50, "dB", "between two codes"),
      real("least", -127, -250, 50, "dBm", "lowest reading"),
      real("most", 20, -250, 50, "dBm", "highest reading"),
  };

  explicit RadioRssiSteps(Setup& s)
      : size(s.value("step")), least(s.value("least")), most(s.value("most")), rssi(s.modify<Rssi>("link/*/rssi")) {}

  void step(const Step& k) const {
    const auto before = k.before(rssi);
    const auto out = k[rssi];
    if (k[least] > k[most]) throw BadInput("attribute \"least\": is above \"most\"; expected at most that");
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double reading = before[i].rssi;
      const double nearest = k[size] * std::round(reading / k[size]);
      out[i].rssi = is_null(reading) || k.expected() ? reading : std::clamp(nearest, k[least], k[most]);
    }
  }

  Value size, least, most;
  Stage<Rssi> rssi;
};

}  // namespace

MUSTER_PLUGIN_IS(RadioRssiSteps)
