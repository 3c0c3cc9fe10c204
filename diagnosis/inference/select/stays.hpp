// What happens in time, where time is seen in few stays: many readings in turn at one site, then a pause. Whatever
// differs from stay to stay, be it a person who stands elsewhere, is in all readings of a stay, and each counts once.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Why what happens in time is no finding, for the report.
inline constexpr const char* chance_of_stays = "is not beyond how stays differ by chance";

// How the means of stays scatter about a design, and readings about the means; squared units of the readings.
struct StayScatter {
  Index stays = 0;
  double between = 0, within = 0;
};

StayScatter scatter_of_stays(const ModelState& state, const Eigen::MatrixXd& design);

// True if there are stays, and if a candidate in time, given by its columns, hardly changes within one.
bool differs_between_stays(const ModelState& state, const Candidate& candidate, const Eigen::MatrixXd& columns);

// True if it does, and explains no more of the means of stays beside the design than chance would (F test).
bool is_chance_of_stays(const ModelState& state, const Candidate& candidate, const Eigen::MatrixXd& columns,
                        const Eigen::MatrixXd& design);

}  // namespace muster::inference
