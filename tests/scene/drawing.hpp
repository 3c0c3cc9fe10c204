// Shorthand for the tests' scenes, and small lattices on which a link meets wall ends, posts and tops all the time.
#pragma once

#include <random>
#include <vector>

#include "scene/walls.hpp"

namespace muster::scene {

constexpr int materials = 4;
constexpr double step = 1.0 / 4096;  // of the lattice, m

inline Wall wall(double x0, double y0, double x1, double y1, double height = 3, int material = 0) {
  return {x0, y0, x1, y1, 0, height, 0.1, material};
}

inline std::vector<int> counts(const Scene& scene, const Point& p, const Point& q) {
  std::vector<int> by_material(scene.materials(), -1);
  scene.counts(p, q, by_material.data());
  return by_material;
}

inline int count(const Scene& scene, const Point& p, const Point& q) {
  int sum = 0;
  for (const int of_material : counts(scene, p, q)) sum += of_material;
  return sum;
}

inline int count(const std::vector<Wall>& walls, const Point& p, const Point& q) {
  return count(Scene(walls, {}, materials), p, q);
}

inline std::vector<Crossing> crossings(const Scene& scene, const Point& p, const Point& q) {
  std::vector<Crossing> out;
  scene.crossings(p, q, out);
  return out;
}

// Draws on the integers 0 .. size - 1, in metres: with so few places nearly every link is degenerate somewhere.
class SmallLattice {
 public:
  explicit SmallLattice(unsigned seed, int size = 8) : random_(seed), size_(size) {}

  int below(int limit) { return static_cast<int>(random_() % static_cast<unsigned>(limit)); }
  int coordinate() { return below(size_); }
  Point point() {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return {x, y, z};
  }

  Wall any_wall() {
    Wall result;
    do {
      result = {1.0 * coordinate(), 1.0 * coordinate(), 1.0 * coordinate(), 1.0 * coordinate()};
    } while (result.x0 == result.x1 && result.y0 == result.y1);
    result.base = below(size_ / 2);
    result.height = 1 + below(size_ / 2);
    result.material = below(materials);
    return result;
  }

  std::vector<Wall> walls(int number) {
    std::vector<Wall> result;
    for (int i = 0; i < number; ++i) result.push_back(any_wall());
    return result;
  }

 private:
  std::mt19937 random_;
  int size_;
};

}  // namespace muster::scene
