// Detection of a plan's rooms from its walls alone.
#include "diagnosis/radio/links/room_detection.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace muster::diagnosis {
namespace {

constexpr double angle = 0.4;

std::array<double, 2> turned(double x, double y) {
  return {std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y};
}

std::array<double, 4> wall(double x0, double y0, double x1, double y1) {
  const auto a = turned(x0, y0), b = turned(x1, y1);
  return {a[0], a[1], b[0], b[1]};
}

// Two adjacent rooms of 4 x 3 and 6 x 3 m, with gaps of 5 cm at the corners, as of thick walls.
std::vector<std::array<double, 4>> two_rooms() {
  return {wall(0, 0, 9.95, 0), wall(0, 3, 10, 3), wall(0, 0.05, 0, 3), wall(4, 0, 4, 2.95), wall(10, 0, 10, 3)};
}

TEST(RoomDetection, FindsEnclosedRoomsMostVisitedFirst) {
  const auto rooms = rooms_of(two_rooms(), angle, {turned(1, 1), turned(7, 2), turned(9, 0.5), turned(12, 1)});
  ASSERT_EQ(rooms.size(), 2u);
  EXPECT_EQ(rooms[0].visits, 2);
  EXPECT_EQ(rooms[1].visits, 1);
  const auto at = turned(7, 1.5);
  EXPECT_NEAR(rooms[0].bounds.x, at[0], 0.1);
  EXPECT_NEAR(rooms[0].bounds.y, at[1], 0.1);
  EXPECT_NEAR(rooms[0].bounds.length, 6, 0.2);
  EXPECT_NEAR(rooms[0].bounds.width, 3, 0.2);
  EXPECT_EQ(rooms[0].bounds.angle, angle);
  EXPECT_NEAR(rooms[1].bounds.length, 4, 0.2);
}

TEST(RoomDetection, ExcludesSpacesOpenToTheOutside) {
  auto walls = two_rooms();
  walls.pop_back();
  const auto rooms = rooms_of(walls, angle, {turned(1, 1), turned(7, 2)});
  ASSERT_EQ(rooms.size(), 1u);
  EXPECT_NEAR(rooms[0].bounds.length, 4, 0.2);
}

// Without it both bays were one room, and clutter that fills one of them was silent.
TEST(RoomDetection, AGapInALineOfWallsIsADoorway) {
  auto walls = two_rooms();
  walls[3] = wall(4, 0, 4, 0.4);
  walls.push_back(wall(4, 2.4, 4, 2.95));
  const std::vector<std::array<double, 2>> places{turned(1, 1), turned(7, 2)};
  EXPECT_EQ(rooms_of(walls, angle, places).size(), 2u);
  walls.back() = wall(4.3, 2.4, 4.3, 2.95);  // beside the line, and not across the way
  EXPECT_EQ(rooms_of(walls, angle, places).size(), 1u);
}

// A corridor 2 m wide, and on either side of it a partition that ends at its wall: both in one line by chance.
TEST(RoomDetection, PartitionsOnEitherSideOfACorridorAreNoDoorway) {
  const std::vector<std::array<double, 4>> walls{wall(0, 0, 12, 0),   wall(0, 4, 12, 4), wall(0, 6, 12, 6),
                                                 wall(0, 10, 12, 10), wall(0, 0, 0, 10), wall(12, 0, 12, 10),
                                                 wall(5, 0, 5, 4),    wall(5, 6, 5, 10)};
  EXPECT_EQ(rooms_of(walls, angle, {turned(2, 5), turned(10, 5)}).size(), 1u);
}

TEST(RoomDetection, FindsNoneWithoutWalls) { EXPECT_TRUE(rooms_of({}, 0, {{1, 1}}).empty()); }

// Cells grow with the plan, up to their maximum number.
TEST(RoomDetection, HandlesALargePlan) {
  const auto rooms =
      rooms_of({wall(0, 0, 2000, 0), wall(0, 900, 2000, 900), wall(0, 0, 0, 900), wall(2000, 0, 2000, 900)}, angle,
               {turned(1000, 400)});
  ASSERT_EQ(rooms.size(), 1u);
  EXPECT_NEAR(rooms[0].bounds.length, 2000, 5);
}

}  // namespace
}  // namespace muster::diagnosis
