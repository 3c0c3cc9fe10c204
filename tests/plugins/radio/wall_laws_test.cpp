// Crossings of a link, on a plan that can be checked by hand; and caching that changes no result.
#include <gtest/gtest.h>

#include <vector>

#include "radio_multiwall/link_geometry.hpp"

namespace muster {
namespace {

// A brick wall at x = 5 from y = 0 to 10, 3 m high, and a glass one at x = 8, 1 m high. In the brick wall at y = 4 to 5
// is a wooden door, 2 m high.
struct Plan {
  enum { brick, glass, wood, materials };
  std::vector<Wall> walls{{5, 0, 5, 10, 0, 3, 0.1, brick}, {8, 0, 8, 10, 0, 1, 0.1, glass}};
  std::vector<Door> doors{{0, 4, 1, 2, wood}};
  std::vector<DoorState> states{{0}};
  std::vector<FloorShape> floors;
  std::vector<Pose> at;
  std::vector<Ends> links;

  void link(double y, double from_z, double to_z) {
    at.push_back({0, y, from_z, 1, 0, 0, 0});
    at.push_back({10, y, to_z, 1, 0, 0, 0});
    links.push_back({static_cast<double>(at.size() - 2), static_cast<double>(at.size() - 1)});
  }
  std::size_t put(LinkGeometry& g) const {
    g.set_scene(view(walls), view(doors), view(states), view(floors), materials);
    return g.set_links(view(links), view(at));
  }

  template <class Row>
  static Rows<const Row> view(const std::vector<Row>& rows) {
    return {reinterpret_cast<const double*>(rows.data()), rows.size()};
  }
};

std::vector<int> counts(const LinkGeometry& g, std::size_t link) {
  return {g.counts(Plan::brick)[g.pair(link)], g.counts(Plan::glass)[g.pair(link)], g.counts(Plan::wood)[g.pair(link)]};
}
double log_distance(const LinkGeometry& g, std::size_t link) { return g.log_distances()[link]; }
using Counts = std::vector<int>;

TEST(Walls, AreCountedByMaterialHeightAndDoorState) {
  Plan plan;
  plan.link(2.5, 0.5, 0.5);  // through both walls
  plan.link(4.5, 0.5, 0.5);  // through the door
  plan.link(4.5, 2.5, 2.5);  // over the door, through the brick above it; over the glass
  plan.link(2.5, 3.5, 3.5);  // over all
  LinkGeometry g;
  plan.put(g);
  EXPECT_EQ(counts(g, 0), (Counts{1, 1, 0}));
  EXPECT_EQ(counts(g, 1), (Counts{0, 1, 1}));
  EXPECT_EQ(counts(g, 2), (Counts{1, 0, 0}));
  EXPECT_EQ(counts(g, 3), (Counts{0, 0, 0}));
  plan.states = {{1}};
  plan.put(g);
  EXPECT_EQ(counts(g, 0), (Counts{1, 1, 0}));
  EXPECT_EQ(counts(g, 1), (Counts{0, 1, 0}));
}

TEST(Walls, ADoorWithoutMaterialIsOfItsWalls) {
  Plan plan;
  plan.doors[0].material = null();
  plan.link(4.5, 0.5, 0.5);
  LinkGeometry g;
  plan.put(g);
  EXPECT_EQ(counts(g, 0), (Counts{1, 1, 0}));
}

TEST(Floors, AreCountedByMaterialAndAnewWhenTheyChange) {
  Plan plan;
  plan.link(2.5, 0.5, 2.5);  // through the brick wall; at x = 7.5 it is 2 m high, over the glass
  LinkGeometry g;
  plan.put(g);
  EXPECT_EQ(counts(g, 0), (Counts{1, 0, 0}));
  plan.floors = {{0, 0, 10, 0, 10, 10, 0, 10, 2, Plan::wood}, {0, 0, 5, 0, 5, 10, 0, 10, 2, Plan::glass}};
  plan.put(g);
  EXPECT_EQ(counts(g, 0), (Counts{1, 0, 1}));
  plan.floors[1].x1 = plan.floors[1].x2 = 8;
  plan.put(g);
  EXPECT_EQ(counts(g, 0), (Counts{1, 1, 1}));
}

TEST(Walls, DistanceIsInSpaceAndAtLeastACentimetre) {
  Plan plan;
  plan.at = {{0, 0, 0, 1, 0, 0, 0}, {2, 3, 6, 1, 0, 0, 0}, {0, 0.001, 0, 1, 0, 0, 0}};
  plan.links = {{0, 1}, {1, 0}, {0, 2}};
  LinkGeometry g;
  plan.put(g);
  EXPECT_NEAR(log_distance(g, 0), std::log10(7.0), 1e-15);
  EXPECT_EQ(log_distance(g, 1), log_distance(g, 0));
  EXPECT_EQ(g.pair(1), g.pair(0));
  EXPECT_EQ(counts(g, 1), counts(g, 0));
  EXPECT_EQ(log_distance(g, 2), -2);
}

TEST(Pairs, ReverseLinksAreFoundInTheOrderOfListing) {
  std::vector<Ends> links;
  for (const double a : {0.0, 1.0, 2.0, 3.0, 4.0}) {
    for (const double b : {0.0, 1.0, 2.0, 3.0, 4.0}) {
      if (a != b && a * b != 2) links.push_back({a, b});  // 1 and 2 are out of range
    }
  }
  const auto back = earlier_reverse(Plan::view(links), 5);
  for (std::size_t i = 0; i < links.size(); ++i) {
    ASSERT_EQ(back[i] != no_link, links[i].tx > links[i].rx) << i;
    if (back[i] == no_link) continue;
    EXPECT_LT(back[i], i);
    EXPECT_EQ(links[back[i]].tx, links[i].rx);
    EXPECT_EQ(links[back[i]].rx, links[i].tx);
  }
}

TEST(Pairs, InAnyOrderOnlyReverseLinksAreTaken) {
  const Stream random(4);
  std::vector<Ends> links;
  for (uint64_t i = 0; i < 3000; ++i) {
    links.push_back({std::floor(20 * random.uniform(i, 0)), std::floor(20 * random.uniform(i, 1))});
  }
  const auto back = earlier_reverse(Plan::view(links), 20);
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (back[i] == no_link) continue;
    ASSERT_LT(back[i], i);
    EXPECT_EQ(links[back[i]].tx, links[i].rx);
    EXPECT_EQ(links[back[i]].rx, links[i].tx);
  }
}

TEST(Kept, LinksAreComputedAgainOnlyWhereSomethingMoved) {
  Plan plan;
  for (int i = 0; i < 8; ++i) plan.link(1.0 + i, 0.5, 0.5);
  LinkGeometry g;
  EXPECT_EQ(plan.put(g), 8u);
  EXPECT_EQ(plan.put(g), 0u);
  plan.at[4].y = std::nextafter(plan.at[4].y, 100);
  EXPECT_EQ(plan.put(g), 1u);
  plan.states = {{1}};
  EXPECT_EQ(plan.put(g), 8u);
  plan.walls[0].height = 2.5;
  EXPECT_EQ(plan.put(g), 8u);
  plan.doors[0].width = 1.5;
  EXPECT_EQ(plan.put(g), 8u);
}

// For a stationary radio each measured link has an endpoint of its own.
TEST(Kept, EndpointsAtOnePointAreTakenTogetherUntilTheyPart) {
  Plan plan;
  for (int i = 0; i < 40; ++i) plan.link(0.1 + 0.24 * i, 0.3, 3.1);
  LinkGeometry together;
  const auto stand_at = [&](double x, double y) {
    for (std::size_t i = 0; i < plan.at.size(); i += 2) plan.at[i].x = x, plan.at[i].y = y;
  };
  const auto expect_those_of_each_alone = [&] {
    plan.put(together);
    for (std::size_t i = 0; i < plan.links.size(); ++i) {
      Plan one = plan;
      one.links = {plan.links[i]};
      LinkGeometry alone;
      one.put(alone);
      EXPECT_EQ(counts(together, i), counts(alone, 0)) << i;
      EXPECT_EQ(log_distance(together, i), log_distance(alone, 0)) << i;
    }
  };
  stand_at(0, 5);
  expect_those_of_each_alone();
  stand_at(6, 2);
  expect_those_of_each_alone();
  plan.at[6].x = 1;
  expect_those_of_each_alone();
}

TEST(Kept, AnswersAreThoseOfAFreshStart) {
  Plan plan;
  for (int i = 0; i < 40; ++i) plan.link(0.1 + 0.24 * i, 0.3, 3.1);
  LinkGeometry kept;
  for (int step = 0; step < 30; ++step) {
    plan.at[static_cast<std::size_t>(step * 7 % 80)].y += 0.37;
    plan.states = {{static_cast<double>(step / 5 % 2)}};
    if (step == 17) plan.links.resize(20);
    if (step == 23) plan.links.push_back({0, 79});
    LinkGeometry fresh;
    plan.put(fresh);
    plan.put(kept);
    for (std::size_t i = 0; i < plan.links.size(); ++i) {
      EXPECT_EQ(counts(kept, i), counts(fresh, i));
      EXPECT_EQ(log_distance(kept, i), log_distance(fresh, i));
    }
  }
}

// Pairs are renumbered where the crowd mixes; each link's counts are then still its own.
TEST(Kept, AnswersAreThoseOfAFreshStartHoweverACrowdMixes) {
  Plan plan;
  for (double a = 0; a < 120; ++a) {
    for (double b = 0; b < 120; ++b) {
      if (a != b) plan.links.push_back({a, b});
    }
  }
  const Stream random(8);
  LinkGeometry kept;
  for (uint64_t step = 0; step < 4; ++step) {
    plan.at.clear();
    for (uint64_t i = 0; i < 120; ++i) {
      const auto at = [&](uint64_t k) { return 10 * random.uniform(120 * step + i, k); };
      plan.at.push_back({at(0), at(1), at(2) / 3, 1, 0, 0, 0});
    }
    EXPECT_EQ(plan.put(kept), 7140u);
    for (std::size_t i = 0; i < plan.links.size(); i += 97) {
      Plan alone = plan;
      alone.links = {plan.links[i]};
      LinkGeometry fresh;
      alone.put(fresh);
      EXPECT_EQ(counts(kept, i), counts(fresh, 0));
      EXPECT_EQ(log_distance(kept, i), log_distance(fresh, 0));
    }
  }
}

TEST(Kept, WithoutWallsNothingIsCrossedAndPlacesAreStillRefused) {
  Plan plan;
  plan.walls.clear(), plan.doors.clear(), plan.states.clear();
  plan.link(2.5, 0.5, 0.5);
  LinkGeometry g;
  plan.put(g);
  EXPECT_EQ(counts(g, 0), (Counts{0, 0, 0}));
  plan.at[1].x = 2e5;
  EXPECT_THROW(plan.put(g), std::runtime_error);
}

TEST(Kept, NothingIsLeftWhenTheLastLinkGoes) {
  Plan plan;
  plan.link(2.5, 0.5, 0.5);
  LinkGeometry g;
  plan.put(g);
  EXPECT_EQ(g.log_distances().size(), 1u);
  plan.links.clear();
  EXPECT_EQ(plan.put(g), 0u);
  EXPECT_TRUE(g.log_distances().empty());
}

TEST(Kept, NoAnswerOutlivesARefusal) {
  Plan plan;
  plan.link(2.5, 0.5, 0.5);
  LinkGeometry g;
  plan.put(g);
  const auto good = plan.at;
  plan.at[1].x = 500000;  // beyond the scene's reach
  EXPECT_THROW(plan.put(g), std::runtime_error);
  EXPECT_THROW(plan.put(g), std::runtime_error);
  plan.at = good;
  plan.put(g);
  EXPECT_EQ(counts(g, 0), (Counts{1, 1, 0}));
  plan.walls[0].x0 = 5000;
  EXPECT_THROW(plan.put(g), std::runtime_error);
  EXPECT_THROW(plan.put(g), std::runtime_error);
}

}  // namespace
}  // namespace muster
