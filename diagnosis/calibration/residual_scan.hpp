// Scans the residual of a fitted world for structure along all covariates.
#pragma once

#include "diagnosis/calibration/fit.hpp"
#include "diagnosis/calibration/residual_structure.hpp"
#include "diagnosis/radio/links/link_features.hpp"

namespace muster::diagnosis {

// Tests all covariates of the channel and all further columns of the data. Family-wise false-alarm rate: at most 5 %
// of sound worlds.
ResidualScan residual_scan(const LinkModel& model, const Dataset& data, const Fit& fit, const Features& features);

}  // namespace muster::diagnosis
