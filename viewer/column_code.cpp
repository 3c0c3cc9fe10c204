#include "column_code.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

namespace muster::viewer {
namespace {

static_assert(std::endian::native == std::endian::little);

enum class Odd : std::int64_t { nothing = 0, above = 1, below = 2 };  // counted from a type's lowest integer
constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max() - 8;

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }
bool is_usual_nothing(double value) { return bits(value) == bits(std::numeric_limits<double>::quiet_NaN()); }

// What integers are multiplied by, or divided by.
struct Scale {
  double step = 0, by = 0;
  double value(double k) const { return by > 0 ? k / by : k * step; }
  double nearest(double value) const { return std::round(by > 0 ? value * by : value / step); }
};

struct Whole {
  Scale scale;
  std::vector<std::int64_t> k;
  bool any_odd = false;  // a value that is not finite
  std::int64_t lowest = 0, highest = 0, largest_step = 0;
};

// The values as integers at this scale, or nothing where one would lose a bit.
std::optional<Whole> whole_at(const Scale& scale, const std::vector<double>& values) {
  Whole result;
  result.scale = scale;
  result.k.reserve(values.size());
  std::int64_t before = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) {
      if (std::isnan(value) && !is_usual_nothing(value)) return {};
      result.any_odd = true;
      result.k.push_back(0);
      continue;
    }
    const double k = scale.nearest(value);
    if (!(std::abs(k) < static_cast<double>(most)) || bits(scale.value(k == 0 ? 0 : k)) != bits(value)) return {};
    const auto integer = static_cast<std::int64_t>(k);
    result.k.push_back(integer);
    result.lowest = std::min(result.lowest, integer);
    result.highest = std::max(result.highest, integer);
    result.largest_step = std::max(result.largest_step, std::abs(integer - before));
    before = integer;
  }
  return result;
}

// The smallest of 1, 2 and 4 bytes that holds these, the three lowest integers left free.
int width_of(std::int64_t lowest, std::int64_t highest) {
  for (const int width : {1, 2}) {
    const std::int64_t end = std::int64_t{1} << (8 * width - 1);
    if (lowest >= -end + 3 && highest < end) return width;
  }
  return 4;
}

void append(std::int64_t k, int width, std::string& bytes) {
  for (int i = 0; i < width; ++i) bytes += static_cast<char>(static_cast<std::uint64_t>(k) >> (8 * i) & 255);
}

std::int64_t odd_number(double value, int width) {
  const std::int64_t lowest = -(std::int64_t{1} << (8 * width - 1));
  return lowest + static_cast<std::int64_t>(std::isnan(value) ? Odd::nothing : value > 0 ? Odd::above : Odd::below);
}

Json scaled(const Whole& whole, const std::vector<double>& values, std::string& bytes) {
  const int plain = width_of(whole.lowest, whole.highest);
  const int stepwise = width_of(-whole.largest_step, whole.largest_step);
  const bool delta = !whole.any_odd && whole.largest_step < whole.highest - whole.lowest && stepwise <= plain;
  const int width = delta ? stepwise : plain;
  Json code{{"kind", "scaled"},
            {"type", "i" + std::to_string(8 * width)},
            {"at", bytes.size()},
            {"count", values.size()},
            {"delta", delta}};
  if (whole.scale.by > 0)
    code["by"] = whole.scale.by;
  else
    code["step"] = whole.scale.step;
  std::int64_t before = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      append(odd_number(values[i], width), width, bytes);
      continue;
    }
    append(whole.k[i] - (delta ? before : 0), width, bytes);
    before = whole.k[i];
  }
  return code;
}

Json planes(const std::vector<double>& values, std::string& bytes) {
  const std::size_t at = bytes.size(), count = values.size();
  bytes.resize(at + 8 * count);
  std::uint64_t before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t changed = bits(values[i]) ^ before;
    before = bits(values[i]);
    for (std::size_t plane = 0; plane < 8; ++plane)
      bytes[at + plane * count + i] = static_cast<char>(changed >> (8 * plane) & 255);
  }
  return {{"kind", "planes"}, {"at", at}, {"count", count}};
}

bool is_constant(const std::vector<double>& values) {
  const auto same = [&](double value) { return bits(value) == bits(values.front()); };
  return std::all_of(values.begin(), values.end(), same) && std::isfinite(values.front()) &&
         bits(values.front()) != bits(-0.0);  // which JSON does not keep apart from 0
}

}  // namespace

Json code_of(const std::vector<double>& values, double tick, std::string& bytes) {
  if (values.empty()) return {{"kind", "constant"}, {"value", 0.0}, {"count", 0}};
  if (is_constant(values)) return {{"kind", "constant"}, {"value", values.front()}, {"count", values.size()}};
  std::vector<Scale> scales{{.step = 1}, {.step = tick}};
  for (double by = 10; by <= 1e6; by *= 10) {
    scales.push_back({.by = by});
    scales.push_back({.step = 1 / by});  // what was rounded by a product, such as a laser's ranges
  }
  for (const Scale& scale : scales) {
    if (const auto whole = whole_at(scale, values)) return scaled(*whole, values, bytes);
  }
  return planes(values, bytes);
}

Json code_of(const Factor& names, std::string& bytes) {
  const int width = names.levels.size() <= 0x100 ? 1 : names.levels.size() <= 0x10000 ? 2 : 4;
  Json code{{"kind", "names"},
            {"levels", names.levels},
            {"type", "u" + std::to_string(8 * width)},
            {"at", bytes.size()},
            {"count", names.level.size()}};
  for (const std::uint32_t level : names.level) append(level, width, bytes);
  return code;
}

Json code_of(const std::vector<std::vector<double>>& lists, double tick, std::string& bytes) {
  std::vector<double> lengths, values;
  for (const auto& list : lists) {
    lengths.push_back(static_cast<double>(list.size()));
    values.insert(values.end(), list.begin(), list.end());
  }
  Json code{{"kind", "lists"}};
  code["lengths"] = code_of(lengths, tick, bytes);
  code["values"] = code_of(values, tick, bytes);
  return code;
}

}  // namespace muster::viewer
