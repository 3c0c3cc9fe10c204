#include "diagnosis/inference/score/drawn_inflation.hpp"

#include <algorithm>

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

}  // namespace

double drawn_inflation(const ModelState& state, const WhitenedModel& model, const Candidate& candidate) {
  const Eigen::MatrixXd& drawn = state.drawn();
  if (drawn.cols() == 0) return 1;
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
  const auto highest = [&](const noise::Sheet& x) {
    return median(statistics(candidate, unit.along(x)).colwise().maxCoeff());
  };
  const float usual = highest(state.normals());
  return usual > 0 ? std::max(1.0, static_cast<double>(highest(white.cast<float>()) / usual)) : 1;
}

}  // namespace muster::inference
