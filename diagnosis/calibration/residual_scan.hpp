// Where a fitted world misfits: structure that is left in the residual, tested along everything that could matter.
#pragma once

#include "diagnosis/calibration/fit.hpp"
#include "diagnosis/calibration/residual_structure.hpp"
#include "diagnosis/radio/links/link_features.hpp"

namespace muster::diagnosis {

// All covariates of the channel and all further columns of the data; false alarms in 5 % of sound worlds at most, over
// all looks together.
Misfit misfit_of(const LinkModel& model, const Dataset& data, const Fit& fit, const Features& features);

}  // namespace muster::diagnosis
