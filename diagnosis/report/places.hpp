// Places of rows: the moving end, and blocks of space.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/report/words.hpp"

namespace muster::report {

struct Places {
  Eigen::Matrix3Xd place, anchor;  // m: the end that moves more, and the other end
  std::vector<int> radio;          // the anchor's
  double width = 0, depth = 0;     // m, of the places' box
  bool vary() const { return width + depth > 1; }
};

Places places_of(const diagnosis::RowSummary& rows);

// Numbers from 0 of square blocks with this side in m.
std::vector<int> blocks_of(const Places& places, double side);

}  // namespace muster::report
