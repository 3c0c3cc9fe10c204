#include "diagnosis/radio/laws/likely_blocked.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/data/median.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using State = std::array<double, 2>;  // free, blocked

// Each value less the median of those around it in time.
std::vector<double> above_running_median(const std::vector<double>& time, const Eigen::VectorXd& values, double reach) {
  std::vector<double> result;
  std::size_t first = 0, last = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    while (time[first] < time[i] - reach) ++first;
    while (last < time.size() && time[last] <= time[i] + reach) ++last;
    result.push_back(values[static_cast<Eigen::Index>(i)] - median({values.data() + first, values.data() + last}));
  }
  return result;
}

State normalised(State s) {
  const double sum = s[0] + s[1];
  return {s[0] / sum, s[1] / sum};
}

}  // namespace

std::vector<double> probability_blocked(const std::vector<double>& time, const Eigen::VectorXd& residual,
                                        const Crossings& crossings) {
  if (time.empty()) return {};
  const std::vector<double> level = above_running_median(time, residual, thresholds::median_reach * crossings.duration);
  std::vector<double> sizes(level.size());
  std::transform(level.begin(), level.end(), sizes.begin(), [](double v) { return std::abs(v); });
  const double sd = std::max(median(sizes) / thresholds::normal_quartile, thresholds::least_scatter);
  const double blocked = std::clamp(crossings.share, 0.001, 0.5), rate = 1 / (crossings.duration * (1 - blocked));
  const auto likelihood = [&](std::size_t i) {
    const auto density = [&](double off) { return std::exp(-off * off / (2 * sd * sd)) + 1e-12; };
    return State{density(level[i]), density(level[i] + crossings.loss)};
  };
  // From one reading to the next: the chain forgets its state at the rate of its two transitions together.
  const auto moved = [&](const State& s, double dt) {
    const double kept = std::exp(-rate * dt);
    return State{kept * s[0] + (1 - kept) * (1 - blocked), kept * s[1] + (1 - kept) * blocked};
  };
  std::vector<State> forward(level.size());
  for (std::size_t i = 0; i < level.size(); ++i) {
    const State before = i == 0 ? State{1 - blocked, blocked} : moved(forward[i - 1], time[i] - time[i - 1]);
    const State seen = likelihood(i);
    forward[i] = normalised({before[0] * seen[0], before[1] * seen[1]});
  }
  // The chain is reversible: its backward pass is a forward pass from the other end.
  std::vector<double> result(level.size());
  State after{1 - blocked, blocked};
  for (std::size_t i = level.size(); i-- > 0;) {
    result[i] = normalised({forward[i][0] * after[0] / (1 - blocked), forward[i][1] * after[1] / blocked})[1];
    const State seen = likelihood(i), here = normalised({after[0] * seen[0], after[1] * seen[1]});
    if (i > 0) after = moved(here, time[i] - time[i - 1]);
  }
  return result;
}

}  // namespace muster::diagnosis
