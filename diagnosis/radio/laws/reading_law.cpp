#include "diagnosis/radio/laws/reading_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace muster::diagnosis {
namespace {

constexpr BinGrid coarse{-60, 0.25, 360};  // of variances
// dB^2; of a reading whose law is narrower than a bin: two bins share it.
constexpr double of_steady_reading = 1.005 * coarse.width * coarse.width / 4;
constexpr std::size_t steps = 100;    // of strengths, between their bounds
constexpr double negligible = 1e-30;  // per dB; smaller densities are 0, since subnormal numbers are slow
constexpr std::size_t most_atoms = 128;

std::size_t place_in(const muster_plugin& plugin, const char* parameter) {
  std::size_t k = 0;
  while (std::strcmp(plugin.params[k].name, parameter) != 0) ++k;
  return k;
}

}  // namespace

ReadingLaw::ReadingLaw(std::string id, std::shared_ptr<Library> library, const muster_plugin& plugin)
    : id_(std::move(id)),
      library_(std::move(library)),
      plugin_(plugin),
      strength_(place_in(plugin, plugin.law->strength)) {
  if (plugin.law->form) form_ = place_in(plugin, plugin.law->form);
}

std::vector<double> ReadingLaw::defaults() const {
  std::vector<double> result;
  for (uint32_t k = 0; k < plugin_.param_count; ++k) result.push_back(plugin_.params[k].value);
  return result;
}

std::vector<double> ReadingLaw::at_strength(std::vector<double> params, double value) const {
  params[strength_] = value;
  return params;
}

std::vector<double> ReadingLaw::at_form(std::vector<double> params, double value) const {
  params[form_] = value;
  return params;
}

std::vector<double> ReadingLaw::densities(const std::vector<double>& params, uint32_t draws,
                                          const BinGrid& grid) const {
  std::vector<double> db(grid.count), result(grid.count);
  for (std::size_t i = 0; i < grid.count; ++i) db[i] = grid.centre(i);
  declared().log_density(params.data(), draws, db.data(), static_cast<uint32_t>(grid.count), result.data());
  for (double& d : result) d = std::exp(d) < negligible ? 0 : std::exp(d);
  return result;
}

std::vector<Atom> ReadingLaw::atoms(const std::vector<double>& params) const {
  if (!declared().atoms) return {};
  std::array<double, most_atoms> db{}, probability{};
  const uint32_t count = declared().atoms(params.data(), db.data(), probability.data(), most_atoms);
  std::vector<Atom> result;
  for (std::size_t k = 0; k < std::min<std::size_t>(count, most_atoms); ++k) result.push_back({db[k], probability[k]});
  return result;
}

std::vector<Atom> ReadingLaw::masses(const std::vector<double>& params, uint32_t draws) const {
  const std::vector<double> density = densities(params, draws, coarse);
  std::vector<Atom> result;
  for (std::size_t i = 0; i < density.size(); ++i) result.push_back({coarse.centre(i), density[i] * coarse.width});
  for (const Atom& atom : atoms(params)) result.push_back(atom);
  return result;
}

double ReadingLaw::computed_variance(const std::vector<double>& params, uint32_t draws) const {
  double sum = 0, first = 0, second = 0;
  for (const auto& [db, mass] : masses(params, draws)) {
    sum += mass;
    first += mass * db;
    second += mass * db * db;
  }
  return second / sum - first * first / (sum * sum);
}

double ReadingLaw::beyond(const std::vector<double>& params, double db) const {
  double result = 0;
  for (const Atom& atom : masses(params, 1)) result += std::abs(atom.db) > db ? atom.probability : 0;
  return result;
}

bool ReadingLaw::is_heavy_tailed(const std::vector<double>& params) const {
  const std::vector<Atom> all = masses(params, 1);
  double sum = 0, first = 0, second = 0, fourth = 0;
  for (const auto& [db, mass] : all) {
    sum += mass;
    first += mass * db;
  }
  for (const auto& [db, mass] : all) {
    const double square = (db - first / sum) * (db - first / sum);
    second += mass * square;
    fourth += mass * square * square;
  }
  return fourth * sum > 3 * second * second;
}

double ReadingLaw::strength_at(double place) const {
  const muster_param& p = strength();
  const double share = place / steps;
  return p.flags & MUSTER_LOG ? p.min * std::pow(p.max / p.min, share) : p.min + (p.max - p.min) * share;
}

double ReadingLaw::place_of(double value) const {
  const muster_param& p = strength();
  return steps *
         (p.flags & MUSTER_LOG ? std::log(value / p.min) / std::log(p.max / p.min) : (value - p.min) / (p.max - p.min));
}

double ReadingLaw::Variances::at(double place) const {
  const double inside = std::clamp(place, static_cast<double>(first), static_cast<double>(last));
  const std::size_t below = std::min(static_cast<std::size_t>(inside), last - 1);
  const double low = std::log(values[below]), high = std::log(values[below + 1]);
  return std::exp(low + (inside - static_cast<double>(below)) * (high - low));
}

const ReadingLaw::Variances& ReadingLaw::variances(std::vector<double> params, uint32_t draws) const {
  params[strength_] = 0;
  const std::lock_guard guard(lock_);
  const auto [entry, missing] = known_.try_emplace({params, draws});
  Variances& result = entry->second;
  if (!missing) return result;
  for (std::size_t k = 0; k <= steps; ++k)
    result.values.push_back(computed_variance(at_strength(params, strength_at(static_cast<double>(k))), draws));
  const auto wide = [](double v) { return v > of_steady_reading; };
  const auto begin = result.values.begin(), end = result.values.end();
  const auto first = std::find_if(begin, end, wide), last = std::find_if_not(first, end, wide);
  result.first = static_cast<std::size_t>(first - begin);
  result.last = static_cast<std::size_t>(last - begin) - (last == begin ? 0 : 1);
  return result;
}

double ReadingLaw::variance(const std::vector<double>& params, uint32_t draws) const {
  if (!replaces()) return computed_variance(params, draws);
  const Variances& all = variances(params, draws);
  return all.last > all.first ? all.at(place_of(params[strength_])) : of_steady_reading;
}

std::optional<double> ReadingLaw::strength_of(double variance, const std::vector<double>& params,
                                              uint32_t draws) const {
  const Variances& all = variances(params, draws);
  if (draws > declared().most_draws || all.last <= all.first) return {};
  auto low = static_cast<double>(all.first), high = static_cast<double>(all.last);
  if (all.at(low) < all.at(high)) std::swap(low, high);  // `low`: the place with the larger variance
  if (!(variance <= all.at(low) && variance >= all.at(high))) return {};
  for (int round = 0; round < 30; ++round) {
    const double middle = (low + high) / 2;
    (all.at(middle) > variance ? low : high) = middle;
  }
  return strength_at((low + high) / 2);
}

double ReadingLaw::nearest_strength(double variance, const std::vector<double>& params) const {
  if (const auto exact = strength_of(variance, params, 1)) return *exact;
  const Variances& all = variances(params, 1);
  const bool grows = all.values.back() > all.values.front();
  return (variance > all.at(static_cast<double>(grows ? all.last : all.first))) == grows ? strength().max
                                                                                         : strength().min;
}

}  // namespace muster::diagnosis
