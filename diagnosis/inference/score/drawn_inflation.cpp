#include "diagnosis/inference/score/drawn_inflation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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
    for (std::size_t part = 0; part < noise::stream_parts.size(); ++part) {
      const noise::Family same = noise::with_fixed(family, k, part);
      if (noise::fixed_share(other) == noise::fixed_share(same) &&
          noise::stream_part(other) == noise::stream_part(same))
        return same;
    }
  }
  return family;
}

// The draws, with readings that scatter as the data's do by this covariance, of which the first draw tells what they
// lack. Where a model scatters its readings less, the structure of its field would count as if nothing hid it. Half
// differences have a scatter of their own.
Eigen::MatrixXd as_scattered(const ModelState& state, Eigen::MatrixXd drawn, const noise::Covariance& covariance) {
  const noise::Sites& sites = state.field().sites();
  const double of_draws = noise::fit(state.field(), drawn.col(0), state.base(), state.options().prior, covariance)
                              .covariance.reading_variance();
  const double missing = covariance.reading_variance() - of_draws;
  if (missing <= 0) return drawn;
  for (Index i = 0; i < drawn.rows(); ++i) {
    if (sites.is_alone(i)) continue;
    const double scatter = std::sqrt(missing / sites.count[i]);
    for (Index j = 0; j < drawn.cols(); ++j)
      drawn(i, j) += scatter * static_cast<double>(state.normals()(i, j % state.normals().cols()));
  }
  return drawn;
}

}  // namespace

double drawn_inflation(const ModelState& state, const WhitenedModel& model, const Candidate& candidate,
                       const noise::StatedField& field) {
  if (state.drawn(field).cols() == 0) return 1;
  const Eigen::MatrixXd drawn = as_scattered(state, state.drawn(field), model.whitener.covariance());
  Eigen::MatrixXd white = model.at.basis.rest(model.whitener(drawn));
  // The field's own size is fitted in every data set anew.
  std::vector<Index> sharing;
  for (Index i = 0; i < white.rows(); ++i) {
    if (!state.field().sites().is_alone(i)) sharing.push_back(i);
  }
  const double usual_norm = std::sqrt(static_cast<double>(sharing.size()));
  for (Index j = 0; j < white.cols(); ++j) {
    const double norm = white.col(j)(sharing).norm();
    white.col(j)(sharing) *= usual_norm / std::max(norm, 1e-9);
  }
  const Entry& entry = state.entry_of(candidate);
  noise::Sheet atoms = model.whitener.sheet(some_atoms(entry));
  model.at.basis.take_out_of(atoms);
  const OrthonormalAtoms unit(std::move(atoms), candidate.design.width);
  // Means, since half of the gains of a cause of one sign and one atom are none.
  const auto highest = [&](const noise::Sheet& x) {
    return statistics(candidate, unit.along(x)).colwise().maxCoeff().mean();
  };
  const float usual = highest(state.normals());
  return usual > 0 ? std::max(1.0, static_cast<double>(highest(white.cast<float>()) / usual)) : 1;
}

bool within_draws(const ModelState& state, const noise::StatedField& field, double of_data,
                  const std::function<double(const Eigen::VectorXd&)>& statistic) {
  const Eigen::MatrixXd& drawn = state.drawn(field);
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (Index k = 0; k < std::min<Index>(thresholds::compared_draws, drawn.cols()); ++k) {
    const double of_draw = statistic(drawn.col(k));
    least = std::min(least, of_draw), most = std::max(most, of_draw);
    if (of_data <= most + (most - least)) return true;  // a further draw can only raise the bound
  }
  return false;
}

bool resembles_draws(const ModelState& state, const Eigen::MatrixXd& design, const noise::StatedField& field) {
  const noise::Covariance& fitted = state.fit.covariance;
  if (!state.field().correlated().stated || state.drawn(field).cols() == 0) return false;
  if (fitted.reading_variance() < thresholds::unblurred_variance) return true;
  const auto as = [&](noise::Family family) {
    return noise::as_stated(field, with_share_of(fitted.family, family), fitted.theta, state.within());
  };
  const noise::Covariance place = noise::is_stated(fitted.family) ? as(noise::Family::exponential) : fitted,
                          stated = as(noise::Family::stated);
  // Nats by which the family of places is likelier.
  const auto apart = [&](const Eigen::VectorXd& y) {
    const auto value = [&](const noise::Covariance& start) {
      return noise::fit(state.field(), y, design, state.options().prior, start).value;
    };
    return value(stated) - value(place);
  };
  return within_draws(state, field, apart(state.y()), apart);
}

}  // namespace muster::inference
