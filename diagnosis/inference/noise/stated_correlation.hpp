// Interface of the correlation that a model states for its own draws, such as an integral along the way between two
// places. Unlike the families of family.hpp it is not a function of one distance.
#pragma once

#include <cstdint>

#include "diagnosis/inference/noise/rows.hpp"

namespace muster::noise {

class StatedCorrelation {
 public:
  virtual ~StatedCorrelation() = default;
  // out[i]: covariance at sites a[i] and b[i], over the variance that the model states, at this decorrelation distance
  // [m]. Not negative, and at most 1.
  virtual void covariances(const Sites& sites, double decorrelation, const std::vector<uint32_t>& a,
                           const std::vector<uint32_t>& b, double* out) const = 0;
};

}  // namespace muster::noise
