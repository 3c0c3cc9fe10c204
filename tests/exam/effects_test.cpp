// Every effect is in the data, at its requested lambda, on the rows it reports.
#include <gtest/gtest.h>

#include <set>

#include "made.hpp"

namespace muster::exam {
namespace {

// Number of readings that differ from those of the same site, fields and fades without the effect.
int readings_changed(const Case& c) {
  Case without = c;
  without.hidden.clear();
  without.site = std::make_shared<GroundTruth>(*c.site);
  without.site->noise = {c.site->stated_field, c.site->stated_reading, c.site->noise.lost};
  const Eigen::VectorXd level =
      level_by_base(c, c.measured) + draw_noise(without, Field(*without.site, c.seed), c.measured, "measured");
  const Hidden& h = c.hidden.at(0);
  int changed = 0;
  for (Eigen::Index i = 0; i < level.size(); ++i) {
    const double rssi = c.measured.rssi[i];
    changed += std::isnan(rssi) ? h.effect.receive && std::isnan(h.effect.receive(level[i], h.strength))
                                : rssi != std::round(level[i]);
  }
  return changed;
}

class EveryEffect : public testing::TestWithParam<Recipe> {};

TEST_P(EveryEffect, ChangesTheDataAndHasTheWantedLambda) {
  const std::string id = GetParam().id;
  // Exchanged names, an absent wall and a whole person have a fixed size.
  const bool has_own_size = id == "label_swap" || id == "wall_absent";
  int near = 0;
  for (std::uint64_t seed = 21; seed <= 23; ++seed) {
    const Case c = made(seed, id, 60, 1500);
    const Hidden& h = c.hidden.at(0);
    EXPECT_EQ(h.effect.id, id);
    EXPECT_GT(h.strength, 0);
    near += h.lambda > 60 / 1.3 && h.lambda < 60 * 1.3;
    EXPECT_GT(readings_changed(c), 3) << "seed " << seed;
  }
  if (!has_own_size) {
    EXPECT_GE(near, 2) << "of 3";
  }
}

TEST_P(EveryEffect, NamesRowsOfItsWorldAndItsParameters) {
  const Case c = made(31, GetParam().id, 60, 900);
  const Effect& e = c.hidden.at(0).effect;
  const std::string world = world_xml(c), walls = walls_csv(c.site->plan);
  for (const std::string& row : e.rows) {
    const std::string name = row.substr(row.find('/') + 1);
    const bool is_known = row.rfind("wall/", 0) == 0
                              ? walls.find("\n" + name + ",") != std::string::npos
                              : world.find("<station name=\"" + name + "\"") != std::string::npos;
    EXPECT_TRUE(is_known) << row;
  }
  std::set<std::string> names;
  for (const Parameter& p : e.parameters(c.hidden[0].strength)) {
    EXPECT_TRUE(std::isfinite(p.value)) << p.name;
    EXPECT_TRUE(names.insert(p.name).second) << p.name;
  }
  EXPECT_EQ(e.covariates.empty(), GetParam().in_vocabulary);
}

INSTANTIATE_TEST_SUITE_P(Exam, EveryEffect, testing::ValuesIn(recipes()),
                         [](const auto& of) { return std::string(of.param.id); });

TEST(Orders, EachEffectComesInItsTurn) {
  Syllabus syllabus;
  syllabus.kinds = {"each"};
  const int all = static_cast<int>(recipes().size());
  for (int number = 1; number <= 2 * all; ++number) {
    const Order order = draw_order(syllabus, number);
    const Recipe& turn = recipes()[static_cast<std::size_t>((number - 1) % all)];
    EXPECT_EQ(order.effects, std::vector<std::string>{turn.id});
    EXPECT_EQ(order.kind, turn.in_vocabulary ? "one" : "outside");
  }
}

TEST(Effects, AreAllThatTheVocabularyHas) {
  for (const char* id : {"tx_offset",
                         "rx_offset",
                         "antenna_tx",
                         "antenna_rx",
                         "body_shadow",
                         "wall_material",
                         "wall_absent",
                         "unmapped_wall",
                         "obstacle",
                         "dual_slope",
                         "two_ray",
                         "corridor",
                         "multiwall_saturation",
                         "incidence",
                         "height",
                         "room_clutter",
                         "drift",
                         "step",
                         "periodic",
                         "people",
                         "rssi_saturation",
                         "rssi_floor",
                         "power_steps",
                         "channel_mixture",
                         "fading_law",
                         "shadowing_correlation",
                         "outliers",
                         "tx_misplaced",
                         "label_swap",
                         "asymmetry",
                         "noise_floor_rssi"})
    EXPECT_TRUE(recipe(id).in_vocabulary) << id;
  EXPECT_THROW(recipe("ghost"), std::invalid_argument);
}

TEST(Effects, OracleGainsByMeansAndNotByLaws) {
  double gained = 0;
  for (const char* id : {"rx_offset", "antenna_rx", "step"}) {
    const Case c = made(41, id, 400, 1500);
    gained += c.oracle.without > c.oracle.with;
  }
  EXPECT_EQ(gained, 3);
  const Case law = made(41, "fading_law", 100, 1500);
  EXPECT_EQ(law.oracle.without, law.oracle.with);
}

TEST(Effects, ASilentFloorLeavesOnlyReadingsAboveIt) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Case c = made(seed, "rssi_floor", 100, 1500);
    const auto parameters = c.hidden[0].effect.parameters(c.hidden[0].strength);
    double least = 0;
    int at_floor = 0;
    for (const double v : c.measured.rssi) {
      if (!std::isnan(v)) least = std::min(least, v);
      at_floor += v == parameters[0].value;
    }
    EXPECT_GE(least, parameters[0].value);
    if (parameters[1].value == 0) {
      EXPECT_GT(at_floor, 5);  // a peak at the lowest code
    }
  }
}

}  // namespace
}  // namespace muster::exam
