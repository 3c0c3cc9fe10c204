#include "diagnosis/radio/laws/reading_distribution.hpp"

#include <algorithm>
#include <cmath>

namespace muster::diagnosis {
namespace {

// Densities per dB of the base; an atom fills its bin.
std::vector<double> base_table(const ReadingDistribution& law, const BinGrid& grid) {
  std::vector<double> table(grid.count, 0);
  if (law.base.law) table = law.base.law->densities(law.base.params, law.draws, grid);
  const std::vector<Atom> atoms = law.base.law ? law.base.law->atoms(law.base.params) : std::vector<Atom>{{0, 1}};
  for (const Atom& atom : atoms) {
    const double place = (atom.db - grid.lowest) / grid.width;
    if (place >= 0 && place < static_cast<double>(grid.count))
      table[static_cast<std::size_t>(place)] += atom.probability / grid.width;
  }
  return table;
}

double mean_of(const std::vector<double>& table, const BinGrid& grid) {
  double sum = 0, first = 0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    sum += table[i];
    first += table[i] * grid.centre(i);
  }
  return first / sum;
}

// Convolves the table with kernel values at whole bins about the middle one.
std::vector<double> smeared(const std::vector<double>& table, const std::vector<double>& kernel) {
  const std::size_t reach = kernel.size() / 2;
  std::vector<double> result(table.size(), 0);
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table[i] == 0) continue;
    const std::size_t from = i < reach ? reach - i : 0, to = std::min(kernel.size(), table.size() + reach - i);
    for (std::size_t k = from; k < to; ++k) result[i + k - reach] += table[i] * kernel[k];
  }
  return result;
}

// Of this variance, also where it is narrower than a bin.
std::vector<double> normal_kernel(double variance, double bin) {
  if (const double bins = variance / (bin * bin); bins < 0.5) return {bins / 2, 1 - bins, bins / 2};
  const auto reach = static_cast<std::ptrdiff_t>(4.5 * std::sqrt(variance) / bin) + 1;
  std::vector<double> kernel(static_cast<std::size_t>(2 * reach + 1));
  const auto middle = kernel.begin() + reach;
  for (std::ptrdiff_t k = 0; k <= reach; ++k) {
    const double z = static_cast<double>(k) * bin;
    middle[k] = middle[-k] = std::exp(-z * z / (2 * variance));
  }
  double sum = 0;
  for (const double v : kernel) sum += v;
  for (double& v : kernel) v /= sum;
  return kernel;
}

// Uniform distribution over a step.
std::vector<double> box_kernel(double step, double bin) {
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(step / 2 / bin + 0.5));
  std::vector<double> kernel;
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    const double left = (static_cast<double>(k) - 0.5) * bin, right = left + bin;
    kernel.push_back(std::max(0.0, std::min(right, step / 2) - std::max(left, -step / 2)) / step);
  }
  return kernel;
}

// A law's density at whole bins about 0 dB, as probabilities with this sum; empty where it has none.
std::vector<double> density_kernel(const LawPart& part, double bin, std::size_t reach, double probability) {
  std::vector<double> kernel =
      part.law->densities(part.params, 1, {-bin * (static_cast<double>(reach) + 0.5), bin, 2 * reach + 1});
  std::size_t zeros = 0;  // at both ends alike
  while (zeros < reach && kernel[zeros] == 0 && kernel[2 * reach - zeros] == 0) ++zeros;
  kernel = std::vector<double>(kernel.begin() + static_cast<std::ptrdiff_t>(zeros),
                               kernel.end() - static_cast<std::ptrdiff_t>(zeros));
  double sum = 0;
  for (const double v : kernel) sum += v;
  if (sum == 0) return {};
  for (double& v : kernel) v *= probability / sum;
  return kernel;
}

// Adds independent draws of a law: convolves the table with its density and shifts it by its atoms.
std::vector<double> with_added(const std::vector<double>& table, const LawPart& part, double bin) {
  const std::vector<Atom> atoms = part.law->atoms(part.params);
  double rest = 1;
  for (const Atom& atom : atoms) rest -= atom.probability;
  std::vector<double> result = smeared(table, density_kernel(part, bin, table.size() / 2, rest));
  const auto end = static_cast<std::ptrdiff_t>(table.size());
  for (const Atom& atom : atoms) {
    const auto by = static_cast<std::ptrdiff_t>(std::lround(atom.db / bin));
    for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, -by); i < std::min(end, end - by); ++i)
      result[static_cast<std::size_t>(i + by)] += atom.probability * table[static_cast<std::size_t>(i)];
  }
  return result;
}

// Densities of one reading at whole bins: the base, what is added to it, and noise.
std::vector<double> table_of(const ReadingDistribution& law, const BinGrid& grid) {
  std::vector<double> table = base_table(law, grid);
  for (const LawPart& part : law.added) table = with_added(table, part, grid.width);
  return law.noise > 0 ? smeared(table, normal_kernel(law.noise * law.noise, grid.width)) : table;
}

}  // namespace

double base_variance(const ReadingDistribution& law) {
  return law.base.law ? law.base.law->variance(law.base.params, law.draws) : 0;
}

double variance_of(const ReadingDistribution& law, double step) {
  double result = base_variance(law);
  for (const LawPart& part : law.added) result += part.law->variance(part.params, 1);
  return result + law.noise * law.noise + step * step / 12;
}

ReadingDensities::ReadingDensities(const ReadingDistribution& law, double step) : variances_{0}, table_(bins, 0) {
  constexpr int finer = 2;  // bins of the law itself, before smoothing
  constexpr double fine = bin / finer;
  const BinGrid grid{first_db - bin / 2, fine, bins * finer};
  std::vector<double> law_table = table_of(law, grid);
  const double mean = mean_of(law_table, grid);
  if (step > 0) law_table = smeared(law_table, box_kernel(step, fine));
  double total = 0;
  for (const double v : law_table) total += v * bin / finer;
  for (std::size_t i = 0; i < law_table.size(); ++i) {  // shifted by its mean, split between two bins
    const double place = (grid.centre(i) - mean - first_db) / bin;
    if (!(place >= 0 && place < bins - 1)) continue;
    const auto b = static_cast<std::size_t>(place);
    const double along = place - static_cast<double>(b), mass = law_table[i] / finer / total;
    table_[b] += (1 - along) * mass;
    table_[b + 1] += along * mass;
  }
  add_level();
}

void ReadingDensities::add_level() {
  const std::vector<double> last(table_.end() - bins, table_.end());
  const double next = std::exp(lowest + log_factor * static_cast<double>(variances_.size() - 1));
  const std::vector<double> level = smeared(last, normal_kernel(next - variances_.back(), bin));
  variances_.push_back(next);
  table_.insert(table_.end(), level.begin(), level.end());
}

void ReadingDensities::reach(double log_variance) {
  while (std::log(variances_.back()) < std::min(log_variance, highest)) add_level();
}

ReadingsApart::ReadingsApart(const ReadingDistribution& law, double step, const Eigen::VectorXd& seen) {
  const BinGrid grid{-65, bin, 520};
  std::vector<double> table = table_of(law, grid);
  if (step > 0) table = smeared(table, box_kernel(step, bin));
  std::vector<double> apart(2 * grid.count - 1, 0);  // by the difference of two bins, from the least
  double sum = 0;
  for (const double v : table) sum += v;
  for (std::size_t i = 0; i < grid.count; ++i) {
    for (std::size_t k = 0; k < grid.count; ++k) apart[grid.count - 1 + i - k] += table[i] * table[k] / (sum * sum);
  }
  sum_up(apart);
  if (seen.size() == 0) return;
  std::vector<double> sorted(seen.data(), seen.data() + seen.size());
  const auto half = sorted.begin() + seen.size() / 2;
  std::nth_element(sorted.begin(), half, sorted.end());
  if (beyond(*half) >= 0.5) return;
  double low = 0, high = *half * *half * 3;  // dB^2, of the field; half of normal differences are beyond 0.67 sd
  for (int round = 0; round < 10; ++round) {
    const double between = (low + high) / 2;
    sum_up(smeared(apart, normal_kernel(between, bin)));
    (beyond(*half) < 0.5 ? low : high) = between;
  }
}

void ReadingsApart::sum_up(const std::vector<double>& apart) {
  const std::size_t middle = apart.size() / 2;
  beyond_.assign(middle + 1, 0);
  for (std::size_t k = middle; k > 0; --k) beyond_[k - 1] = beyond_[k] + apart[middle + k] + apart[middle - k];
}

double ReadingsApart::beyond(double db) const {
  const double place = db / bin - 0.5;
  if (place < 0) return 1 + (place + 0.5) * 2 * (beyond_[0] - 1);
  const auto k = static_cast<std::size_t>(place);
  if (k + 1 >= beyond_.size()) return 0;
  return beyond_[k] + (place - static_cast<double>(k)) * (beyond_[k + 1] - beyond_[k]);
}

}  // namespace muster::diagnosis
