// Score tests of every atom of every candidate against the model's residual, in whitened space.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"
#include "diagnosis/inference/state/null_calibration.hpp"

namespace muster::inference {

// Whitened atoms, the design projected out.
OrthonormalAtoms unit_atoms(const Entry& entry, const WhitenedModel& model);

// Fall of the deviance by each atom; zero where the sign is wrong.
Eigen::VectorXd gains(const Candidate& candidate, const OrthonormalAtoms& unit, const Eigen::VectorXd& residual);

// Fall of the deviance by one atom; of a whole candidate at its given strength.
double gain_of(const Candidate& candidate, const WhitenedModel& model, const Eigen::MatrixXd& columns);

// A candidate at its best atom, or refined.
struct ScoredCandidate {
  const Entry* entry;
  Eigen::VectorXd theta;
  Eigen::MatrixXd columns;
  double gain, evidence, log_p;
  bool refined = false;
  Eigen::VectorXd all;   // the gain of every atom
  double inflation = 1;  // in draws of the model, where it was compared with them

  const Candidate& candidate() const { return *entry->candidate; }
};

// All candidates, sorted by falling evidence. `also` is called with each candidate's atoms.
std::vector<ScoredCandidate> scored_candidates(
    ModelState& state, const WhitenedModel& model,
    const std::function<void(const Candidate&, const OrthonormalAtoms& unit)>& also = {});
void by_evidence(std::vector<ScoredCandidate>& leads);

// Refines theta continuously from the candidate's number of starts, or from `lead` alone. Returns the lead if nothing
// is better.
ScoredCandidate refined(const ModelState& state, const WhitenedModel& model, const ScoredCandidate& lead,
                        bool from_lead_alone);

// Refined in nearly white noise, where a theta gains as much as its columns overlap the best: beside a field nearly all
// of a gain lies at edges, and a rectangle of other sides has little. Its gain is that beside the model's field.
ScoredCandidate refined_by_overlap(const ModelState& state, const WhitenedModel& model, const Entry& entry);

}  // namespace muster::inference
