// Causes without a level shift: clipping receivers, and random laws other than the world's.
#pragma once

#include "diagnosis/calibration/fit.hpp"
#include "diagnosis/causes/cause_model.hpp"
#include "diagnosis/inference/state/model_state.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

struct LawSources {
  LinkModel& model;
  const Dataset& data;
  const std::vector<Cause>& causes;    // on the plugin path
  const inference::ModelState& state;  // after the search
  const LinkReadings& readings;        // of the search
  const std::vector<Eigen::Index>& used;
  const Fit& fit;
};

// Each adds to the causes of `found`, and to its lists of tested and untestable ones.
void add_clips(const LawSources& sources, Diagnosis& found);
void add_laws(const LawSources& sources, Diagnosis& found);
// Tests for a silent floor beside the causes found: errors of the given world may hide it. `mean`, dBm: readings
// expected of the extended world. True if it is named.
bool add_silence_beside(const LawSources& sources, const Eigen::VectorXd& mean, Diagnosis& found);

}  // namespace muster::diagnosis
