// Walls as upright boxes, with gaps where doors stand open.
#pragma once

#include <Eigen/Core>
#include <muster/plugin.hpp>
#include <vector>

namespace muster::ode {

struct WallBox {
  Eigen::Vector3d centre;  // [m]
  Eigen::Vector3d size;    // along the wall, across it, up [m]
  double heading = 0;      // of the wall, from east [rad]
};

std::vector<WallBox> wall_boxes(Rows<const Wall> walls, Rows<const Door> doors, Rows<const DoorState> states);

}  // namespace muster::ode
