// Abscissa of a cause's figure: the place on its wall that a link crosses, time, a bearing, distance, or the effect
// itself.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/report/words.hpp"

namespace muster::report {

struct Abscissa {
  std::string label, unit;
  Eigen::VectorXd values;  // one a row; NaN: outside the cause
  bool log = false;
  std::vector<std::string> names{};  // values are indices of these instead
  bool is_effect = false;            // fallback: the fitted effect
};

Abscissa abscissa_of(const diagnosis::RowSummary& rows, const CauseEstimate& cause);

// An angle in degrees, from -180 to 180.
double in_degrees(double angle);

}  // namespace muster::report
