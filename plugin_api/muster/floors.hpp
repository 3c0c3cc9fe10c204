// Level floors and ceilings of the world, as links meet them.
#pragma once

namespace muster {

// A quadrilateral at a height, by its corners in turn.
struct FloorShape {
  static constexpr const char* columns = "x0[m] y0[m] x1[m] y1[m] x2[m] y2[m] x3[m] y3[m] z[m] material:material";
  double x0, y0, x1, y1, x2, y2, x3, y3, z, material;
};

}  // namespace muster
