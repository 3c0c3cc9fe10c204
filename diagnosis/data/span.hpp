// A range of numbers.
#pragma once

namespace muster::diagnosis {

struct Span {
  double low = 0, high = 0;
  double length() const { return high - low; }
  double at(double share) const { return low + share * length(); }
};

}  // namespace muster::diagnosis
