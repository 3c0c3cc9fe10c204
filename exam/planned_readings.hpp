// Reads a table of planned readings: transmitter, receiver, time, and the poses of both.
#pragma once

#include <string>
#include <vector>

#include "exam/plan.hpp"

namespace muster::exam {

struct PlannedReadings {
  double t = 0;  // s
  std::string tx, rx;
  Vec3 tx_at, rx_at;
  double tx_yaw = 0, rx_yaw = 0;  // rad
};

// Reads columns t[s], tx and rx, and _x[m], _y[m], _z[m] and _yaw[rad] of both, in any order. Sorted by time. Throws
// std::runtime_error with the line.
std::vector<PlannedReadings> read_plan(const std::string& csv);

}  // namespace muster::exam
