// Whether what gains beside the search's noise gains beside a longer field, too. The search holds fields short: a long
// one takes up much of what is sought. Where the errors are of a long one, a short one lets them pass for causes.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Fall of the deviance by these columns beside a design, with the noise fitted under Options::longer in either model;
// none where no field there is longer than those of the search.
std::optional<double> gain_beside_longer(const ModelState& state, const noise::Fit& beside,
                                         const Eigen::MatrixXd& design, const Eigen::MatrixXd& columns);

}  // namespace muster::inference
