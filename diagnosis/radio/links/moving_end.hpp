// Selects the end of each link that moves farther, or the receiver if both move as far. A robot's place and heading
// have the same effect in both directions of a link.
#pragma once

#include "diagnosis/radio/links/link_rows.hpp"

namespace muster::diagnosis {

struct MovingEnds {
  Eigen::MatrixXd place;             // x, y in m, one row a reading
  Eigen::VectorXd heading, bearing;  // rad: of that end; of the other end relative to it; NaN where it is unknown

  bool headings_known() const { return heading.allFinite(); }
};

MovingEnds moving_ends(const LinkReadings& readings);

}  // namespace muster::diagnosis
