// Readings taken at nearly the same two places, as one: what errors of neighbouring readings share is estimated on a
// few hundred clusters instead of on all pairs of readings.
#pragma once

#include <vector>

#include "diagnosis/radio/links/link_model.hpp"

namespace muster::diagnosis {

// Two places, in a canonical order of their radios, so that both directions of a link are the same.
struct LinkPlace {
  Eigen::Vector3d a, b;
  int radio_a = 0, radio_b = 0;
};

LinkPlace place_of(const std::array<End, 2>& ends);

struct Clusters {
  std::vector<int> of_row;                       // one a row of those asked for
  std::vector<double> size;                      // rows in each
  std::vector<std::vector<LinkPlace>> examples;  // up to four places of each, to average over it

  std::size_t count() const { return size.size(); }
};

// Cubes of space around both ends, as small as leaves no more than `most` clusters, and not many of a single reading.
Clusters clusters_of(const std::vector<LinkPlace>& links, std::size_t most);

}  // namespace muster::diagnosis
