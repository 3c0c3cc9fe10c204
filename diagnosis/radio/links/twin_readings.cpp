#include "diagnosis/radio/links/twin_readings.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "diagnosis/inference/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using noise::Index;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Readings of one pair of radios in order of time: sent by the one of the lower number, and by the other.
struct BothWays {
  std::vector<Index> up, down;
};

bool at_one_place(const LinkReadings& r, Index up, Index down) {
  return (r.tx_at.col(up) - r.rx_at.col(down)).norm() < inference::thresholds::same_site &&
         (r.rx_at.col(up) - r.tx_at.col(down)).norm() < inference::thresholds::same_site;
}

std::vector<std::pair<Index, Index>> pairs_of(const LinkReadings& r, const BothWays& link) {
  std::vector<std::pair<Index, Index>> result;
  auto down = link.down.begin();
  for (const Index up : link.up) {
    while (down != link.down.end() && r.t[at(*down)] < r.t[at(up)] - thresholds::twins_apart) ++down;
    if (down == link.down.end()) break;
    if (r.t[at(*down)] > r.t[at(up)] + thresholds::twins_apart || !at_one_place(r, up, *down)) continue;
    result.emplace_back(up, *down++);
  }
  return result;
}

// Steps of a series from one entry to the next: half their mean square is the variance of what changes at once.
class Steps {
 public:
  void add(double step) { squares_.push_back(step * step / 2); }
  double count() const { return static_cast<double>(squares_.size()); }
  double variance() const { return sum(squares_.size()) / std::max(count(), 1.0); }
  // Of the smaller half of the steps, which a few readings that are far off do not touch.
  double variance_of_small() const { return sum(squares_.size() / 2) / std::max(count(), 1.0); }

 private:
  double sum(std::size_t smallest) const {
    std::vector<double> sorted = squares_;
    std::sort(sorted.begin(), sorted.end());
    return std::accumulate(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(smallest), 0.0);
  }

  std::vector<double> squares_;
};

bool share_scatter(const Steps& differences, const Steps& means) {
  return differences.variance() <= thresholds::twins_differ * means.variance() ||
         (means.variance_of_small() > 0 &&
          differences.variance_of_small() <= thresholds::twins_differ * means.variance_of_small());
}

}  // namespace

void find_twins(LinkReadings& r, const Eigen::VectorXd& residual, double step) {
  r.twin.clear();
  if (r.t.empty()) return;
  std::map<std::pair<int, int>, BothWays> links;
  for (Index i = 0; i < r.size(); ++i) {
    if (!std::isfinite(residual[i])) continue;
    const int tx = r.tx[at(i)], rx = r.rx[at(i)];
    BothWays& link = links[std::minmax(tx, rx)];
    (tx < rx ? link.up : link.down).push_back(i);
  }
  const auto earlier = [&](Index a, Index b) { return r.t[at(a)] < r.t[at(b)]; };
  std::vector<Index> twin(at(r.size()), -1);
  Steps of_means, of_differences;
  for (auto& [radios, link] : links) {
    std::stable_sort(link.up.begin(), link.up.end(), earlier);
    std::stable_sort(link.down.begin(), link.down.end(), earlier);
    double mean = 0, difference = 0;
    bool first = true;
    for (const auto& [up, down] : pairs_of(r, link)) {
      twin[at(up)] = down;
      twin[at(down)] = up;
      const double new_mean = (residual[up] + residual[down]) / 2, half = (residual[up] - residual[down]) / 2;
      if (!std::exchange(first, false)) {
        of_means.add(new_mean - mean);
        of_differences.add(half - difference);
      }
      mean = new_mean;
      difference = half;
    }
  }
  if (of_means.count() < thresholds::fewest_twins || !share_scatter(of_differences, of_means)) return;
  r.twin = std::move(twin);
  // Directions that are alike are rounded alike, and each for itself where one of them is a little off.
  const double rounded = step * step / 24;
  r.twin_variance = std::max({of_differences.variance(), rounded, std::pow(thresholds::least_difference, 2)});
}

}  // namespace muster::diagnosis
