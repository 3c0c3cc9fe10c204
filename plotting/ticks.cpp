#include "ticks.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace muster::plotting {
namespace {

// mantissa * 10^exponent; kept apart so that the k-th multiple is correctly rounded (0.3, not 0.30000000000000004).
struct Step {
  double mantissa = 1;
  int exponent = 0;

  double multiple(double k) const {
    return exponent >= 0 ? k * mantissa * std::pow(10, exponent) : k * mantissa / std::pow(10, -exponent);
  }
  double size() const { return multiple(1); }
  int decimals() const { return std::max(0, -exponent + (mantissa == 2.5 ? 1 : 0)); }
};

// A tick outside the range by rounding alone counts as inside.
constexpr double slack = 1e-9;

double first_inside(Range range, const Step& step) { return std::ceil(range.low / step.size() - slack); }
double last_inside(Range range, const Step& step) { return std::floor(range.high / step.size() + slack); }

Step choose_step(Range range, int at_most) {
  constexpr int at_least = 4;
  constexpr double wanted = 6;
  const int magnitude = static_cast<int>(std::floor(std::log10(range.span())));
  Step best;
  double best_penalty = std::numeric_limits<double>::infinity();
  for (int exponent = magnitude - 2; exponent <= magnitude + 1; ++exponent) {
    for (const double mantissa : {1.0, 2.0, 5.0, 2.5}) {
      const Step step{mantissa, exponent};
      const double count = last_inside(range, step) - first_inside(range, step) + 1;
      double penalty = std::abs(count - std::min(wanted, static_cast<double>(at_most)));
      if (mantissa == 2.5) penalty += 20;
      if (count > at_most) penalty += 1000;
      if (count < std::min(at_least, at_most)) penalty += 100;
      if (penalty < best_penalty) {
        best_penalty = penalty;
        best = step;
      }
    }
  }
  return best;
}

// Adds room around a range whose extent is too small to divide in doubles.
Range widened(Range data) {
  const double size = std::max(std::abs(data.low), std::abs(data.high));
  if (data.span() > size * 1e-10 && data.span() > 1e-290) return data;
  const double room = size > 1e-290 ? 0.1 * size : 1;
  return {data.low - room, data.high + room};
}

std::string superscript(int n) {
  constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string result = n < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(n))) result += digits[static_cast<std::size_t>(c - '0')];
  return result;
}

std::string thousands(std::string text) {
  const auto point = std::min(text.find('.'), text.size());
  if (point < 5) return text;
  for (std::size_t i = point; i > 3;) text.insert(i -= 3, "\u2009");
  return text;
}

// The multiples of 1, 2 and 5 (or of 1 alone) times powers of ten inside `range`.
std::vector<double> round_values(Range range, bool decades_only) {
  std::vector<double> values;
  const int first = static_cast<int>(std::floor(std::log10(range.low)));
  const int last = static_cast<int>(std::ceil(std::log10(range.high)));
  for (int exponent = first; exponent <= last; ++exponent) {
    for (const double mantissa : {1.0, 2.0, 5.0}) {
      const double value = Step{mantissa, exponent}.size();
      if (decades_only && mantissa != 1.0) continue;
      if (value >= range.low * (1 - slack) && value <= range.high * (1 + slack)) values.push_back(value);
    }
  }
  return values;
}

}  // namespace

std::string number_label(double value, int decimals) {
  const double size = std::abs(value);
  std::string text;
  if (size >= 1e6 || (size > 0 && size < 1e-4)) {
    int exponent = static_cast<int>(std::floor(std::log10(size)));
    text = fmt::format("{:.4g}", size / std::pow(10, exponent));
    if (text == "10") {  // log10 of a power of ten may fall short of it
      text = "1";
      ++exponent;
    }
    text = (text == "1" ? "10" : text + "×10") + superscript(exponent);
  } else {
    text = thousands(fmt::format("{:.{}f}", size, decimals));
  }
  const bool shows_zero = text.find_first_of("123456789⁰") == std::string::npos;
  return value < 0 && !shows_zero ? "−" + text : text;
}

std::vector<Tick> ticks_within(Range range, int at_most) {
  if (!(range.span() > 0)) return {{range.low, number_label(range.low, 3)}};
  const Step step = choose_step(range, at_most);
  std::vector<Tick> ticks;
  for (double k = first_inside(range, step); k <= last_inside(range, step); ++k) {
    const double value = step.multiple(k) + 0.0;   // + 0.0 turns -0 into 0
    const bool among_powers = step.size() < 1e-4;  // which have no decimals that a zero should share
    ticks.push_back({value, number_label(value, value == 0 && among_powers ? 0 : step.decimals())});
  }
  return ticks;
}

std::vector<Tick> log_ticks_within(Range range, int at_most) {
  auto values = round_values(range, false);
  if (values.size() > static_cast<std::size_t>(at_most)) values = round_values(range, true);
  if (values.size() < 3) return ticks_within(range, std::min(at_most, 6));
  const std::size_t stride = (values.size() - 1) / static_cast<std::size_t>(at_most) + 1;
  std::vector<Tick> ticks;
  for (std::size_t i = 0; i < values.size(); i += stride) {
    const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(values[i]) + slack)));
    ticks.push_back({values[i], number_label(values[i], decimals)});
  }
  return ticks;
}

Tick round_length(double limit) {
  const int exponent = static_cast<int>(std::floor(std::log10(limit) + slack));
  Step best{1, exponent};
  for (const double mantissa : {2.0, 5.0}) {
    const Step longer{mantissa, exponent};
    if (longer.size() <= limit * (1 + slack)) best = longer;
  }
  return {best.size(), number_label(best.size(), best.decimals())};
}

Range axis_range(Range data) {
  constexpr double far = 0.1, room = 0.03;  // shares of the span
  const Range wide = widened(data);
  const Step step = choose_step(wide, 9);
  const double low = step.multiple(std::floor(wide.low / step.size() + slack));
  const double high = step.multiple(std::ceil(wide.high / step.size() - slack));
  return {wide.low - low <= far * wide.span() ? std::min(low, wide.low) : wide.low - room * wide.span(),
          high - wide.high <= far * wide.span() ? std::max(high, wide.high) : wide.high + room * wide.span()};
}

Range log_axis_range(Range data) {
  if (!(data.high > data.low * (1 + 1e-10))) return {data.low / 2, data.high * 2};
  const double room = std::pow(data.high / data.low, 0.03), far = std::pow(data.high / data.low, 0.1);
  Range result{data.low / room, data.high * room};
  for (const double value : round_values({data.low / 10, data.high * 10}, false)) {
    if (value <= data.low && data.low / value <= far) result.low = value;
    if (value >= data.high && value / data.high <= far) return {result.low, value};
  }
  return result;
}

}  // namespace muster::plotting
