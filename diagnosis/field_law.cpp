#include "diagnosis/field_law.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "diagnosis/search/tail.hpp"

namespace muster::diagnosis {
namespace {

constexpr double distance_tolerance = 1.2, size_tolerance = 1.15;  // factors

// Decorrelation distances at which a family's correlation is 1/e.
double efold(noise::Family family) {
  double low = 0, high = 10;
  for (int round = 0; round < 50; ++round) {
    const double middle = (low + high) / 2;
    (noise::correlation(family, middle) > std::exp(-1.0) ? low : high) = middle;
  }
  return (low + high) / 2;
}

// The likelihood alone.
noise::Prior flat() {
  noise::Prior prior;
  prior.decorrelation_spread = prior.shared_spread = 1e3;
  return prior;
}

double value_at(const search::Bench& bench, const noise::Covariance& covariance) {
  const noise::Whitener whitener(bench.field(), covariance);
  return noise::whitened(whitener, bench.y(), bench.design(), flat()).value;
}

// Scoring over the variance of one reading and the share between anchors, the field's size and distance being held.
double best_value(const search::Bench& bench, noise::Covariance at) {
  const Eigen::MatrixXd design = bench.design();
  const noise::Prior prior = flat();
  double here = value_at(bench, at);
  for (int round = 0; round < 6; ++round) {
    const noise::Objective o = noise::objective(bench.field(), at, bench.y(), design, prior);
    Eigen::Vector2d gradient(o.gradient[2], o.gradient[3]);
    Eigen::Matrix2d information;
    information << o.information(2, 2) + 0.3, o.information(2, 3), o.information(3, 2), o.information(3, 3) + 0.3;
    const Eigen::Vector2d step = -information.inverse() * gradient;
    double share = std::min(1.0, 1 / step.cwiseAbs().maxCoeff());
    bool better = false;
    for (int shorter = 0; shorter < 4 && !better; ++shorter, share *= 0.35) {
      noise::Covariance next = at;
      next.theta[2] += share * step[0];
      next.theta[3] = std::clamp(next.theta[3] + share * step[1], -6.0, 4.0);
      const double there = value_at(bench, next);
      better = there < here - 0.01;
      if (better) at = next, here = there;
    }
    if (!better) break;
  }
  return here;
}

LawValue value_of(const char* name, double value, double sd_of_log) {
  return {name, value, value * std::exp(-1.96 * sd_of_log), value * std::exp(1.96 * sd_of_log)};
}

}  // namespace

StatedField said_by(const noise::Covariance& c) {
  return {std::sqrt(c.field_variance()), c.decorrelation() * efold(c.family)};
}

LawTest field_test(const search::Bench& bench, const StatedField& stated) {
  const StatedField fitted = said_by(bench.fit.covariance);
  const Eigen::Matrix4d spread = bench.fit.curvature.inverse();
  LawTest test{"effect.shadowing_correlation",
               {value_of("shadowing", fitted.shadowing, std::sqrt(spread(0, 0)) / 2),
                value_of("decorrelation", fitted.decorrelation, std::sqrt(spread(1, 1)))},
               0,
               0,
               0};
  const double size =
      std::clamp(fitted.shadowing, stated.shadowing / size_tolerance, stated.shadowing * size_tolerance);
  const double distance = std::clamp(fitted.decorrelation, stated.decorrelation / distance_tolerance,
                                     stated.decorrelation * distance_tolerance);
  if (size == fitted.shadowing && distance == fitted.decorrelation) return test;
  double held = 1e300;
  for (const noise::Family family : noise::families) {
    noise::Covariance at{family, bench.fit.covariance.theta};
    at.theta[0] = 2 * std::log(std::max(size, 0.05));
    at.theta[1] = std::log(distance / efold(family));
    held = std::min(held, best_value(bench, at));
  }
  test.gain = std::max(0.0, 2 * (held - best_value(bench, bench.fit.covariance)));
  test.log_p = search::log_tail(test.gain, 2);
  test.evidence = test.gain / 2 - bench.log_rows();
  return test;
}

noise::Covariance fitted_to(const search::Bench& bench, const Eigen::VectorXd& row_means) {
  const noise::Fit fit =
      noise::fit(bench.field(), row_means, bench.base(), bench.options().prior, bench.fit.covariance, 14);
  return fit.covariance;
}

}  // namespace muster::diagnosis
