// Roadmaps of plans whose figures are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "roadmap/plan.hpp"
#include "roadmap/route.hpp"

namespace muster::test {
namespace {

namespace rm = muster::roadmap;
constexpr rm::Area everywhere{-100, -100, 100, 100};

rm::Point turned(const rm::Point& p, double yaw) {
  return {p.x * std::cos(yaw) - p.y * std::sin(yaw), p.x * std::sin(yaw) + p.y * std::cos(yaw)};
}

// A box of 4 x 2 m around the origin and a robot of 0.5 m: it turns at 2.5 1.5 and the other corners.
TEST(ClosedForms, Row49AroundOneBoxTheWayIsThatOfItsCorners) {
  for (const double yaw : {0.0, 0.4, 1.5707963267948966, 2.9}) {
    const rm::Obstacles box({{turned({-2, 0}, yaw), turned({2, 0}, yaw), 2}}, 0.5);
    const rm::Graph graph = rm::visibility_graph(box, everywhere);
    EXPECT_EQ(graph.nodes.size(), 4u);
    EXPECT_EQ(graph.edges.size(), 4u) << "its sides: across it nothing is seen";
    EXPECT_EQ(rm::branches_of(graph), 0u);
    for (const double y : {-1.4, -0.3, 0.0, 0.9}) {
      const rm::Point start = turned({-5, y}, yaw), goal = turned({5, 0.2}, yaw);
      const auto by = [&](double side) { return std::hypot(2.5, side - y) + 5 + std::hypot(2.5, side - 0.2); };
      const rm::Route way = rm::route(graph, box, start, goal);
      EXPECT_NEAR(way.length, std::min(by(1.5), by(-1.5)), 1e-9) << yaw << ' ' << y;
      EXPECT_EQ(way.points.size(), 4u);
    }
  }
}

TEST(ClosedForms, Row49AnEmptyRoomsGridHasOctileWays) {
  // 4 m x 3 m inside walls without width, a robot of 0.5 m: 7 x 5 places half a metre apart.
  const rm::Obstacles room({{{0, 0}, {4, 0}, 0}, {{4, 0}, {4, 3}, 0}, {{4, 3}, {0, 3}, 0}, {{0, 3}, {0, 0}, 0}}, 0.5);
  const rm::Graph grid = rm::lattice(room, {0, 0, 4, 3}, 0.5);
  ASSERT_EQ(grid.nodes.size(), 35u);
  EXPECT_EQ(grid.edges.size(), 6u * 5 + 7 * 4 + 2 * 6 * 4);
  EXPECT_EQ(rm::branches_of(grid), 35u) << "three pieces lead to each corner";
  EXPECT_EQ(rm::count_of(rm::components_of(grid)), 1u);
  for (std::uint32_t to = 0; to < 35; ++to) {
    const double x = std::abs(grid.nodes[to].x - grid.nodes[0].x), y = std::abs(grid.nodes[to].y - grid.nodes[0].y);
    EXPECT_NEAR(rm::cheapest(grid, 0, to, rm::length_cost).cost, std::max(x, y) + (std::sqrt(2.0) - 1) * std::min(x, y),
                1e-12);
  }
  EXPECT_NEAR(rm::free_area(room, {0, 0, 4, 3}), 3 * 2, 0.03);
}

TEST(ClosedForms, TheFreeAreaOfATurnedWallIsThatOfItsRectangle) {
  for (const double yaw : {0.0, 0.7, 2.0}) {
    const rm::Obstacles wall({{turned({-2, 0}, yaw), turned({2, 0}, yaw), 0.2}}, 0.4);
    EXPECT_NEAR(rm::free_area(wall, {-5, -5, 5, 5}), 100 - 4.8 * 1, 0.02) << yaw;
  }
}

// A wall with a gap of 0.9 m.
const std::vector<rm::Block> gap{{{0, -4}, {0, -0.45}, 0.1}, {{0, 0.45}, {0, 4}, 0.1}};

TEST(ClosedForms, ARobotGoesThroughAGapThatIsWiderThanItself) {
  for (const double radius : {0.2, 0.44, 0.45}) {
    const rm::Obstacles walls(gap, radius);
    const rm::Route way = rm::route(rm::visibility_graph(walls, everywhere), walls, {-3, 0}, {3, 0});
    EXPECT_NEAR(way.length, 6, 1e-12) << radius << " m in a gap of 0.45 m to each side";
  }
  const rm::Obstacles walls(gap, 0.46);
  EXPECT_GT(rm::route(rm::visibility_graph(walls, everywhere), walls, {-3, 0}, {3, 0}).length, 9) << "around the wall";
}

TEST(ClosedForms, APlaceNearerToAWallThanTheRadiusIsAStartAndNoGoal) {
  const rm::Obstacles walls(gap, 0.4);
  const rm::Graph graph = rm::visibility_graph(walls, everywhere);
  const rm::Point near{-0.25, 2};  // 0.2 m from the wall
  const rm::Route out = rm::route(graph, walls, near, {-3, 0});
  EXPECT_EQ(out.fault, "");
  EXPECT_NEAR(out.length, std::hypot(2.75, 2), 1e-9);
  EXPECT_EQ(rm::route(graph, walls, {-3, 0}, near).fault,
            "the goal -0.25 2 is 0.2 m from a wall; expected at least the radius, 0.4 m, on all sides");
  EXPECT_EQ(rm::route(graph, walls, {0, 2}, {-3, 0}).fault, "the start 0 2 is inside a wall");
}

TEST(ClosedForms, ARoomWithoutADoorIsAComponentOfItsOwn) {
  // A room of 6 x 6 m with a block in it, in the open.
  const rm::Obstacles room({{{0, 0}, {6, 0}, 0.1},
                            {{6, 0}, {6, 6}, 0.1},
                            {{6, 6}, {0, 6}, 0.1},
                            {{0, 6}, {0, 0}, 0.1},
                            {{2, 3}, {4, 3}, 0.5}},
                           0.3);
  for (const rm::Graph& graph : {rm::visibility_graph(room, everywhere), rm::lattice(room, {-2, -2, 8, 8}, 0.5)}) {
    EXPECT_EQ(rm::count_of(rm::components_of(graph)), 2u);
    EXPECT_EQ(rm::route(graph, room, {1, 1}, {-1.5, -1.5}).fault,
              "no way leads from 1 1 to -1.5 -1.5, which lies outside of the plan (x 0 to 6, y 0 to 6 m)");
    EXPECT_EQ(rm::route(graph, room, {3, 1}, {3, 5}).fault, "");
  }
}

TEST(ClosedForms, DoorsAreWaysWhereTheyAreOpenAndWallsAboveThemAreInNobodysWay) {
  const std::vector<Wall> walls{{0, 0, 5, 0, 0, 2.7, 0.2, 0}};
  const std::vector<Door> doors{{0, 2, 1, 2.1, null()}};
  const rm::Heights robot{0, 0.3};
  const auto blocks = [&](double open, rm::Doors which, const rm::Heights& heights) {
    return rm::blocks_of(walls, doors, std::vector<DoorState>{{open}}, which, heights).size();
  };
  EXPECT_EQ(blocks(0, rm::Doors::as_they_stand, robot), 1u);
  EXPECT_EQ(blocks(1, rm::Doors::as_they_stand, robot), 2u);
  EXPECT_EQ(blocks(0, rm::Doors::open, robot), 2u);
  EXPECT_EQ(blocks(1, rm::Doors::as_they_stand, {0, 2.4}), 3u) << "a tall robot meets what is over the door";
  EXPECT_EQ(blocks(0, rm::Doors::as_they_stand, {3, 3.5}), 0u) << "and one above the wall nothing";
}

TEST(ClosedForms, PlacesThatNoPieceLeadsToAreLeftOutAndCounted) {
  const rm::Graph graph{{{0, 0}, {5, 5}, {1, 0}, {2, 0}}, {{0, 2}, {2, 3}}};
  std::size_t alone = 0;
  const rm::Graph rest = rm::without_lone(graph, alone);
  EXPECT_EQ(alone, 1u);
  ASSERT_EQ(rest.nodes.size(), 3u);
  EXPECT_EQ(rest.nodes[1].x, 1);
  EXPECT_THAT(rm::components_of(graph), testing::ElementsAre(0, 1, 0, 0));
}

TEST(ClosedForms, ALatticeOfMoreThanAMillionPlacesIsRefused) {
  EXPECT_THROW(rm::lattice({}, {0, 0, 1000, 1000}, 0.01), std::runtime_error);
}

TEST(ClosedForms, ACostKeepsWaysAwayFromWhereItIsHigh) {
  const rm::Obstacles box({{{-2, 0}, {2, 0}, 2}}, 0.5);
  const rm::Graph graph = rm::visibility_graph(box, everywhere);
  const auto north_is_dear = [](const rm::Point& a, const rm::Point& b) {
    return rm::distance(a, b) * (a.y + b.y > 0.5 ? 3 : 1);
  };
  const rm::Point start{-5, 0.1}, goal{5, 0.1};
  EXPECT_GT(rm::route(graph, box, start, goal).points[1].y, 0);
  const rm::Route way = rm::route(graph, box, start, goal, north_is_dear);
  EXPECT_LT(way.points[1].y, 0);
  EXPECT_NEAR(way.cost, way.length, 1e-12);
}

}  // namespace
}  // namespace muster::test
