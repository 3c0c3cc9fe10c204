// Calibration of evidence on nulls: the number of independent tests that a candidate's atoms amount to, from simulated
// standard normal residuals.
#pragma once

#include "diagnosis/inference/noise/basis.hpp"
#include "diagnosis/inference/state/candidate.hpp"

namespace muster::inference {

// Atoms made orthonormal, each within itself, without a second copy of them: the columns as they are, and for each atom
// what turns products with its columns into products with orthonormal ones; zero where nothing is left.
class UnitAtoms {
 public:
  // `width` columns an atom.
  UnitAtoms(noise::Sheet columns, Index width);

  // Products with orthonormal columns, a row each, with every column of x.
  Eigen::MatrixXf along(const Eigen::Ref<const noise::Sheet>& x) const;

 private:
  noise::Sheet columns_;
  Index width_;
  Eigen::MatrixXf turns_;  // of each atom, beside one another
};

// Squared lengths of the projections of each column of x on each atom; zero where the sign is wrong.
Eigen::MatrixXf statistics(const Candidate& candidate, Eigen::MatrixXf along);

// log of the number of independent tests whose largest statistic is distributed as that of these atoms over `normals`.
double log_effective(const Candidate& candidate, const UnitAtoms& unit, const noise::Sheet& normals);

}  // namespace muster::inference
