#include "diagnosis/radio/laws/shadowing_test.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "diagnosis/inference/state/null_tail.hpp"
#include "diagnosis/radio/laws/law_likelihood.hpp"

namespace muster::diagnosis {
namespace {

constexpr double wider = 1.5;  // than a chi-square: what a family is, is not known

// The likelihood alone.
noise::Prior flat() {
  noise::Prior prior;
  prior.decorrelation_spread = prior.shared_spread = 1e3;
  return prior;
}

// What rows say by themselves: a belief about distances would hold a long one near the usual.
noise::Fit unbelieving(const inference::Bench& bench) {
  return noise::fit(bench.field(), bench.y(), bench.design(), flat(), bench.fit.covariance, 20);
}

// The variance of one reading and the share between anchors being fitted, the field's size and distance held.
double best_value(const inference::Bench& bench, const noise::Covariance& at) {
  return noise::fit(bench.field(), bench.y(), bench.design(), flat(), at, 6, noise::unstated).value;
}

// Twice the log-likelihood ratio of rows: of the fitted field against the best one near the stated one.
double gain_of_rows(const inference::Bench& bench, const noise::StatedField& stated, const noise::Fit& free) {
  constexpr double tolerance = 1.08;
  const noise::StatedField fitted = said_by(free.covariance, bench.within());
  const auto near = [&](double value, double said) { return std::clamp(value, said / tolerance, said * tolerance); };
  const double size = near(fitted.shadowing, stated.shadowing);
  const double distance = near(fitted.decorrelation, stated.decorrelation);
  double held = 1e300;
  for (const noise::Family family : noise::families) {
    for (const double start : {-0.7, 0.0, 0.7}) {  // of the log variance of one reading, beside the fitted one
      noise::Covariance at = as_stated({size, distance}, family, free.covariance.theta, bench.within());
      at.theta[2] += start;
      held = std::min(held, best_value(bench, at));
    }
  }
  return std::max(0.0, 2 * (held - best_value(bench, free.covariance)));
}

LawValue value_of(const char* name, double value, double variance_of_log) {
  const double half = 1.96 * std::sqrt(wider * variance_of_log);
  return {name, value, value * std::exp(-half), value * std::exp(half)};
}

int thousandths(double log) { return static_cast<int>(std::lround(1e3 * log)); }

double in_field(Judge& judge, const ReadingLaw& law, noise::Family family, const noise::StatedField& field) {
  const Peak there{0,
                   {family, thousandths(std::log(field.decorrelation / noise::efold(family)))},
                   thousandths(std::log(variance_of(law, judge.step())) - 2 * std::log(field.shadowing))};
  return judge.value(law, there);
}

// The log-likelihood of single readings in the likeliest field of that size and distance. Families differ in what they
// call a distance by more than data can tell, so that all within a tolerance count.
double of_any_family(Judge& judge, const ReadingLaw& law, const noise::StatedField& field) {
  double best = -1e300;
  for (const noise::Family family : noise::families) {
    for (const double tolerance : {0.9, 1.0, 1.1})
      best = std::max(best, in_field(judge, law, family, {field.shadowing, tolerance * field.decorrelation}));
  }
  return best;
}

}  // namespace

// The field that rows say is held against the stated one by rows and by readings, and the weaker word counts. Readings
// by themselves know little more than its variance over its distance where they lie dense.
LawTest field_test(ReadingField& field, double step, const ReadingLaw& law, const noise::StatedField& stated,
                   const inference::Bench& bench) {
  const noise::Fit free = unbelieving(bench);
  const noise::StatedField fitted = said_by(free.covariance, bench.within());
  const Eigen::Matrix4d spread = free.curvature.inverse();
  LawTest test{"effect.shadowing_correlation",
               {value_of("shadowing", fitted.shadowing, spread(0, 0) / 4),
                value_of("decorrelation", fitted.decorrelation, spread(1, 1))},
               gain_of_rows(bench, stated, free),
               0,
               0};
  const auto evidence = [&] { return test.gain / 2 - std::log(static_cast<double>(field.size())); };
  if (evidence() > 0) {
    Judge judge(field, step);
    const double of_readings = 2 * (of_any_family(judge, law, fitted) - of_any_family(judge, law, stated));
    test.gain = std::max(0.0, std::min(test.gain, of_readings));
  }
  test.evidence = evidence();
  test.log_p = inference::log_tail(test.gain / wider, 2);
  return test;
}

noise::StatedField stated_field(const LinkModel& model) {
  const auto stated = [&](const char* name) {
    return model.value_of("effect.shadowing_correlation", name, model.value_of("radio.fading", name, 0));
  };
  return {stated("shadowing"), stated("decorrelation")};
}

noise::Covariance fitted_to(const inference::Bench& bench, const Eigen::VectorXd& row_means) {
  const noise::Fit fit =
      noise::fit(bench.field(), row_means, bench.base(), bench.options().prior, bench.fit.covariance, 14);
  return fit.covariance;
}

}  // namespace muster::diagnosis
