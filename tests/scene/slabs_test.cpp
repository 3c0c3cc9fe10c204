// Slabs of a wall: everything but its open doors.
#include "scene/slabs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace muster::scene {
namespace {

// True if a place at `along`, `across` the wall and `up` above its base is inside a slab.
bool covered(const std::vector<Slab>& slabs, const Wall& wall, double along, double across, double up) {
  const double x = wall.x1 - wall.x0, y = wall.y1 - wall.y0, length = std::hypot(x, y);
  const double px = wall.x0 + (along * x - across * y) / length, py = wall.y0 + (along * y + across * x) / length;
  for (const Slab& s : slabs) {
    const double dx = px - s.x, dy = py - s.y;
    if (std::abs(dx * s.cos_yaw + dy * s.sin_yaw) < s.length / 2 &&
        std::abs(-dx * s.sin_yaw + dy * s.cos_yaw) < s.thickness / 2 && std::abs(wall.base + up - s.z) < s.height / 2)
      return true;
  }
  return false;
}

TEST(Slabs, CoverTheWallButForOpenDoors) {
  const Wall wall{1, 2, 5, 5, 0.5, 2.7, 0.2, 0};  // 5 m long
  const std::vector<Door> doors = {{0, 3, 1, 2, 0, true}, {0, 0.5, 1, 9, 0, true}, {0, 2, 0.5, 2, 0, false}};
  const auto made = slabs({wall}, doors);
  std::mt19937 random(1);
  const auto draw = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  for (int k = 0; k < 20000; ++k) {
    const double along = draw(-0.5, 5.5), across = draw(-0.2, 0.2), up = draw(-0.2, 3);
    const bool in_wall = along > 0 && along < 5 && std::abs(across) < 0.1 && up > 0 && up < 2.7;
    const bool in_door = (along > 3 && along < 4 && up < 2) || (along > 0.5 && along < 1.5);
    EXPECT_EQ(covered(made, wall, along, across, up), in_wall && !in_door) << along << " " << across << " " << up;
  }
}

TEST(Slabs, ClosedDoorMakesNoSeam) {
  const Wall wall{0, 0, 4, 0, 0, 2.7, 0.1, 0};
  const auto made = slabs({wall, wall}, {{0, 1, 1, 2, 0, false}});
  ASSERT_EQ(made.size(), 2u);
  EXPECT_EQ(made[0].length, 4);
  EXPECT_EQ(made[1].wall, 1);
}

TEST(Slabs, DoorAtAnEndLeavesNothingThere) {
  const Wall wall{0, 0, 0, 3, 0, 2, 0.1, 0};
  const auto made = slabs({wall}, {{0, 2, 1.5, 2, 0, true}});
  ASSERT_EQ(made.size(), 1u);
  EXPECT_DOUBLE_EQ(made[0].y, 1);
  EXPECT_DOUBLE_EQ(made[0].length, 2);
}

}  // namespace
}  // namespace muster::scene
