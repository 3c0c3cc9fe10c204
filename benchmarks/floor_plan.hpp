// An office floor of square rooms with doorways, some joined in pairs, and oblique partitions that favour no axis;
// radios in it.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "scene/walls.hpp"

namespace muster::bench {

struct FloorPlan {
  double length = 0, width = 0;  // [m]
  std::vector<scene::Wall> walls;
  static constexpr int materials = 5;  // outer wall, partition, partition without a doorway, door leaf, oblique

  FloorPlan(int rooms_x, int rooms_y, double room) : length(rooms_x * room), width(rooms_y * room) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0, 1);
    const auto add = [&](double x0, double y0, double x1, double y1, int material) {
      walls.push_back({x0, y0, x1, y1, 0, 3, 0.1, material});
    };
    for (int i = 0; i <= rooms_x; ++i) {
      for (int j = 0; j < rooms_y; ++j) {
        const double x = i * room, y = j * room, door = y + room * (0.2 + 0.4 * share(random));
        if (i == 0 || i == rooms_x) {
          add(x, y, x, y + room, 0);
          continue;
        }
        add(x, y, x, door, 1);
        add(x, door, x, door + 0.9, 3);
        add(x, door + 0.9, x, y + room, 1);
      }
    }
    for (int j = 0; j <= rooms_y; ++j) {
      for (int i = 0; i < rooms_x; ++i) {
        const double x = i * room, y = j * room, gap = x + room * (0.2 + 0.4 * share(random));
        if (j == 0 || j == rooms_y) {
          add(x, y, x + room, y, 0);
        } else if ((i + j) % 2 == 0) {
          add(x, y, x + room, y, 2);
        } else {
          add(x, y, gap, y, 1);
          add(gap + 0.9, y, x + room, y, 1);
        }
      }
    }
    for (std::size_t oblique = walls.size() / 10; oblique > 0; --oblique) {
      const double x = 1 + (length - 2) * share(random), y = 1 + (width - 2) * share(random);
      const double angle = 2 * 3.14159265358979 * share(random), dx = 0.8 * std::cos(angle), dy = 0.8 * std::sin(angle);
      add(x - dx, y - dy, x + dx, y + dy, 4);
    }
  }

  // Anywhere inside, near the ground.
  std::vector<scene::Point> radios(int number) const {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0.002, 0.998);
    std::vector<scene::Point> result;
    for (int i = 0; i < number; ++i) {
      const double x = length * share(random), y = width * share(random), z = 0.1 + 0.3 * share(random);
      result.push_back({x, y, z});
    }
    return result;
  }
};

}  // namespace muster::bench
