// Intersection of a ray with solids: all in the solid's frame, in double precision.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "description/robot.hpp"

namespace muster {

struct Ray {
  Eigen::Vector3d from, way;  // way: of length 1
};

// Distance along the ray to a solid, 0 from inside it, infinity if the ray misses it.
inline double entry(const Ray& ray, const Eigen::AlignedBox3d& box) {
  constexpr double never = std::numeric_limits<double>::infinity();
  double in = 0, out = never;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = ray.from[axis], low = box.min()[axis], high = box.max()[axis];
    if (ray.way[axis] == 0) {
      if (at < low || at > high) return never;
      continue;
    }
    const double one = (low - at) / ray.way[axis], other = (high - at) / ray.way[axis];
    in = std::max(in, std::min(one, other));
    out = std::min(out, std::max(one, other));
  }
  return in <= out ? in : never;
}

inline double entry(const Ray& ray, const description::Box& box) {
  return entry(ray, Eigen::AlignedBox3d(-box.size / 2, box.size / 2));
}

namespace detail {

// Interval of a ray inside a round shape: a t2 + 2 b t + c <= 0; empty if in > out.
struct Inside {
  double in, out;
};
inline Inside inside(double a, double b, double c) {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (a == 0) return c <= 0 ? Inside{-never, never} : Inside{never, -never};
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return {never, -never};
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));  // of the larger size: no cancellation
  const double one = q / a, other = q == 0 ? 0 : c / q;
  return {std::min(one, other), std::max(one, other)};
}

}  // namespace detail

inline double entry(const Ray& ray, const description::Sphere& sphere) {
  const double r = sphere.radius;
  const auto [in, out] = detail::inside(1, ray.from.dot(ray.way), ray.from.squaredNorm() - r * r);
  return in <= out && out >= 0 ? std::max(in, 0.0) : std::numeric_limits<double>::infinity();
}

inline double entry(const Ray& ray, const description::Cylinder& cylinder) {
  const auto from = ray.from.head<2>(), way = ray.way.head<2>();
  const double r = cylinder.radius, half = cylinder.length / 2;
  const auto round = detail::inside(way.squaredNorm(), from.dot(way), from.squaredNorm() - r * r);
  constexpr double never = std::numeric_limits<double>::infinity();
  if (ray.way.z() == 0 && std::abs(ray.from.z()) > half) return never;
  const double one = ray.way.z() == 0 ? -never : (-half - ray.from.z()) / ray.way.z();
  const double other = ray.way.z() == 0 ? never : (half - ray.from.z()) / ray.way.z();
  const double in = std::max({round.in, std::min(one, other), 0.0}), out = std::min(round.out, std::max(one, other));
  return in <= out ? in : never;
}

// The nearest of its faces, from either side (Moeller and Trumbore 1997).
inline double entry(const Ray& ray, const description::Mesh& mesh) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& face : mesh.faces) {
    const Eigen::Vector3d corner = mesh.vertices[face[0]];
    const Eigen::Vector3d one = mesh.vertices[face[1]] - corner, other = mesh.vertices[face[2]] - corner;
    const Eigen::Vector3d across = ray.way.cross(other);
    const double volume = one.dot(across);
    if (volume == 0) continue;  // parallel to the face
    const Eigen::Vector3d to = ray.from - corner, up = to.cross(one);
    const double u = to.dot(across) / volume, v = ray.way.dot(up) / volume, t = other.dot(up) / volume;
    if (u >= 0 && v >= 0 && u + v <= 1 && t >= 0) nearest = std::min(nearest, t);
  }
  return nearest;
}

}  // namespace muster
