// Whether the errors of a search are correlated over places or over time (inference/noise/over_time.hpp).
#include <algorithm>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/noise/over_time.hpp"
#include "diagnosis/inference/state/model_state.hpp"
#include "diagnosis/inference/state/null_calibration.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {

// Takes errors as correlated over time if that is likelier, and if what is not fixed of them does wander. One step or
// swing is no wander: with the likeliest of these in the model it must be likelier, too.
void ModelState::correlate_over_time() {
  const std::vector<double> units =
      noise::time_units(field_.recurring(), field_.sites(), problem_.layout->times(rows_));
  if (units.empty()) return;
  const Eigen::MatrixXd beside = noise::hstack(base_, likeliest_in_time());
  const double of_places = noise::fit_families(field_, y_, beside, options_.prior)[0].value;
  double chosen = 0;
  for (const double unit : units) {
    time_unit_ = unit;
    noise::Field over_time = field_of(rows_);
    std::vector<noise::Fit> fits = noise::fit_families(over_time, y_, base_, options_.prior);
    if (fits[0].value >= families[0].value || !wanders(over_time, fits[0]) ||
        noise::fit(over_time, y_, beside, options_.prior, fits[0].covariance).value >= of_places)
      continue;
    chosen = unit;
    field_ = std::move(over_time);
    whiteners_.clear();
    families = std::move(fits);
  }
  time_unit_ = chosen;
}

// Columns of the cause in time that gains most under the noise over places, where it gains most; none where none is
// sought.
Eigen::MatrixXd ModelState::likeliest_in_time() const {
  const WhitenedModel model = whitened_model(base_, families[0].covariance);
  const Candidate* first = nullptr;
  Eigen::VectorXd theta;
  double most = 0;
  for (const Entry& entry : entries_) {
    const Candidate& c = *entry.candidate;
    if (!c.role.time_like || c.kind == Kind::smooth) continue;
    noise::Sheet atoms = model.whitener.sheet(*entry.atoms);
    model.at.basis.take_out_of(atoms);
    const OrthonormalAtoms unit(std::move(atoms), c.design.width);
    Index best = 0;
    const double gain = statistics(c, unit.along(model.at.residual.cast<float>())).col(0).maxCoeff(&best);
    if (gain <= most) continue;
    most = gain;
    first = &c;
    theta = c.design.grid[static_cast<std::size_t>(best)];
  }
  if (!first) return Eigen::MatrixXd(rows_.size(), 0);
  climb(*first, model, theta);
  return columns_of(*first, theta);
}

// Pattern search (Hooke and Jeeves 1961): a step between the moments of a grid leaves some readings on its wrong side.
void ModelState::climb(const Candidate& c, const WhitenedModel& model, Eigen::VectorXd& theta) const {
  if (!c.refinement.any()) return;
  double most = model.gain(columns_of(c, theta));
  for (double share = 1; share > 1e-2; share /= 2) {
    for (Index k = 0; k < theta.size(); ++k) {
      for (double way = share * c.refinement.step[k]; way != 0;) {
        Eigen::VectorXd next = theta;
        next[k] = std::clamp(theta[k] + way, c.refinement.lower[k], c.refinement.upper[k]);
        const double gain = model.gain(columns_of(c, next));
        if (gain > most) {
          most = gain;
          theta = next;
        } else {
          way = way == share * c.refinement.step[k] ? -way : 0;  // the other way, then no further
        }
      }
    }
  }
}

// True if the rows are likelier than without memory, beyond chance. The prior of how long it is does not count.
bool ModelState::wanders(const noise::Field& over_time, const noise::Fit& best) const {
  const noise::Prior& prior = options_.prior;
  const auto without_prior = [&](const noise::Fit& fit) {
    const double mean = prior.log_decorrelation + noise::log_scale_of(fit.covariance.family);
    const double apart = (fit.covariance.theta[1] - mean) / prior.decorrelation_spread;
    return fit.value - apart * apart / 2;
  };
  noise::Covariance forgets = best.covariance;
  forgets.theta[1] = prior.lower()[1];
  const noise::Fit without = noise::fit(over_time, y_, base_, prior, forgets, 20, {1, 0, 1, 1});
  return without_prior(without) - without_prior(best) > thresholds::over_time_nats;
}

}  // namespace muster::inference
