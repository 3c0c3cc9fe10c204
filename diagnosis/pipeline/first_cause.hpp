// The cause in a world with which others are judged again.
#pragma once

#include "diagnosis/causes/cause_model.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

struct First {
  const CauseEstimate* found = nullptr;
  bool blockage = false;
};

// True if others are judged again in a world with this cause. Older plugins declare it by their kind.
bool goes_first(const muster_cause& cause);
// True if a finding depends on time. Blockage does not count: a random law without covariates.
bool something_changes_in_time(const Diagnosis& found);
// The strongest named cause that goes first, such as places of radios, if there are other findings or something comes
// near one. Blockage counts only beside a change in time.
First first_in_company(const Diagnosis& found, const std::vector<Cause>& causes);
// Why a cause that goes first is in doubt: one that it can be mistaken for comes near beside it, of which there may be
// more in its place. Two antennas that favour a side each were an exchange of their radios. Empty where none does.
std::string doubt_by_imitator(const CauseEstimate& first, const std::vector<inference::Check>& checks,
                              const std::vector<Cause>& causes);

}  // namespace muster::diagnosis
