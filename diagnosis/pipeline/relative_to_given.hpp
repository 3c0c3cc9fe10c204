// A diagnosis of a world that was corrected for its first cause, restated relative to the world as given.
#pragma once

#include "diagnosis/pipeline/setup.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

// What the corrected world's search was made of, and the measured level of each of its rows, dBm.
struct CorrectedSearch {
  const DiagnosisSetup& setup;
  const inference::ModelState& state;
  Eigen::VectorXd measured;
};

// Puts the first cause of `given` in front of the findings of `out`. Its gain is the excess held-out error of the given
// world, with all its other findings, over the corrected one; or, where `by_itself`, what it changes before all else,
// in either world.
void begin_as_given(const Diagnosis& given, bool by_itself, const CorrectedSearch& corrected, Diagnosis& out);

}  // namespace muster::diagnosis
