// The median of a sample.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace muster::diagnosis {

// The upper one of the middle two where their count is even. `values`: at least one.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace muster::diagnosis
