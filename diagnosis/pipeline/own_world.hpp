// Judges faults of a map or a log that bend all that is fitted without them. Each is tried in a world that has it, with
// the world's parameters and the noise fitted anew there, against the world as it is, against what the search found,
// and against each other.
#pragma once

#include <optional>

#include "diagnosis/pipeline/own_world_hypotheses.hpp"

namespace muster::diagnosis {

struct OwnWorldVerdict {
  std::optional<CauseEstimate> cause;        // the likeliest, if it is beyond all else
  std::map<std::string, double> parameters;  // of the world, fitted beside it
  std::vector<std::string> searched, not_tested;
};

// `found`: by the search in the world as it is.
OwnWorldVerdict judged_in_own_worlds(DiagnosisSetup& setup, const Diagnosis& found);

}  // namespace muster::diagnosis
