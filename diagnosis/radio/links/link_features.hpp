// Geometric features of each reading for channel models: length, directions, and walls crossed.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/radio/links/link_model.hpp"

namespace muster::diagnosis {

struct Features {
  std::vector<double> distance;                // m
  std::vector<double> azimuth, elevation;      // rad, from tx to rx, in the world frame
  std::vector<double> tx_bearing, rx_bearing;  // rad, of the other radio as seen from the antenna's heading
  std::vector<double> incidence;               // rad, mean angle to the normals of walls and floors crossed; NaN: none
  std::vector<std::string> materials, walls;   // names
  std::vector<std::vector<int>> by_material;   // [material][row]: walls and floors crossed
  // Walls crossed by row r: crossed[first[r]] ... crossed[first[r + 1] - 1].
  std::vector<std::size_t> first;
  std::vector<int> crossed;
};

Features features_of(const LinkModel& model);

// An angle in (-pi, pi].
double wrapped(double angle);

}  // namespace muster::diagnosis
