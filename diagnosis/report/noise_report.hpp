// A fit of noise, as JSON and as text.
#pragma once

#include "diagnosis/replicates/noise_fit.hpp"
#include "text/json.hpp"

namespace muster::report {

Json json_of(const diagnosis::NoiseFit& fit);
// `table` and `data` as the user named them.
void print(const diagnosis::NoiseFit& fit, const std::string& table, const std::string& data);

}  // namespace muster::report
