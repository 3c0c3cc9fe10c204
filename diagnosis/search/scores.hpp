// Every atom of every candidate against what the model leaves, in whitened space.
#pragma once

#include "diagnosis/search/bench.hpp"

namespace muster::search {

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

// Atoms whitened, without what the design explains.
UnitAtoms unit_atoms(const Entry& entry, const Stand& stand);

// The fall of the deviance by each atom; zero where the sign is wrong.
Eigen::VectorXd gains(const Candidate& candidate, const UnitAtoms& unit, const Eigen::VectorXd& residual);

// The fall of the deviance by one atom; of a whole candidate as it is, since a multiple of it means nothing.
double gain_of(const Candidate& candidate, const Stand& stand, const Eigen::MatrixXd& columns);

// log of the number of independent tests whose largest statistic is distributed as that of these atoms over `normals`.
double log_effective(const Candidate& candidate, const UnitAtoms& unit, const noise::Sheet& normals);

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

}  // namespace muster::search
