// Contact of two convex solids, present or imminent: points with one normal, gaps, and marks that persist from step to
// step.
//
// Spheres are exact against everything, boxes against boxes. A cylinder is, to boxes and cylinders, the prism of 16
// sides around it with the middle of a side at the nearest point: exact there, 2 % of the radius too far out at its
// corners. Separating axes are those of faces and of pairs of edges (Gottschalk, Lin, Manocha 1996), and touching faces
// are clipped against each other (Sutherland, Hodgman 1974).
#pragma once

#include <Eigen/Dense>
#include <array>

namespace muster::simbody {

struct Solid {
  enum class Kind { sphere = 1, box, cylinder } kind;
  Eigen::Vector3d centre;  // [m], in the world like all here
  Eigen::Matrix3d axes;    // its own x, y, z as columns; z is a cylinder's axis
  Eigen::Vector3d half;    // [m] half edges; of a cylinder radius, radius, half length; of a sphere three radii

  double reach() const;  // radius of the bounding sphere about the centre [m]
};

struct TouchPoint {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  // in the middle of the gap [m]
  double gap = 0;                                   // [m], negative inside
  int mark = 0;                                     // the same for the same features, below 2^14
  bool of_corners = false;                          // not covered by a face
};

struct Touch {
  static constexpr int most_points = 6;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit, from the second solid to the first
  int count = 0;
  std::array<TouchPoint, most_points> points;

  void add(const TouchPoint& point) { points[count++] = point; }
};

// Points nearer than `margin` [m]; none if the solids are farther apart. A gap is the distance along the normal.
// Between features other than faces it may be shorter than the distance of the solids, and never longer, except while
// corner passes corner.
Touch touch(const Solid& a, const Solid& b, double margin);

// The solid's corners (of a cylinder: of its prism) below the height `margin` above the ground at z = 0.
Touch touch_ground(const Solid& solid, double margin);

}  // namespace muster::simbody
