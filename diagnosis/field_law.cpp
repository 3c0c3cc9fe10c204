#include "diagnosis/field_law.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/judge.hpp"
#include "diagnosis/search/tail.hpp"

namespace muster::diagnosis {
namespace {

constexpr double wider = 1.5;  // than a chi-square: what a family is, is not known

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

// Twice the log-likelihood ratio of rows: of the fitted field against the best one near the stated one.
double gain_of_rows(const search::Bench& bench, const StatedField& stated) {
  constexpr double tolerance = 1.08;
  const StatedField fitted = said_by(bench.fit.covariance);
  const auto near = [&](double value, double said) { return std::clamp(value, said / tolerance, said * tolerance); };
  const double size = near(fitted.shadowing, stated.shadowing);
  const double distance = near(fitted.decorrelation, stated.decorrelation);
  double held = 1e300;
  for (const noise::Family family : noise::families) {
    for (const double start : {-0.7, 0.0, 0.7}) {  // of the log variance of one reading, beside the fitted one
      noise::Covariance at{family, bench.fit.covariance.theta};
      at.theta[0] = 2 * std::log(std::max(size, 0.05));
      at.theta[1] = std::log(distance / efold(family));
      at.theta[2] += start;
      held = std::min(held, best_value(bench, at));
    }
  }
  return std::max(0.0, 2 * (held - best_value(bench, bench.fit.covariance)));
}

LawValue value_of(const char* name, double value, double sd_of_log) {
  return {name, value, value * std::exp(-1.96 * sd_of_log), value * std::exp(1.96 * sd_of_log)};
}

int thousandths(double log) { return static_cast<int>(std::lround(1e3 * log)); }

// The likeliest field that is as stated. Families differ in what they call a distance by more than data can
// tell, so that all within a tolerance count as stated; a smoother field than Matern's has a longer one by his law.
Peak as_stated(Judge& judge, const ReadingLaw& law, const StatedField& stated) {
  const double log_variance = std::log(variance_of(law, judge.step()));
  const auto at = [&](noise::Family family, double distance) {
    Peak there{0,
               {family, thousandths(std::log(distance * stated.decorrelation / efold(family)))},
               thousandths(log_variance - 2 * std::log(stated.shadowing))};
    there.value = judge.value(law, there);
    return there;
  };
  std::vector<Peak> middle;
  for (const noise::Family family : noise::families) middle.push_back(at(family, 1));
  std::sort(middle.begin(), middle.end(), [](const Peak& a, const Peak& b) { return a.value > b.value; });
  Peak best = middle[0];
  for (std::size_t k = 0; k < 2; ++k) {
    const bool smooth =
        middle[k].shape.family == noise::Family::matern32 || middle[k].shape.family == noise::Family::matern52;
    for (const double distance : smooth ? std::array{1.12, 1.25, 1.4} : std::array{0.9, 1.0, 1.1}) {
      const Peak there = at(middle[k].shape.family, distance);
      if (there.value > best.value) best = there;
    }
  }
  return best;
}

// Whether rows and single readings speak of one field. Where readings lie dense they know its variance over its
// distance alone, and a field of twice both looks the same.
bool agree(const StatedField& a, const StatedField& b) {
  constexpr double tolerance = 1.5;
  const auto alike = [](double x, double y) { return std::abs(std::log(x / y)) < std::log(tolerance); };
  return alike(a.shadowing, b.shadowing) && alike(a.decorrelation, b.decorrelation);
}

}  // namespace

StatedField said_by(const noise::Covariance& c) {
  return {std::sqrt(c.field_variance()), c.decorrelation() * efold(c.family)};
}

LawTest field_test(ReadingField& field, double step, const ReadingLaw& law, const StatedField& stated,
                   const search::Bench& bench) {
  Judge judge(field, step);
  const double log_variance = std::log(variance_of(law, step));
  Peak best;
  for (const Peak& peak : judge.shapes(law, bench.fit.covariance)) {
    if (peak.value > best.value) best = peak;
  }
  const Peak held = as_stated(judge, law, stated);
  const double gain_of_readings = std::max(0.0, 2 * (best.value - held.value));
  const Eigen::Matrix4d spread = bench.fit.curvature.inverse();
  const double size = std::exp((log_variance - 1e-3 * best.place) / 2);
  const double distance = std::exp(1e-3 * best.shape.distance) * efold(best.shape.family);
  LawTest test{"effect.shadowing_correlation",
               {value_of("shadowing", size, std::sqrt(spread(0, 0)) / 2),
                value_of("decorrelation", distance, std::sqrt(spread(1, 1)))},
               agree({size, distance}, said_by(bench.fit.covariance))
                   ? std::min(gain_of_readings, gain_of_rows(bench, stated))
                   : 0,
               0,
               0};
  test.log_p = search::log_tail(test.gain / wider, 2);
  test.evidence = test.gain / 2 - std::log(static_cast<double>(field.size()));
  return test;
}

noise::Covariance fitted_to(const search::Bench& bench, const Eigen::VectorXd& row_means) {
  const noise::Fit fit =
      noise::fit(bench.field(), row_means, bench.base(), bench.options().prior, bench.fit.covariance, 14);
  return fit.covariance;
}

}  // namespace muster::diagnosis
