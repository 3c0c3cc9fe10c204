// Hard links, through every kernel, against references. One is the twin, which moves the radios and computes in
// rational numbers, where nearly every link is degenerate. The other has radios shifted by symbols, on large floors.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "drawing.hpp"
#include "scene/lattice.hpp"
#include "shifted.hpp"
#include "twin.hpp"

namespace muster::scene {

// Twelve walls and doors in every second, half a metre wide or more at every half metre: their posts fall between
// lattice points of an oblique wall.
struct Building {
  std::vector<Wall> walls;
  std::vector<Door> doors;

  explicit Building(SmallLattice& lattice) : walls(lattice.walls(12)) {
    for (int row = 0; row < 12; row += 2) {
      const Wall& wall = walls[row];
      const double length = std::hypot(wall.x1 - wall.x0, wall.y1 - wall.y0);
      double end = 0;
      while (true) {
        const double at = end + 0.5 * lattice.below(3), width = 0.5 * (1 + lattice.below(3));
        if (at + width > length) break;
        const double height = 0.5 * (1 + lattice.below(2 * static_cast<int>(wall.height)));
        doors.push_back({row, at, width, height, lattice.below(materials), lattice.below(2) == 1});
        end = at + width;
      }
    }
  }
};

inline std::vector<Pair> all_pairs(std::size_t points) {
  std::vector<Pair> result;
  for (std::uint32_t from = 0; from < points; ++from) {
    for (std::uint32_t to = 0; to < points; ++to) result.push_back({from, to});
  }
  return result;
}

// Counts of every kernel, each against the first; empty if they differ.
inline std::vector<int> counts_of_all_kernels(const Scene& scene, const std::vector<Point>& points,
                                              const std::vector<Pair>& links) {
  std::vector<int> first, again;
  for (int i = 0; i < wall_kernels().number; ++i) {
    scene.counts(points, links, i == 0 ? first : again, *wall_kernels().all[i]);
    if (i > 0 && again != first) {
      ADD_FAILURE() << wall_kernels().all[i]->name << " counts otherwise than " << wall_kernels().all[0]->name;
      return {};
    }
  }
  return first;
}

inline std::string text(const Point& p) {
  return std::to_string(p.x) + ' ' + std::to_string(p.y) + ' ' + std::to_string(p.z) + "; ";
}

// Calls exact(link, by_material), which fills the crossings of the link, for each. False at the first that differs.
template <class Exact>
bool agree(const Scene& scene, const std::vector<Point>& points, const std::vector<Pair>& links, const Exact& exact) {
  const std::vector<int> counted = counts_of_all_kernels(scene, points, links);
  if (counted.empty()) return false;
  std::vector<int> expected(scene.materials()), found(scene.materials());
  for (std::size_t i = 0; i < links.size(); ++i) {
    exact(links[i], expected.data());
    for (int m = 0; m < scene.materials(); ++m) found[m] = counted[static_cast<std::size_t>(m) * links.size() + i];
    if (found == expected) continue;
    EXPECT_EQ(found, expected) << "link " << text(points[links[i].from]) << text(points[links[i].to]);
    return false;
  }
  return true;
}

// Buildings on whole metres from 0 to 7, against the twin: all links of many points at once, and of few. Returns the
// number of links, or 0 if one was wrong.
inline long compare_with_twin(unsigned seed, int buildings) {
  SmallLattice lattice(seed);
  long compared = 0;
  for (int i = 0; i < buildings; ++i) {
    const Building drawn(lattice);
    const Scene scene(drawn.walls, drawn.doors, materials);
    const Twin twin(drawn.walls, drawn.doors);
    for (const std::size_t number : {31u, 7u}) {
      std::vector<Point> points;
      for (std::size_t k = 0; k < number; ++k) points.push_back(lattice.point());
      const auto links = all_pairs(number);
      const auto exact = [&](const Pair& link, int* by_material) {
        std::fill_n(by_material, materials, 0);
        for (const auto& [wall, door] : twin.crossings(points[link.from], points[link.to])) {
          ++by_material[door < 0 ? drawn.walls[wall].material : drawn.doors[door].material];
        }
      };
      if (!agree(scene, points, links, exact)) return 0;
      compared += static_cast<long>(links.size());
    }
  }
  return compared;
}

// A storey of a building far from the origin, walls askew, and radios at critical places: on walls and their ends, a
// lattice step beside them, in line with them, one on another.
class Storey {
 public:
  explicit Storey(unsigned seed, int rows = 10, int columns = 14)
      : random_(seed), x_((970 - 3 * (rows + columns)) * real(-1, 1)), y_((970 - 3 * (rows + columns)) * real(-1, 1)) {
    const double turn = random_() % 2 == 0 ? 0 : real(0, 7);
    const double dx = 3 * std::cos(turn), dy = 3 * std::sin(turn);
    for (int i = 0; i < columns; ++i) {
      for (int k = 0; k < rows; ++k) {
        const double x = x_ + i * dx - k * dy, y = y_ + i * dy + k * dx;
        if (below(4) > 0) add(x, y, x + dx, y + dy);
        if (below(4) > 0) add(x, y, x - dy, y + dx);
        if (below(8) == 0) add(x + real(0, 3), y + real(0, 3), x + real(0, 3), y + real(0, 3));
      }
    }
    for (int row = 0; row < static_cast<int>(walls.size()); row += 9) {
      if (length(walls[row]) > 2) doors.push_back({row, 0.5, 0.9, 1.5, below(materials), below(2) == 0});
    }
  }

  Point point() {
    const Wall& wall = walls[below(static_cast<int>(walls.size()))];
    const double along = below(3) == 0 ? below(2) : real(-1.5, 2.5), aside = below(3) == 0 ? below(3) - 1 : 0;
    const double z = below(3) == 0 ? wall.base + below(2) * wall.height : real(0, 4);
    if (below(4) == 0) return {x_ + real(-40, 50), y_ + real(-40, 50), z};
    return {wall.x0 + along * (wall.x1 - wall.x0) + aside * step, wall.y0 + along * (wall.y1 - wall.y0), z};
  }

  std::vector<Wall> walls;
  std::vector<Door> doors;

 private:
  int below(int limit) { return static_cast<int>(random_() % static_cast<unsigned>(limit)); }
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  static double length(const Wall& wall) { return std::hypot(wall.x1 - wall.x0, wall.y1 - wall.y0); }
  void add(double x0, double y0, double x1, double y1) {
    const Wall drawn{x0, y0, x1, y1, below(5) == 0 ? 1.0 : 0.0, 1.0 + below(3), 0.1, below(materials)};
    if (length(drawn) > 0.01) walls.push_back(drawn);
  }

  std::mt19937 random_;
  double x_, y_;
};

// Floors of some 250 walls, or with so many rows and columns of rooms: many links at once and one at a time, against
// shifted radios. Returns the number of links, or 0 if one was wrong.
inline long compare_with_shifted_radios(unsigned seed, int floors, int rows = 10, int columns = 14) {
  long compared = 0;
  for (int i = 0; i < floors; ++i) {
    Storey storey(seed + static_cast<unsigned>(i), rows, columns);
    const Scene scene(storey.walls, storey.doors, materials);
    const ShiftedRadios shifted(storey.walls, storey.doors);
    for (const int number : {100, 10}) {
      std::vector<Point> points;
      for (int k = 0; k < number; ++k) points.push_back(storey.point());
      const auto links = all_pairs(points.size());
      bool alone = true;
      const auto exact = [&](const Pair& link, int* by_material) {
        int of_one[materials];
        scene.counts(points[link.from], points[link.to], of_one);
        std::fill_n(by_material, materials, 0);
        shifted.add_counts(points[link.from], points[link.to], by_material);
        alone = alone && std::equal(of_one, of_one + materials, by_material);
      };
      if (!agree(scene, points, links, exact)) return 0;
      EXPECT_TRUE(alone) << "a single link is counted otherwise, of storey " << seed + static_cast<unsigned>(i);
      if (!alone) return 0;
      compared += static_cast<long>(links.size());
    }
  }
  return compared;
}

}  // namespace muster::scene
