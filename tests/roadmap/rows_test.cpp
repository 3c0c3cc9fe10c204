// A roadmap as a table, and back.
#include "roadmap/rows.hpp"

#include <gtest/gtest.h>

#include <muster/plugin.hpp>

#include "random_plans.hpp"

namespace muster::test {
namespace {

TEST(RoadmapRows, AreTheSameRoadmapAgain) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const RandomPlan plan = random_plan(seed);
    std::size_t alone = 0;
    const rm::Graph graph = rm::without_lone(rm::visibility_graph(plan.obstacles, plan.area), alone);
    const auto rows = rm::rows_of(graph, plan.obstacles);
    ASSERT_EQ(rows.size(), graph.edges.size() + plan.blocks.size());
    const rm::Map map = rm::map_of(rows.data(), rows.size());
    ASSERT_EQ(map.graph.nodes.size(), graph.nodes.size());
    EXPECT_EQ(map.obstacles.radius(), plan.radius);
    const rm::Route one = rm::route(graph, plan.obstacles, plan.start, plan.goal);
    const rm::Route other = rm::route(map.graph, map.obstacles, plan.start, plan.goal);
    EXPECT_EQ(one.length, other.length) << seed;
    EXPECT_EQ(one.fault, other.fault);
  }
}

std::string fault_of(const std::vector<rm::Row>& rows) {
  try {
    rm::map_of(rows.data(), rows.size());
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

TEST(RoadmapRows, FaultsAreNamedByTheirRow) {
  const rm::Row piece{0, 0, 1, 0, null(), null()}, wall{0, 2, 1, 2, 0.1, 0.3};
  EXPECT_EQ(fault_of({piece, wall}), "");
  EXPECT_EQ(fault_of({piece, {1, 1, 1, 1, null(), null()}}),
            "row 2 of the roadmap has no length; expected two different ends");
  EXPECT_EQ(fault_of({{0, 0, 1, 0, 0.1, null()}}),
            "row 1 of the roadmap has one of width and radius; expected both, for a wall, or neither, for a piece of "
            "the way");
  EXPECT_EQ(fault_of({wall, piece, {0, 4, 1, 4, 0.1, 0.4}}),
            "row 3 of the roadmap has another radius than a row before; expected one for all walls");
  EXPECT_EQ(fault_of({{0, 4, 1, 4, -0.1, 0.4}}), "row 1 of the roadmap has a negative width or radius");
}

}  // namespace
}  // namespace muster::test
