// Random points and surfaces, some where nearly every link is degenerate, others far apart.
#pragma once

#include <random>
#include <scene/triangle.hpp>
#include <vector>

namespace muster {

using scene::Triangle;
using scene::Vector;

class Drawing {
 public:
  explicit Drawing(unsigned seed) : random_(seed) {}

  std::int64_t below(std::int64_t n) { return std::uniform_int_distribution<std::int64_t>(0, n - 1)(random_); }
  // On a cube of `places` places a side, `step` apart.
  Vector point(std::int64_t places, std::int64_t step) {
    return {step * below(places), step * below(places), step * below(places)};
  }
  Triangle triangle(std::int64_t places, std::int64_t step) {
    return {point(places, step), point(places, step), point(places, step)};
  }

 private:
  std::mt19937_64 random_;
};

// Closed: every edge belongs to two faces, also where corners fall together.
inline std::vector<Triangle> tetrahedron(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  return {{a, b, c}, {a, d, b}, {b, d, c}, {c, d, a}};
}

// The faces of an upright box whose ground plan is this parallelogram: `corner`, and two sides from it.
inline std::vector<Triangle> box(const Vector& corner, const Vector& side, const Vector& other, std::int64_t height) {
  const auto at = [&](int i, int j, int k) -> Vector {
    return {corner.x + i * side.x + j * other.x, corner.y + i * side.y + j * other.y, corner.z + k * height};
  };
  std::vector<Triangle> result;
  const auto face = [&](const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
    result.push_back({a, b, c}), result.push_back({a, c, d});
  };
  for (const int end : {0, 1}) {
    face(at(0, 0, end), at(1, 0, end), at(1, 1, end), at(0, 1, end));
    face(at(0, end, 0), at(1, end, 0), at(1, end, 1), at(0, end, 1));
    face(at(end, 0, 0), at(end, 1, 0), at(end, 1, 1), at(end, 0, 1));
  }
  return result;
}

}  // namespace muster
