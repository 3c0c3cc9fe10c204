// Null calibration: the effective number of independent tests of a candidate's atoms, from simulated standard normal
// residuals.
#pragma once

#include "diagnosis/inference/noise/basis.hpp"
#include "diagnosis/inference/state/candidate.hpp"

namespace muster::inference {

// Orthonormalised atoms without a second copy. For each atom a transform turns products with its columns into
// products with orthonormal ones. Zero for columns without a remainder.
class OrthonormalAtoms {
 public:
  // `width` columns an atom. A column has no remainder if a thousandth of the longest one's squared length is left of
  // it; or else a thousandth of its own atom's, `before` the model was taken out. Empty: of the longest alone.
  OrthonormalAtoms(noise::Sheet columns, Index width, const Eigen::VectorXf& before = {});

  // Products of orthonormal columns (rows of the result) with every column of x.
  Eigen::MatrixXf along(const Eigen::Ref<const noise::Sheet>& x) const;

 private:
  noise::Sheet columns_;
  Index width_;
  Eigen::MatrixXf turns_;  // transforms of the atoms, side by side
};

// Squared lengths of the projections of each column of x on each atom; zero where the sign is wrong.
Eigen::MatrixXf statistics(const Candidate& candidate, Eigen::MatrixXf along);

// The upper one of two in the middle.
float median(Eigen::VectorXf values);

// log of the number of independent tests whose maximum is distributed as that of these atoms over `normals`.
double log_effective_tests(const Candidate& candidate, const OrthonormalAtoms& unit, const noise::Sheet& normals);

}  // namespace muster::inference
