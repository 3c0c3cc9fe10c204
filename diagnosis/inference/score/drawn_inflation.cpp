#include "diagnosis/inference/score/drawn_inflation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/candidate_scores.hpp"
#include "diagnosis/inference/state/null_calibration.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

// Columns of evenly chosen atoms of an entry.
noise::Sheet some_atoms(const Entry& entry) {
  const Index width = entry.candidate->design.width;
  const Index stride = (entry.count() - 1) / static_cast<Index>(thresholds::drawn_atoms) + 1;
  std::vector<Index> kept;
  for (Index k = 0; k < entry.count(); k += stride) {
    for (Index j = 0; j < width; ++j) kept.push_back(k * width + j);
  }
  return (*entry.atoms)(Eigen::all, kept);
}

// Of the given family, with the fixed share of the other one.
noise::Family with_share_of(noise::Family other, noise::Family family) {
  for (std::size_t k = 0; k < noise::fixed_shares.size(); ++k) {
    if (noise::fixed_share(other) == noise::fixed_shares[k])
      return noise::with_fixed(family, k, noise::fixed_to_stream(other));
  }
  return family;
}

// Of the field that is drawn: in the stated family, with the fitted reading.
noise::Covariance of_draws(const ModelState& state, const noise::Covariance& fitted, const noise::StatedField& field) {
  return noise::as_stated(field, with_share_of(fitted.family, noise::Family::stated), fitted.theta, state.within());
}

// Of each draw, under one covariance.
struct UnderCovariance {
  Eigen::VectorXf highest;         // gain over the candidate's atoms
  Eigen::VectorXd log_likelihood;  // of the draw, its size fitted
};

// The field's own size is fitted in every data set anew.
UnderCovariance gains_of(const Eigen::MatrixXd& drawn, const ModelState& state, const WhitenedModel& model,
                         const Candidate& candidate, const OrthonormalAtoms& unit) {
  Eigen::MatrixXd white = model.at.basis.rest(model.whitener(drawn));
  std::vector<Index> sharing;
  for (Index i = 0; i < white.rows(); ++i) {
    if (!state.field().sites().is_alone(i)) sharing.push_back(i);
  }
  const auto count = static_cast<double>(sharing.size());
  Eigen::VectorXd log_likelihood(white.cols());
  for (Index j = 0; j < white.cols(); ++j) {
    const double norm = std::max(white.col(j)(sharing).norm(), 1e-9);
    log_likelihood[j] = model.whitener.log_scale() - count * std::log(norm);
    white.col(j)(sharing) *= std::sqrt(count) / norm;
  }
  return {statistics(candidate, unit.along(white.cast<float>())).colwise().maxCoeff(), log_likelihood};
}

OrthonormalAtoms unit_of(const ModelState& state, const WhitenedModel& model, const Candidate& candidate) {
  noise::Sheet atoms = model.whitener.sheet(some_atoms(state.entry_of(candidate)));
  model.at.basis.take_out_of(atoms);
  return {std::move(atoms), candidate.design.width};
}

// The same field, of other sizes and distances beside a reading of its own.
std::vector<noise::Covariance> around(const ModelState& state, const noise::Covariance& fitted) {
  std::vector<noise::Covariance> result;
  for (const double size : {-1.0, 0.0, 1.0}) {
    for (const double distance : {-1.0, 0.0, 1.0}) {
      noise::Covariance other = fitted;
      other.theta[0] += size * thresholds::refitted_log_variance;
      other.theta[1] += distance * thresholds::refitted_log_distance;
      other.theta = state.options().prior.inside(other.theta);
      result.push_back(other);
    }
  }
  return result;
}

// Mean of the draws' highest gains over that of white noise. Means, since half of the gains of a cause of one sign and
// one atom are none. Each draw's is under the covariance that makes it likeliest.
double inflation(const ModelState& state, const Eigen::MatrixXd& design, const Candidate& candidate,
                 const std::vector<noise::Covariance>& covariances, const Eigen::MatrixXd& drawn) {
  if (drawn.cols() == 0) return 1;
  UnderCovariance best;
  double usual = 0;
  for (const noise::Covariance& covariance : covariances) {
    const WhitenedModel model = state.whitened_model(design, covariance);
    const OrthonormalAtoms unit = unit_of(state, model, candidate);
    const UnderCovariance here = gains_of(drawn, state, model, candidate, unit);
    usual += statistics(candidate, unit.along(state.normals())).colwise().maxCoeff().mean() /
             static_cast<double>(covariances.size());
    if (best.highest.size() == 0) best = here;
    for (Index j = 0; j < drawn.cols(); ++j) {
      if (here.log_likelihood[j] <= best.log_likelihood[j]) continue;
      best.highest[j] = here.highest[j];
      best.log_likelihood[j] = here.log_likelihood[j];
    }
  }
  return usual > 0 ? std::max(1.0, best.highest.mean() / usual) : 1;
}

}  // namespace

double drawn_inflation(const ModelState& state, const Eigen::MatrixXd& design, const noise::Covariance& covariance,
                       const Candidate& candidate, const noise::StatedField& field) {
  return inflation(state, design, candidate, {covariance}, state.drawn(field));
}

double refitted_inflation(const ModelState& state, const Eigen::MatrixXd& design, const noise::Covariance& covariance,
                          const Candidate& candidate, const noise::StatedField& field) {
  return inflation(state, design, candidate, around(state, covariance), state.drawn(field));
}

HeldAgainstDraws held_against_draws(const ModelState& state, const ColumnsBeside& lead,
                                    const noise::StatedField& field) {
  const Candidate& c = lead.candidate;
  const auto held = [&](const noise::Covariance& covariance, const auto& inflation_in_draws) {
    const double gain = gain_of(c, state.whitened_model(lead.design, covariance), lead.columns),
                 by = inflation_in_draws(state, lead.design, covariance, c, field);
    return HeldAgainstDraws{state.log_p(c, gain / by, lead.columns.cols(), true), by};
  };
  HeldAgainstDraws best = held(lead.fit.covariance, drawn_inflation);
  const auto likelier = [&](HeldAgainstDraws other) {
    other.log_p += std::log(2.0);  // of two
    if (other.log_p < best.log_p) best = other;
  };
  if (best.log_p > state.threshold()) likelier(held(lead.fit.covariance, refitted_inflation));
  if (best.log_p <= state.threshold()) return best;
  const noise::Fit as_drawn =
      noise::fit(state.field(), state.y(), noise::hstack(lead.design, lead.columns), state.options().prior,
                 of_draws(state, lead.fit.covariance, field), 6, noise::unstated);
  if (as_drawn.value <= lead.fit.value + thresholds::stated_field_nats)
    likelier(held(as_drawn.covariance, drawn_inflation));
  return best;
}

bool resembles_draws(const ModelState& state, const Eigen::MatrixXd& design, const noise::StatedField& field) {
  const noise::Covariance& fitted = state.fit.covariance;
  if (!state.field().sites().stated || state.drawn(field).cols() == 0) return false;
  if (fitted.reading_variance() < thresholds::unblurred_variance) return true;
  const noise::Covariance place =
      noise::is_stated(fitted.family)
          ? noise::as_stated(field, with_share_of(fitted.family, noise::Family::exponential), fitted.theta,
                             state.within())
          : fitted;
  const noise::Covariance stated = of_draws(state, fitted, field);
  // Nats by which the family of places is likelier.
  const auto apart = [&](const Eigen::VectorXd& y) {
    const auto value = [&](const noise::Covariance& start) {
      return noise::fit(state.field(), y, design, state.options().prior, start).value;
    };
    return value(stated) - value(place);
  };
  // A further draw can only raise the bound.
  const double of_data = apart(state.y());
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (Index k = 0; k < thresholds::compared_draws; ++k) {
    const double of_draw = apart(state.drawn(field).col(k));
    least = std::min(least, of_draw), most = std::max(most, of_draw);
    if (of_data <= most + (most - least)) return true;
  }
  return false;
}

}  // namespace muster::inference
