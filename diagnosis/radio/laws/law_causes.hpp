// Causes that shift no level: receivers that clip, and laws of what is random that are not the world's.
#pragma once

#include "diagnosis/calibration/fit.hpp"
#include "diagnosis/causes/cause_model.hpp"
#include "diagnosis/inference/state/model_state.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

struct LawSources {
  LinkModel& model;
  const Dataset& data;
  const std::vector<Cause>& causes;    // of the plugin path
  const inference::ModelState& state;  // after the search
  const LinkReadings& readings;        // of the search
  const std::vector<Eigen::Index>& used;
  const Fit& fit;
};

// log p: beside other misfits, which may not be all understood, the bursts of people must be so clear.
constexpr double people_in_company = -9;

// Each adds to the causes of `found`, to what was searched and what could not be.
void add_clips(const LawSources& sources, Diagnosis& found);
void add_laws(const LawSources& sources, Diagnosis& found);
// Whether there is a silent floor beside what was found: `mean`, dBm, is what the extended world expects of every
// reading. The world as given may err by so much that it hides one.
bool add_silence_beside(const LawSources& sources, const Eigen::VectorXd& mean, Diagnosis& found);

}  // namespace muster::diagnosis
