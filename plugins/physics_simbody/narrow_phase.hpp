// Where two convex solids touch, or would soon: points with one normal, gaps and marks that stay from step to step.
//
// Spheres are exact against everything, boxes against boxes. A cylinder is, to boxes and cylinders, the prism of 16
// sides around it that has the middle of a side where they are nearest: exact there, 2 % of the radius too far out at
// its corners. Separating axes are those of faces and of pairs of edges (Gottschalk, Lin, Manocha 1996), and touching
// faces are clipped against each other (Sutherland, Hodgman 1974).
#pragma once

#include <Eigen/Dense>
#include <array>

namespace muster::simbody {

struct Solid {
  enum class Kind { sphere = 1, box, cylinder } kind;
  Eigen::Vector3d centre;  // [m], in the world as is all here
  Eigen::Matrix3d axes;    // its own x, y, z as columns; a cylinder stands along z
  Eigen::Vector3d half;    // [m] half edges; of a cylinder radius, radius, half length; of a sphere three radii

  double reach() const;  // of a sphere about the centre that holds it [m]
};

struct TouchPoint {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  // in the middle of the gap [m]
  double gap = 0;                                   // [m], negative inside
  int mark = 0;                                     // the same for the same features, below 2^14
  bool of_corners = false;                          // before which no face lies
};

struct Touch {
  static constexpr int most_points = 6;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit, from the second solid to the first
  int count = 0;
  std::array<TouchPoint, most_points> points;

  void add(const TouchPoint& point) { points[count++] = point; }
};

// Points nearer than `margin` [m]; none where the solids are farther apart. A gap is the distance along the normal:
// where the nearest features are no faces it may be shorter than the distance between the solids, never longer, but
// where corner passes corner.
Touch touch(const Solid& a, const Solid& b, double margin);

// The solid's lowest corners (of a cylinder: of its prism) under the height `margin` above the ground at z = 0.
Touch touch_ground(const Solid& solid, double margin);

}  // namespace muster::simbody
