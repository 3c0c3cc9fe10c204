#include "diagnosis/inference/noise/censored_draws.hpp"

#include <algorithm>
#include <cmath>

#include "muster/random.hpp"

namespace muster::noise {
namespace {

double log_share_above(double z) { return std::log(0.5 * std::erfc(z / std::sqrt(2.0))); }

}  // namespace

double normal_above(double end, double share) {
  constexpr double far = 6, least = -8;               // standard deviations
  if (end > far) return end - std::log(share) / end;  // its tail is exponential there
  const double log_share = std::log(share) + log_share_above(std::max(end, least));
  // Newton's method on the concave logarithm, from above (Chernoff's bound), never goes too far.
  double x = std::sqrt(-2 * log_share);
  for (int k = 0; k < 40 && x > least; ++k) {
    const double hazard = std::exp(-x * x / 2) / std::sqrt(2 * M_PI) / std::exp(log_share_above(x));
    const double step = (log_share_above(x) - log_share) / hazard;
    x += step;
    if (std::abs(step) < 1e-9) break;
  }
  return std::max(x, end);
}

CensoredDraws::CensoredDraws(const Eigen::VectorXd& readings, const Bounds& bounds, const Rows& rows,
                             const Field& field, const Whitener& whitener)
    : readings_(readings), bounds_(bounds), rows_(rows), field_(field), whitener_(whitener), reach_(field, whitener) {}

std::vector<CensoredDraws::Part> CensoredDraws::parts_of(Index reading, const Eigen::VectorXd& error) const {
  const Index row = rows_.row_of()[at(reading)], twin = rows_.twin_of(reading);
  if (twin < 0) return {{row, 1, error[reading]}};
  const double half = rows_.is_second_twin(reading) ? -0.5 : 0.5;  // of the first less the second
  return {{row, 0.5, (error[reading] + error[twin]) / 2},
          {rows_.difference_of(row), half, half * (error[reading] - error[twin])}};
}

double CensoredDraws::variance_of(Index row) const {
  return field_.sites().is_alone(row) ? field_.sites().alone[at(row)] : whitener_.covariance().reading_variance();
}

void CensoredDraws::sweep(uint64_t number, const Eigen::VectorXd& mean, Eigen::VectorXd& filled) const {
  const Stream random(combined(key_of("censored readings"), number));
  Eigen::VectorXd error = filled - mean, of_rows = rows_.mean(error), whitened = whitener_(of_rows);
  for (Index i = 0; i < filled.size(); ++i) {
    const auto k = at(i);
    if (!bounds_.is_bound(k)) continue;
    // Minus the log density is a parabola in the reading: of what others let expect of its rows, and of its distance
    // from the means of these.
    double slope = 0, bend = 0;
    const std::vector<Part> parts = parts_of(i, error);
    for (const Part& part : parts) {
      const double count = rows_.count()[part.row], weight = part.share / count, variance = variance_of(part.row);
      slope += part.share * (part.error - of_rows[part.row]) / variance;
      bend += part.share * part.share * (1 - 1 / count) / variance;
      for (const Reach::Entry& e : reach_.of(part.row)) {
        slope += weight * e.weight * whitened[e.row];
        bend += weight * weight * e.weight * e.weight;
      }
    }
    const double at_most = filled[i] - slope / bend, sd = 1 / std::sqrt(bend);
    const double share = random.uniform(static_cast<uint64_t>(i));
    const double drawn = bounds_.known[k] == Known::above
                             ? at_most + sd * normal_above((bounds_.lowest(k, readings_[i]) - at_most) / sd, share)
                             : at_most - sd * normal_above((at_most - bounds_.highest(k, readings_[i])) / sd, share);
    const double moved = drawn - filled[i];
    filled[i] = drawn;
    error[i] += moved;
    for (const Part& part : parts) {
      const double by = part.share / rows_.count()[part.row] * moved;
      of_rows[part.row] += by;
      for (const Reach::Entry& e : reach_.of(part.row)) whitened[e.row] += e.weight * by;
    }
  }
}

}  // namespace muster::noise
