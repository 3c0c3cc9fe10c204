// Ends of the rows of a summary, and the radios among them that stay where they are.
#pragma once

#include <vector>

#include "diagnosis/result.hpp"

namespace muster::diagnosis {

struct RowEnd {
  int radio;
  Eigen::Vector3d at;
  bool faces;  // with a known heading
  double yaw;
};

RowEnd end_of(const RowSummary& seen, Eigen::Index row, bool sends);

// A stationary radio, as sender or as receiver.
struct StandingRadio {
  RowEnd end;
  bool sends;
};

std::vector<StandingRadio> standing_radios(const RowSummary& seen);
bool is_standing(const std::vector<StandingRadio>& radios, int radio, bool sends);

}  // namespace muster::diagnosis
