// Of each link's two ends the one that goes farther, the receiver where both go as far: what depends on where a robot
// is and on which way it looks does so when it hears and when it sends.
#pragma once

#include "diagnosis/radio/links/link_rows.hpp"

namespace muster::diagnosis {

struct MovingEnds {
  Eigen::MatrixXd place;             // x, y in m, one row a reading
  Eigen::VectorXd heading, bearing;  // rad: of that end, 0 where unknown; of the other one, seen from it
};

MovingEnds moving_ends(const LinkReadings& readings);

}  // namespace muster::diagnosis
