#include "diagnosis/inference/noise/censored.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/inference/noise/basis.hpp"
#include "diagnosis/inference/noise/normal_tail.hpp"

namespace muster::noise {
namespace {

// The standard normal variable that as large a share of all lies above as of those above `end` lies above z.
double of_same_rank(double z, double end) {
  constexpr double most = 8, least = -4;  // standard deviations
  if (end < least) return z;
  z = std::clamp(z, std::min(end, most), most);
  return of_log_share(log_above(z) - log_above(std::min(end, most)), z, least);
}

}  // namespace

bool Bounds::any() const {
  return std::any_of(known.begin(), known.end(), [](Known k) { return k != Known::value; });
}

bool Bounds::changes() const { return any() || end.size() > 0; }

double Bounds::lowest(std::size_t i, double reading) const {
  if (!is_bound(i)) return reading;
  return known[i] == Known::above ? reading - half_code : -std::numeric_limits<double>::infinity();
}

double Bounds::highest(std::size_t i, double reading) const {
  if (!is_bound(i)) return reading;
  return known[i] == Known::below ? reading + half_code : std::numeric_limits<double>::infinity();
}

double Bounds::error(std::size_t i, double reading, double level) const {
  return std::max({lowest(i, reading) - level, level - highest(i, reading), 0.0});
}

Eigen::VectorXd imputed(const Eigen::VectorXd& readings, const Bounds& bounds, const Eigen::MatrixXd& design,
                        int rounds) {
  Eigen::VectorXd filled = readings;
  if (!bounds.changes()) return filled;
  const Basis basis = basis_of(design);
  double unknown = 0;  // sum of variances of imputed readings
  for (int round = 0; round < rounds; ++round) {
    const Eigen::VectorXd rest = basis.rest(filled);
    const Eigen::VectorXd mean = filled - rest;
    const double variance = (rest.squaredNorm() + unknown) / static_cast<double>(filled.size());
    const double sd = std::sqrt(std::max(variance, 1e-6));
    unknown = 0;
    for (Eigen::Index i = 0; i < filled.size(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (!bounds.is_bound(k)) {
        if (bounds.end.size() == 0) continue;
        filled[i] = mean[i] + sd * of_same_rank((readings[i] - mean[i]) / sd, (bounds.end[i] - mean[i]) / sd);
        continue;
      }
      const double side = bounds.known[k] == Known::above ? 1 : -1;
      const double z = side * (readings[i] - side * bounds.half_code - mean[i]) / sd;
      const double h = hazard(z);
      filled[i] = mean[i] + side * sd * h;
      unknown += variance * std::max(0.0, 1 - h * (h - z));
    }
  }
  return filled;
}

}  // namespace muster::noise
