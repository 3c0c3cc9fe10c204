#include "diagnosis/inference/score/bulk_inflation.hpp"

#include <algorithm>

#include "diagnosis/inference/state/null_calibration.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

using Mask = Eigen::Array<bool, Eigen::Dynamic, 1>;

// Atoms of an entry that concern most of these rows, not more than enough of them; places are all over the plan, and
// those on the same rows near the lead's.
noise::Sheet atoms_on(const Entry& entry, const Mask& rows) {
  const bool place = entry.candidate->role.over_sites || !entry.candidate->role.pieces.empty();
  const Index width = entry.candidate->design.width, most = static_cast<Index>(thresholds::bulk_atoms);
  const Index stride = std::max<Index>(1, entry.count() / most);
  std::vector<Index> kept;
  for (Index k = 0; k < entry.count(); k += stride) {
    const Mask own = (entry.atoms->middleCols(k * width, width).array() != 0).rowwise().any();
    if (!place &&
        static_cast<double>((own && rows).count()) < thresholds::same_rows_share * static_cast<double>(rows.count()))
      continue;
    for (Index j = 0; j < width; ++j) kept.push_back(k * width + j);
  }
  return (*entry.atoms)(Eigen::all, kept);
}

// Gain of each atom (rows) in each column of x, over the atom's width.
Eigen::MatrixXf gains_per_column(const OrthonormalAtoms& unit, Index width, const noise::Sheet& x) {
  Candidate plain;  // both signs: the bulk is no effect
  plain.design.width = static_cast<int>(width);
  return statistics(plain, unit.along(x)) / static_cast<float>(width);
}

// How many independent gains are among atoms (rows) in columns of white noise: the variance of one over that of their
// mean.
double independent_gains(const Eigen::MatrixXf& gains) {
  const Eigen::RowVectorXf means = gains.colwise().mean();
  const Eigen::VectorXf of_atoms = gains.rowwise().mean();
  const float one = (gains.colwise() - of_atoms).array().square().mean();
  const float mean = (means.array() - means.mean()).square().mean();
  return mean > 0 ? static_cast<double>(one / mean) : static_cast<double>(gains.rows());
}

}  // namespace

double bulk_inflation(const ModelState& state, const WhitenedModel& model, const Candidate& lead,
                      const Eigen::MatrixXd& columns) {
  const Mask rows = (columns.array() != 0).rowwise().any();
  noise::Sheet x(state.rows().size(), 1 + thresholds::bulk_nulls);  // the residual, then white noise
  x.col(0) = model.at.residual.cast<float>();
  x.rightCols(thresholds::bulk_nulls) = state.normals().leftCols(thresholds::bulk_nulls);
  Eigen::MatrixXf all(0, x.cols());
  for (const Entry& entry : state.entries()) {
    if (entry.candidate->own() != lead.own()) continue;
    noise::Sheet atoms = atoms_on(entry, rows);
    if (atoms.cols() == 0) continue;
    atoms = model.whitener.sheet(atoms);
    model.at.basis.take_out_of(atoms);
    const Index width = entry.candidate->design.width;
    const Eigen::MatrixXf more = gains_per_column({std::move(atoms), width}, width, x);
    all.conservativeResize(all.rows() + more.rows(), Eigen::NoChange);
    all.bottomRows(more.rows()) = more;
  }
  if (all.rows() < thresholds::fewest_bulk_atoms) return 1;
  // Of four groups nearly all gain where two have effects: what looks like many candidates are three or four.
  if (independent_gains(all.rightCols(thresholds::bulk_nulls)) < thresholds::fewest_independent_atoms) return 1;
  std::vector<float> nulls;
  for (Index k = 1; k < all.cols(); ++k) nulls.push_back(median(all.col(k)));
  std::sort(nulls.begin(), nulls.end());
  const float found = median(all.col(0)), usual = nulls[nulls.size() / 2];
  return found > nulls.back() && usual > 0 ? static_cast<double>(found / usual) : 1;
}

}  // namespace muster::inference
