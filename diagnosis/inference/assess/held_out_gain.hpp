// Held-out gains by cross-validation: of the base model, of each finding in turn, and without each finding. Over
// blocks of places, and over each grouping of several groups.
#pragma once

#include <optional>

#include "diagnosis/inference/assess/cross_validation.hpp"
#include "diagnosis/inference/assess/finding.hpp"
#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// The folds asked for last, for states of one problem. What is made of their sites outlasts a refit.
class KeptFolds {
 public:
  // Valid until the next call.
  const Folds& of(const ModelState& state, const std::vector<int>& parts);

 private:
  std::vector<int> parts_;     // of the rows
  std::vector<Index> row_of_;  // of the readings
  noise::Covariance covariance_;
  std::optional<Folds> folds_;
};

// The term that left-out readings speak against most. At left-out places: without it their error falls beyond chance;
// where all terms together raise that error beyond chance, the one that raises it most. Of left-out groups:
// where they make their error wild. A name in time also by readings at left-out times: without it their error
// falls. Nothing with too few blocks to tell.
std::optional<std::size_t> most_refuted(const ModelState& state, KeptFolds& kept);
// Fills in the held-out figures of the result and of each accepted finding.
void add_held_out_gains(const ModelState& state, KeptFolds& kept, Result& result);

}  // namespace muster::inference
