// Bodies and surfaces of the world other than walls: a mesh from a file, and its pose.
#pragma once

namespace muster {

// Placement of a mesh: scaled, turned by yaw, then moved. Solid: its surface is closed, and its inside counts once;
// otherwise it is a sheet, and each crossing counts.
struct MeshShape {
  static constexpr const char* columns = "x[m] y[m] z[m] yaw[rad] scale material:material sheet";
  double x, y, z, yaw, scale, material, sheet;
};

}  // namespace muster
