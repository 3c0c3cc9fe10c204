#include "text/unit_words.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "text/doubts.hpp"
#include "text/number.hpp"

namespace muster {
namespace {

struct Word {
  std::string_view unit, word;
  double factor;
};

constexpr double degree = 0.017453292519943295;  // rad

constexpr std::array words = {
    Word{"s", "ms", 1e-3},
    Word{"s", "us", 1e-6},
    Word{"s", "s", 1},
    Word{"s", "sec", 1},
    Word{"s", "secs", 1},
    Word{"s", "second", 1},
    Word{"s", "seconds", 1},
    Word{"s", "min", 60},
    Word{"s", "mins", 60},
    Word{"s", "minute", 60},
    Word{"s", "minutes", 60},
    Word{"s", "m", 60},
    Word{"s", "h", 3600},
    Word{"s", "hr", 3600},
    Word{"s", "hour", 3600},
    Word{"s", "hours", 3600},
    Word{"s", "d", 86400},
    Word{"m", "mm", 1e-3},
    Word{"m", "cm", 1e-2},
    Word{"m", "dm", 0.1},
    Word{"m", "m", 1},
    Word{"m", "km", 1e3},
    Word{"m", "ft", 0.3048},
    Word{"m", "in", 0.0254},
    Word{"rad", "rad", 1},
    Word{"rad", "deg", degree},
    Word{"rad", "degrees", degree},
    Word{"rad", "\u00b0", degree},
    Word{"rad/s", "rad/s", 1},
    Word{"rad/s", "deg/s", degree},
    Word{"rad/s", "rpm", 6 * degree},
    Word{"m/s", "m/s", 1},
    Word{"m/s", "km/h", 1 / 3.6},
    Word{"m/s", "kmh", 1 / 3.6},
    Word{"m/s", "cm/s", 1e-2},
    Word{"m/s", "mm/s", 1e-3},
    Word{"Hz", "Hz", 1},
    Word{"Hz", "kHz", 1e3},
    Word{"Hz", "MHz", 1e6},
    Word{"Hz", "GHz", 1e9},
    Word{"kg", "kg", 1},
    Word{"kg", "g", 1e-3},
    Word{"N", "N", 1},
    Word{"N", "kN", 1e3},
    Word{"dB", "dB", 1},
    Word{"dB", "dBi", 1},
    Word{"dBi", "dB", 1},
    Word{"dBm", "dBm", 1},
};

// "1:30" and "00:01:30" in seconds.
std::optional<double> clock_time(std::string_view text) {
  double result = 0;
  int parts = 0;
  for (std::size_t from = 0; from <= text.size(); ++parts) {
    const std::size_t to = std::min(text.find(':', from), text.size());
    const auto part = parse_real(text.substr(from, to - from));
    if (!part || *part < 0) return std::nullopt;
    result = 60 * result + *part;
    from = to + 1;
  }
  return parts == 2 || parts == 3 ? std::optional(result) : std::nullopt;
}

}  // namespace

std::optional<double> in_unit(std::string_view unit, std::string_view text) {
  if (unit == "s" && text.find(':') != text.npos) return clock_time(text);
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  std::string_view word(stop, static_cast<std::size_t>(text.data() + text.size() - stop));
  while (!word.empty() && word.front() == ' ') word.remove_prefix(1);
  for (const Word& one : words)
    if (one.unit == unit && one.word == word) return value * one.factor;
  if (!unit.empty() && word == unit) return value;
  return std::nullopt;
}

std::string other_unit_hint(std::string_view unit, std::string_view text) {
  if (std::string power = power_hint(unit, text); !power.empty()) return power;
  const auto value = in_unit(unit, text);
  const std::string end = ' ' + std::string(unit);
  if (!value) return "";
  if (text.ends_with(unit)) {
    std::string_view number = text.substr(0, text.size() - unit.size());
    while (number.ends_with(' ')) number.remove_suffix(1);
    if (parse_real(number)) return "; " + std::string(text) + " is written " + std::string(number);
  }
  std::array<char, 32> digits;
  const auto last =
      std::to_chars(digits.data(), digits.data() + digits.size(), *value, std::chars_format::general, 10).ptr;
  return "; " + std::string(text) + " are " + std::string(digits.data(), last) + end;
}

}  // namespace muster
