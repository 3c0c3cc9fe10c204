// Real steps of an amplifier differ from their nominal values.
#include <algorithm>
#include <array>
#include <muster/plugin.hpp>
#include <vector>

#include "link_term.hpp"
#include "settings.hpp"

namespace {

using namespace muster;

struct Power {
  static constexpr const char* columns = "t[s]? tx:radio power[dBm]";
  Setting<double> setting;
};

struct PowerSteps {
  static constexpr auto id = "effect.power_steps/1";
  static constexpr auto summary = "nominal transmit powers are not the real ones";
  static constexpr auto manual =
      "A radio was set to several powers while it was measured, which the column power[dBm] of `file` tells (t, tx "
      "and power; what stood last at or before a time holds; the measured readings will do, and without t have to: "
      "row for row). Adds `error1` to what was sent at the lowest of the powers in the file, `error2` at the next. Of "
      "more than six powers, `error1` is that of the lowest, `error6` that of the highest, the others those of powers "
      "evenly between, and errors change linearly from one to the next. Readings that the world is held against, and "
      "whose powers stand in for the file's, are to have the same ones. Data in which each reading was referred to its "
      "nominal power need nothing else. What all errors share is in l0: a diagnosis leaves that of the power with most "
      "readings at 0 (of several such, the highest), and only differences between errors can be compared.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {
      file("file", "when each radio was set to which power, a CSV table").required(),
      real("error1", 0, -30, 30, "dB", "of the lowest power").free().with(MUSTER_LINEAR),
      real("error2", 0, -30, 30, "dB", "of the second power").free().with(MUSTER_LINEAR),
      real("error3", 0, -30, 30, "dB", "of the third power").free().with(MUSTER_LINEAR),
      real("error4", 0, -30, 30, "dB", "of the fourth power").free().with(MUSTER_LINEAR),
      real("error5", 0, -30, 30, "dB", "of the fifth power").free().with(MUSTER_LINEAR),
      real("error6", 0, -30, 30, "dB", "of the sixth power").free().with(MUSTER_LINEAR),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "powers are not as set: by {error1}, {error2}, {error3}, {error4}, {error5}, {error6} from the lowest up",
      "",
      "power",
      "effect.tx_offset effect.step effect.rssi_saturation",
      "switch through all powers at one place, both radios standing",
      nullptr,
      0,
  };

  explicit PowerSteps(Setup& s)
      : errors{s.value("error1"), s.value("error2"), s.value("error3"),
               s.value("error4"), s.value("error5"), s.value("error6")},
        powers(s.file<Power>("file")),
        links(s) {}

  void step(const Step& k) {
    settings.read(k[powers], [](const Power& row) { return row.setting; });
    const std::vector<double> levels = settings.values();
    std::array<double, std::extent<decltype(errors)>::value> values{};
    for (std::size_t e = 0; e < values.size(); ++e) values[e] = k[errors[e]];
    const std::size_t count = links.size(k);
    links.add_of_each(k, [&](const End& from, const End&, std::size_t reading) {
      const double power = settings.at(from.radio, from.t, reading, count);
      if (is_null(power)) return 0.0;
      if (levels.size() > values.size())
        return between(values, (power - levels.front()) / (levels.back() - levels.front()));
      return values[std::lower_bound(levels.begin(), levels.end(), power) - levels.begin()];
    });
  }

  // Value at a share of the way from the first to the last, linear between neighbours.
  template <std::size_t n>
  static double between(const std::array<double, n>& values, double share) {
    const double at = share * (n - 1);
    const auto low = std::min(static_cast<std::size_t>(at), n - 2);
    return values[low] + (at - static_cast<double>(low)) * (values[low + 1] - values[low]);
  }

  Value errors[6];
  In<Power> powers;
  Settings<double> settings;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(PowerSteps)
