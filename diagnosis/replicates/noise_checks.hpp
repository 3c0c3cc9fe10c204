// Errors of one kind of pieces held against the noise that was fitted: what in them is no such noise.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/replicates/pieces.hpp"

namespace muster::diagnosis {

// An error about the run without noise, the variance that the fitted noise gives it, and the piece of that run.
// `split`: that variance by other runs, or else the pieces whose draws were small by chance would be those with little
// noise.
struct CheckedPiece {
  double error = 0, variance = 0, split = 0, predicted = 0;
  bool follows = false;  // the one before it, in time
};

// Each probability is two-sided: of what is seen or more, were it the world's noise.
struct NoiseCheck {
  std::string name, unit;
  std::size_t pieces = 0;
  double measured_sd = 0, fitted_sd = 0;            // about the run without noise [unit]
  double variance_p = 1;                            // of the sum of squares, by chi-square
  double quiet_ratio = 1, quiet_p = 1;              // scatter over the fitted one: where that is small, by elsewhere
  double scale = 0, scale_stderr = 0, scale_p = 1;  // share by which pieces are longer than without noise
  double mean = 0, mean_p = 1;                      // of the errors beside that [unit]
  double correlation = 0, correlation_p = 1;        // of neighbours in time, beside both
};

// Needs eight pieces or more with a variance above 0; with fewer `pieces` of the result is 0.
NoiseCheck checked(const PieceKind& kind, const std::vector<CheckedPiece>& pieces);
// A sentence for each probability below `alpha`, the likeliest cause of the others first.
std::vector<std::string> doubts_of(const NoiseCheck& check, double alpha);

}  // namespace muster::diagnosis
