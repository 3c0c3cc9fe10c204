#include "diagnosis/causes/parameter_axes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "diagnosis/causes/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using std::numbers::pi;

// Periods of oscillations, evenly spaced in cycles over the data, from two cycles to periods of some rows.
std::vector<double> periods(double span) {
  const double most =
      std::clamp(span / thresholds::shortest_period, thresholds::fewest_cycles, thresholds::most_cycles);
  std::vector<double> result;
  for (double cycles = 2; cycles < most; cycles += cycles < 24 ? 0.4 : 0.7) result.push_back(span / cycles);
  return result;
}

std::optional<Axis> duration(const muster_param& p, const RecordedTime& time, const CauseShape& shape,
                             double sampling) {
  const double span = time.length();
  if (!shape.wave.empty()) {
    std::vector<double> values = periods(span);
    std::erase_if(values, [&](double period) { return period < 2 * sampling; });
    if (values.empty()) return {};
    return logarithmic(p, std::max(span / thresholds::most_cycles, 2 * sampling), span, values, 0.02);
  }
  // Settling within a tenth of the data is a jump.
  std::vector<double> values{0.15 * span, 0.4 * span, span, 30 * span};
  const double whole = time.high() - time.low();
  if (time.has_pauses()) values.insert(values.end(), {whole, 30 * whole});
  return logarithmic(p, thresholds::shortest_settling * span, 100 * whole, values, 0.3);
}

// Carriers, close enough that a wave ten wavelengths longer than the direct one is a quarter of a turn off at most.
Axis carrier(const muster_param& p) {
  std::vector<double> values;
  for (double f = thresholds::lowest_carrier; f < thresholds::highest_carrier; f *= thresholds::carrier_ratio)
    values.push_back(f);
  return logarithmic(p, thresholds::lowest_carrier, thresholds::highest_carrier, values, 0.015);
}

Axis moment(const muster_param& p, const RecordedTime& time, bool alone) {
  // A jump outside this range is an offset; an onset may be at the start of the data.
  const auto at = [&](double share) { return time.has_pauses() ? share * time.length() : time.at(share); };
  const double from = at(alone ? thresholds::earliest_jump : 0), to = at(thresholds::latest_jump);
  std::vector<double> values{from, at(0.25), at(0.5)};
  if (alone) values = evenly(from, to, 33);
  Axis axis{p.name, false, from, to, 0.012 * time.length(), values};
  // All of a pause is as likely, and a walk of short steps would not cross it.
  if (time.has_pauses()) axis.recorded = std::make_shared<const RecordedTime>(time);
  return axis;
}

}  // namespace

std::vector<double> evenly(double from, double to, int count) {
  std::vector<double> result(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) result[static_cast<std::size_t>(k)] = from + (to - from) * k / std::max(count - 1, 1);
  return result;
}

Axis logarithmic(const muster_param& p, double lower, double upper, const std::vector<double>& values, double step) {
  lower = std::clamp(lower, p.min, p.max);
  upper = std::clamp(upper, lower, p.max);
  Axis axis{p.name, true, std::log(lower), std::log(upper), step, {}, lower, upper};
  for (const double v : values) axis.values.push_back(std::log(std::clamp(v, lower, upper)));
  axis.values.erase(std::unique(axis.values.begin(), axis.values.end()), axis.values.end());
  return axis;
}

std::optional<Axis> axis_over(const muster_param& p, const RecordedTime& time, const CauseShape& shape, bool alone,
                              double sampling) {
  const std::string_view unit = p.unit;
  if (unit == "s" && time.length() <= 0) return {};
  if (p.flags & MUSTER_CYCLIC) {
    std::vector<double> turn = evenly(-pi, pi, 17);
    turn.pop_back();
    Axis all_around{p.name, false, -2 * pi, 2 * pi, 0.2, turn};  // two turns: no optimum at a bound
    all_around.cyclic = true;
    return all_around;
  }
  if (p.flags & MUSTER_LOG) {
    if (unit == "s") {
      const std::optional<Axis> axis = duration(p, time, shape, sampling);
      return axis && axis->lower < axis->upper ? axis : std::nullopt;  // none where the data last too long for it
    }
    if (unit == "Hz") return carrier(p);
    std::vector<double> values;
    for (const double v : evenly(std::log(p.min), std::log(p.max), 5)) values.push_back(std::exp(v));
    return logarithmic(p, p.min, p.max, {values[1], values[2], values[3]}, 0.2);
  }
  if (unit == "s") return moment(p, time, alone);
  return Axis{p.name, false, p.min, p.max, (p.max - p.min) / 20, evenly(p.min, p.max, alone ? 9 : 5)};
}

}  // namespace muster::diagnosis
