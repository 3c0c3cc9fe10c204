// Along what a cause shows: the place on its wall that a link crosses, time, a bearing, distance, or the effect itself.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/report/words.hpp"

namespace muster::report {

struct Abscissa {
  std::string label, unit;
  Eigen::VectorXd values;  // one a row; NaN: the cause does not concern it
  bool log = false;
  std::vector<std::string> names{};  // values are numbers of these instead
  bool is_effect = false;            // nothing better was known: the effect as fitted
};

Abscissa abscissa_of(const diagnosis::RowSummary& rows, const CauseEstimate& cause);

// An angle in degrees, from -180 to 180.
double in_degrees(double angle);

}  // namespace muster::report
