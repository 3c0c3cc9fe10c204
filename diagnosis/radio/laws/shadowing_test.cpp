#include "diagnosis/radio/laws/shadowing_test.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "diagnosis/inference/state/null_tail.hpp"
#include "diagnosis/radio/laws/law_likelihood.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

// Flat prior: the likelihood alone.
noise::Prior flat() {
  noise::Prior prior;
  prior.decorrelation_spread = prior.shared_spread = 1e3;
  return prior;
}

// Fit without a prior, which would pull a long decorrelation distance to the usual.
noise::Fit unbelieving(const inference::ModelState& state) {
  return noise::fit(state.field(), state.y(), state.design(), flat(), state.fit.covariance, 20);
}

// Objective with the field's size and distance held, the variance of one reading and the correlation between anchors
// fitted.
double best_value(const inference::ModelState& state, const noise::Covariance& at) {
  return noise::fit(state.field(), state.y(), state.design(), flat(), at, 6, noise::unstated).value;
}

// Likelihood-ratio gain on rows: the fitted field against the best one near the stated one.
double gain_of_rows(const inference::ModelState& state, const noise::StatedField& stated, const noise::Fit& free) {
  const noise::StatedField fitted = stated_by(free.covariance, state.within());
  const auto near = [&](double value, double said) {
    return std::clamp(value, said / thresholds::stated_tolerance, said * thresholds::stated_tolerance);
  };
  const double size = near(fitted.shadowing, stated.shadowing);
  const double distance = near(fitted.decorrelation, stated.decorrelation);
  std::vector<noise::Family> families = state.field().families();
  // What readings of one place have in common beside the field, such as multipath, would shorten its distance.
  const std::vector<noise::Family> fixed = state.field().fixed_families();
  families.insert(families.end(), fixed.begin(), fixed.end());
  double held = 1e300;
  for (const noise::Family family : families) {
    for (const double start : {-0.7, 0.0, 0.7}) {  // offset of the log variance of one reading from the fitted one
      noise::Covariance at = as_stated({size, distance}, family, free.covariance.theta, state.within());
      at.theta[2] += start;
      held = std::min(held, best_value(state, at));
    }
  }
  return std::max(0.0, 2 * (held - best_value(state, free.covariance)));
}

LawValue value_of(const char* name, double value, double variance_of_log) {
  const double half = thresholds::normal95 * std::sqrt(thresholds::field_dispersion * variance_of_log);
  return {name, value, value * std::exp(-half), value * std::exp(half)};
}

int thousandths(double log) { return static_cast<int>(std::lround(1e3 * log)); }

double in_field(LawLikelihood& judge, const ReadingDistribution& law, noise::Family family,
                const noise::StatedField& field) {
  const Peak there{0,
                   {family, thousandths(std::log(field.decorrelation / noise::efold(family)))},
                   thousandths(judge.log_variance_of(law) - 2 * std::log(field.shadowing))};
  return judge.value(law, there);
}

// Log-likelihood of single readings in the likeliest field of that size and distance. The families' definitions of
// distance differ by more than the data resolve, so distances within a tolerance count.
double of_any_family(LawLikelihood& judge, const ReadingDistribution& law, const noise::StatedField& field) {
  double best = -1e300;
  for (const noise::Family family : judge.families()) {
    for (const double tolerance : {0.9, 1.0, 1.1})
      best = std::max(best, in_field(judge, law, family, {field.shadowing, tolerance * field.decorrelation}));
  }
  return best;
}

}  // namespace

// Tests the field fitted to rows, by rows and by readings; the smaller gain counts. Dense readings alone determine
// little more than the ratio of variance to distance.
LawTest field_test(KrigedReadings& field, double step, const ReadingDistribution& law, const noise::StatedField& stated,
                   const inference::ModelState& state) {
  const noise::Fit free = unbelieving(state);
  const noise::StatedField fitted = stated_by(free.covariance, state.within());
  const Eigen::Matrix4d spread = free.curvature.inverse();
  LawTest test{"",
               {value_of("shadowing", fitted.shadowing, spread(0, 0) / 4),
                value_of("decorrelation", fitted.decorrelation, spread(1, 1))},
               gain_of_rows(state, stated, free),
               0,
               0};
  const auto evidence = [&] { return test.gain / 2 - std::log(static_cast<double>(field.size())); };
  if (evidence() > 0) {
    LawLikelihood judge(field, step);
    const double of_readings = 2 * (of_any_family(judge, law, fitted) - of_any_family(judge, law, stated));
    test.gain = std::max(0.0, std::min(test.gain, of_readings));
  }
  test.evidence = evidence();
  test.log_p = inference::log_tail(test.gain / thresholds::field_dispersion, 2);
  return test;
}

noise::Covariance fitted_to(const inference::ModelState& state, const Eigen::VectorXd& row_means) {
  const noise::Fit fit =
      noise::fit(state.field(), row_means, state.base(), state.options().prior, state.fit.covariance, 14);
  return fit.covariance;
}

}  // namespace muster::diagnosis
