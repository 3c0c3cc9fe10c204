// Bodies and surfaces of the world that are no walls: a mesh from a file, where it stands.
#pragma once

namespace muster {

// How a mesh is placed: scaled, turned by yaw, then moved. Solid: its surface is closed, and what it encloses counts
// once; else it is a sheet, each crossing of which counts.
struct MeshShape {
  static constexpr const char* columns = "x[m] y[m] z[m] yaw[rad] scale material:material sheet";
  double x, y, z, yaw, scale, material, sheet;
};

}  // namespace muster
