// Every atom of every candidate against what the model leaves, in whitened space.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"
#include "diagnosis/inference/state/null_calibration.hpp"

namespace muster::inference {

// Atoms whitened, without what the design explains.
UnitAtoms unit_atoms(const Entry& entry, const Stand& stand);

// The fall of the deviance by each atom; zero where the sign is wrong.
Eigen::VectorXd gains(const Candidate& candidate, const UnitAtoms& unit, const Eigen::VectorXd& residual);

// The fall of the deviance by one atom; of a whole candidate as it is, since a multiple of it means nothing.
double gain_of(const Candidate& candidate, const Stand& stand, const Eigen::MatrixXd& columns);

// A candidate at its best atom, or further.
struct Lead {
  const Entry* entry;
  Eigen::VectorXd theta;
  Eigen::MatrixXd columns;
  double gain, evidence, log_p;
  bool refined = false;
  Eigen::VectorXd all;  // the gain of every atom

  const Candidate& candidate() const { return *entry->candidate; }
};

// By falling evidence. `also` is shown the unit atoms of each candidate.
std::vector<Lead> leads(Bench& bench, const Stand& stand,
                        const std::function<void(const Candidate&, const UnitAtoms& unit)>& also = {});
void by_evidence(std::vector<Lead>& leads);

// The best theta by continuous refinement, from as many starts as the candidate asks for, or from `lead` alone. Keeps
// the lead where nothing better is found.
Lead refined(const Bench& bench, const Stand& stand, const Lead& lead, bool from_lead_alone);

}  // namespace muster::inference
