// A drive through all places of a floor that a carrier of given clearance can reach.
#pragma once

#include "exam/field_survey/scene.hpp"

namespace muster::exam::survey {

struct Pose {
  Point at;
  double yaw = 0;  // rad
};

// `count` poses at equal distances along a drive that visits every reachable place of a lattice within the rectangle
// from (0, 0) to `far`: always on to the nearest place not visited yet (breadth-first search).
std::vector<Pose> covering_drive(const std::vector<Panel>& panels, Point far, Point start, double pitch,
                                 double clearance, int count);

}  // namespace muster::exam::survey
