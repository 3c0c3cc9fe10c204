// Clusters readings with nearly the same two places. Shared errors of neighbouring readings are estimated on a few
// hundred clusters instead of all pairs of readings.
#pragma once

#include <vector>

#include "diagnosis/radio/links/link_model.hpp"

namespace muster::diagnosis {

// Places of both ends, in a canonical order of the radios: both directions of a link are equal.
struct LinkPlace {
  Eigen::Vector3d a, b;
  int radio_a = 0, radio_b = 0;
};

LinkPlace place_of(const std::array<End, 2>& ends);

struct Clusters {
  std::vector<int> of_row;                       // cluster of each given row
  std::vector<double> size;                      // rows in each
  std::vector<std::vector<LinkPlace>> examples;  // up to four places of each, for averages over it

  std::size_t count() const { return size.size(); }
};

// Cubes around both ends, the smallest with at most `most` clusters and few of a single reading.
Clusters clusters_of(const std::vector<LinkPlace>& links, std::size_t most);

}  // namespace muster::diagnosis
