// Plans of walls at random places, the same for a seed, and two free places in each.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "roadmap/route.hpp"

namespace muster::test {

namespace rm = muster::roadmap;

struct RandomPlan {
  std::vector<rm::Block> blocks;
  double radius;
  rm::Obstacles obstacles;
  rm::Area area{-2, -2, 18, 18};
  rm::Point start, goal;
};

inline RandomPlan random_plan(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  RandomPlan plan;
  const int walls = 3 + static_cast<int>(between(0, 15));
  for (int i = 0; i < walls; ++i) {
    const double x = between(0, 16), y = between(0, 16), length = between(0.5, 6);
    // Half of them along the axes and on whole metres, so that they meet, overlap and end in one another.
    const bool is_square = between(0, 1) < 0.5;
    const double yaw = is_square ? std::floor(between(0, 4)) * 1.5707963267948966 : between(0, 6.28);
    const rm::Point from = is_square ? rm::Point{std::floor(x), std::floor(y)} : rm::Point{x, y};
    plan.blocks.push_back({from, {from.x + length * std::cos(yaw), from.y + length * std::sin(yaw)}, between(0, 0.4)});
  }
  plan.radius = between(0.1, 0.4);
  plan.obstacles = rm::Obstacles(plan.blocks, plan.radius);
  const auto free_place = [&] {
    for (;;) {
      const rm::Point p{between(-1, 17), between(-1, 17)};
      if (plan.obstacles.is_free(p)) return p;
    }
  };
  plan.start = free_place();
  plan.goal = free_place();
  return plan;
}

// Shortest distance between two straight pieces, by their ends; 0 where they cross.
inline double apart(const rm::Point& a, const rm::Point& b, const rm::Point& c, const rm::Point& d) {
  const auto side = [](const rm::Point& p, const rm::Point& q, const rm::Point& r) {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  };
  if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return 0;
  return std::min({rm::distance(a, c, d), rm::distance(b, c, d), rm::distance(c, a, b), rm::distance(d, a, b)});
}

// From a straight piece to a wall as thick as it is, by the four sides that it has.
inline double apart(const rm::Point& a, const rm::Point& b, const rm::Block& wall) {
  const double length = rm::distance(wall.from, wall.to);
  const double x = -(wall.to.y - wall.from.y) / length * wall.width / 2;
  const double y = (wall.to.x - wall.from.x) / length * wall.width / 2;
  const rm::Point corners[] = {{wall.from.x + x, wall.from.y + y},
                               {wall.to.x + x, wall.to.y + y},
                               {wall.to.x - x, wall.to.y - y},
                               {wall.from.x - x, wall.from.y - y}};
  double least = 1e9;
  for (int i = 0; i < 4; ++i) least = std::min(least, apart(a, b, corners[i], corners[(i + 1) % 4]));
  return least;
}

}  // namespace muster::test
