// Selects the end of each link that moves farther; if both move as far the receiver, or the one that has a heading, as
// a sender on a turntable. A robot's place and heading have the same effect in both directions of a link.
#pragma once

#include "diagnosis/radio/links/link_rows.hpp"

namespace muster::diagnosis {

struct MovingEnds {
  Eigen::MatrixXd place;             // x, y in m, one row a reading
  Eigen::VectorXd heading, bearing;  // rad: of that end; of the other end relative to it; NaN where it is unknown
  Eigen::VectorXd z;                 // m, of that end
  double climb = 0;                  // m, from the lowest to the highest place of the radio that climbs most

  // Of how many of the readings, from 0 to 1.
  double known_headings() const;
  // Of enough of them for what follows headings to be seen.
  bool headings_known() const { return known_headings() > 0.25; }
};

MovingEnds moving_ends(const LinkReadings& readings);

}  // namespace muster::diagnosis
