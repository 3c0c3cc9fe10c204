// What holds for a roadmap of any plan.
#include "random_plans.hpp"

#include <gtest/gtest.h>

namespace muster::test {
namespace {

constexpr unsigned plans = 200;
constexpr double rounding = 1e-9;
const double octile = std::sqrt(4 - 2 * std::sqrt(2.0));  // a way of eight directions over the straight one, at most

rm::Route way_on(const RandomPlan& plan, const rm::Graph& graph, rm::Guide guide = rm::Guide::distance) {
  return rm::route(graph, plan.obstacles, plan.start, plan.goal, rm::length_cost, guide);
}

TEST(RandomPlans, Row49AStarFindsWhatDijkstraFindsAndLooksAtNoMore) {
  std::size_t ways = 0, saved = 0;
  for (unsigned seed = 0; seed < plans; ++seed) {
    const RandomPlan plan = random_plan(seed);
    for (const rm::Graph& graph :
         {rm::visibility_graph(plan.obstacles, plan.area), rm::lattice(plan.obstacles, plan.area, 0.5)}) {
      const rm::Route guided = way_on(plan, graph), all = way_on(plan, graph, rm::Guide::none);
      ASSERT_EQ(guided.fault, all.fault) << seed;
      ASSERT_NEAR(guided.length, all.length, rounding) << seed;
      ways += guided.fault.empty();
      if (graph.nodes.size() < 2) continue;
      const auto last = static_cast<std::uint32_t>(graph.nodes.size() - 1);
      const rm::Found a = rm::cheapest(graph, 0, last, rm::length_cost);
      const rm::Found d = rm::cheapest(graph, 0, last, rm::length_cost, rm::Guide::none);
      ASSERT_NEAR(a.cost, d.cost, rounding) << seed;
      saved += d.expanded > a.expanded;
    }
  }
  EXPECT_GT(ways, plans) << "most plans have a way";
  EXPECT_GT(saved, plans / 2);
}

TEST(RandomPlans, Row49EveryWayKeepsTheRadiusFromEveryWall) {
  for (unsigned seed = 0; seed < plans; ++seed) {
    const RandomPlan plan = random_plan(seed);
    for (const rm::Graph& graph :
         {rm::visibility_graph(plan.obstacles, plan.area), rm::lattice(plan.obstacles, plan.area, 1)}) {
      const rm::Route way = way_on(plan, graph);
      for (std::size_t i = 1; i < way.points.size(); ++i) {
        for (const rm::Block& wall : plan.blocks)
          ASSERT_GE(apart(way.points[i - 1], way.points[i], wall), plan.radius - 1e-6) << seed << " piece " << i;
      }
      for (const rm::Edge& e : graph.edges) {
        for (const rm::Block& wall : plan.blocks)
          ASSERT_GE(apart(graph.nodes[e.a], graph.nodes[e.b], wall), plan.radius - 1e-6) << seed;
      }
    }
  }
}

TEST(RandomPlans, Row49WaysAreNoShorterThanTheStraightLineAndTheSameBack) {
  for (unsigned seed = 0; seed < plans; ++seed) {
    RandomPlan plan = random_plan(seed);
    const rm::Graph graph = rm::visibility_graph(plan.obstacles, plan.area);
    const rm::Route there = way_on(plan, graph);
    std::swap(plan.start, plan.goal);
    const rm::Route back = way_on(plan, graph);
    ASSERT_EQ(there.fault.empty(), back.fault.empty()) << seed;
    ASSERT_NEAR(there.length, back.length, rounding) << seed;
    if (!there.fault.empty()) continue;
    const double straight = rm::distance(plan.start, plan.goal);
    EXPECT_GE(there.length, straight - rounding) << seed;
    if (plan.obstacles.is_free(plan.start, plan.goal)) {
      EXPECT_NEAR(there.length, straight, rounding) << seed;
    }
  }
}

// All corners of all grown walls, each joined to all that it sees: what de Berg et al. prove holds the shortest ways.
rm::Graph whole_visibility_graph(const RandomPlan& plan) {
  rm::Graph graph;
  for (const rm::Block& b : plan.blocks) {
    const double length = rm::distance(b.from, b.to);
    const double cx = (b.to.x - b.from.x) / length, cy = (b.to.y - b.from.y) / length;
    const double along = length / 2 + plan.radius, across = b.width / 2 + plan.radius;
    for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      const rm::Point at{(b.from.x + b.to.x) / 2 + u * along * cx - v * across * cy,
                         (b.from.y + b.to.y) / 2 + u * along * cy + v * across * cx};
      if (plan.obstacles.is_free(at)) graph.nodes.push_back(at);
    }
  }
  for (std::uint32_t a = 0; a < graph.nodes.size(); ++a)
    for (std::uint32_t b = a + 1; b < graph.nodes.size(); ++b)
      if (plan.obstacles.is_free(graph.nodes[a], graph.nodes[b])) graph.edges.push_back({a, b});
  return graph;
}

TEST(RandomPlans, Row49ThePiecesLeftOutOfTheReducedGraphMakeNoWayShorter) {
  std::size_t kept = 0, all = 0;
  for (unsigned seed = 0; seed < plans; ++seed) {
    RandomPlan plan = random_plan(seed);
    plan.area = {-100, -100, 100, 100};
    const rm::Graph reduced = rm::visibility_graph(plan.obstacles, plan.area), whole = whole_visibility_graph(plan);
    kept += reduced.edges.size(), all += whole.edges.size();
    const rm::Route a = way_on(plan, reduced), b = way_on(plan, whole);
    ASSERT_EQ(a.fault.empty(), b.fault.empty()) << seed;
    ASSERT_NEAR(a.length, b.length, 1e-6) << seed;
  }
  EXPECT_LT(kept, all * 2 / 3);
}

// A tube of 1.25 steps around a way of a robot that is so much wider is free for the robot itself. In it a lattice has
// a way: a stair along each straight piece, whose ends are moved to the nearest places, at most sqrt(1/2) steps each.
TEST(RandomPlans, Row49GridWaysAreWithinTheOctileBoundOfVisibilityWays) {
  constexpr double step = 0.2, tube = 1.25 * step;
  std::size_t compared = 0;
  for (unsigned seed = 0; seed < plans / 4; ++seed) {
    const RandomPlan plan = random_plan(seed);
    const rm::Route shortest = way_on(plan, rm::visibility_graph(plan.obstacles, {-9, -9, 25, 25}));
    const rm::Route grid = way_on(plan, rm::lattice(plan.obstacles, {-9, -9, 25, 25}, step));
    if (!grid.fault.empty()) continue;
    ASSERT_EQ(shortest.fault, "") << seed << ": a grid has no way that the visibility graph has not";
    EXPECT_GE(grid.length, shortest.length - 1e-6) << seed;
    RandomPlan wider = plan;
    wider.obstacles = rm::Obstacles(plan.blocks, plan.radius + tube);
    const rm::Route wide = way_on(wider, rm::visibility_graph(wider.obstacles, {-8, -8, 24, 24}));
    if (!wide.fault.empty()) continue;
    ++compared;
    const double pieces = static_cast<double>(wide.points.size() - 1), moved = std::sqrt(2.0) * step;
    EXPECT_LE(grid.length, octile * (wide.length + pieces * moved) + moved) << seed;
  }
  EXPECT_GT(compared, plans / 8);
}

}  // namespace
}  // namespace muster::test
