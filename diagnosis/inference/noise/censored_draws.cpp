#include "diagnosis/inference/noise/censored_draws.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/inference/noise/normal_tail.hpp"
#include "muster/random.hpp"

namespace muster::noise {
double normal_above(double end, double share) {
  constexpr double far = 6, least = -8;               // standard deviations
  if (end > far) return end - std::log(share) / end;  // its tail is exponential there
  const double log_share = std::log(share) + log_above(std::max(end, least));
  return std::max(of_log_share(log_share, std::sqrt(-2 * log_share), least), end);  // from Chernoff's bound
}

CensoredDraws::CensoredDraws(const Eigen::VectorXd& readings, const Bounds& bounds, const Rows& rows,
                             const Field& field, const Whitener& whitener)
    : readings_(readings), bounds_(bounds), rows_(rows), field_(field), whitener_(whitener), reach_(field, whitener) {}

double CensoredDraws::variance_of(Index row) const {
  return field_.sites().is_alone(row) ? field_.sites().alone[at(row)] : whitener_.covariance().reading_variance();
}

void CensoredDraws::sweep(uint64_t number, const Eigen::VectorXd& mean, Eigen::VectorXd& filled) const {
  const Stream random(combined(key_of("censored readings"), number));
  Eigen::VectorXd error = filled - mean, of_rows = rows_.mean(error), whitened = whitener_(of_rows);
  for (Index i = 0; i < filled.size(); ++i) {
    const auto k = at(i);
    if (!bounds_.is_bound(k)) continue;
    // Minus the log density is a parabola in the reading: of what others let expect of its row, and of its distance
    // from the row's mean. No censored reading has a twin, so that its row is one of means.
    const Index row = rows_.row_of()[k];
    const double weight = 1 / rows_.count()[row], variance = variance_of(row);
    double slope = (error[i] - of_rows[row]) / variance, bend = (1 - weight) / variance;
    for (const Reach::Entry& e : reach_.of(row)) {
      slope += weight * e.weight * whitened[e.row];
      bend += weight * weight * e.weight * e.weight;
    }
    const double expected = filled[i] - slope / bend, sd = 1 / std::sqrt(bend);
    const double share = random.uniform(static_cast<uint64_t>(i));
    const double drawn = bounds_.known[k] == Known::above
                             ? expected + sd * normal_above((bounds_.lowest(k, readings_[i]) - expected) / sd, share)
                             : expected - sd * normal_above((expected - bounds_.highest(k, readings_[i])) / sd, share);
    const double moved = drawn - filled[i];
    filled[i] = drawn;
    error[i] += moved;
    of_rows[row] += weight * moved;
    for (const Reach::Entry& e : reach_.of(row)) whitened[e.row] += e.weight * weight * moved;
  }
}

}  // namespace muster::noise
