// The same seed gives the same bytes, independent of other cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "made.hpp"

namespace muster::exam {
namespace {

TEST(Exam, SameSeedSameBytes) {
  for (const char* effect : {"", "unmapped_wall", "people", "fading_law", "rssi_floor"}) {
    EXPECT_EQ(everything(made(11, effect)), everything(made(11, effect))) << effect;
    EXPECT_NE(everything(made(11, effect)), everything(made(12, effect))) << effect;
  }
}

TEST(Exam, CasesDoNotDependOnOneAnother) {
  Syllabus syllabus;
  syllabus.seed = 5;
  const Order third = draw_order(syllabus, 3);
  draw_order(syllabus, 2);
  EXPECT_EQ(third.effects, draw_order(syllabus, 3).effects);
  EXPECT_NE(seed_of(syllabus, 3), seed_of(syllabus, 4));
  const std::uint64_t before = seed_of(syllabus, 3);
  syllabus.seed = 6;
  EXPECT_NE(seed_of(syllabus, 3), before);
}

TEST(Exam, KindsAndRowsAreTheOnesAskedFor) {
  Syllabus syllabus;
  syllabus.kinds = {"two"};
  syllabus.least_rows = 3000;
  syllabus.most_rows = 4000;
  for (int i = 1; i <= 60; ++i) {
    const Order order = draw_order(syllabus, i);
    ASSERT_EQ(order.effects.size(), 2u);
    EXPECT_NE(order.effects[0], order.effects[1]);
    EXPECT_GE(order.rows, 3000);
    EXPECT_LE(order.rows, 4000);
    for (const auto& id : order.effects) EXPECT_TRUE(recipe(id).in_vocabulary) << id;
  }
  syllabus.kinds = {"three"};
  const std::set<std::string> scatter = {"fading_law", "channel_mixture", "outliers"},
                              clips = {"rssi_floor", "rssi_saturation"};
  for (int i = 1; i <= 200; ++i) {
    const Order order = draw_order(syllabus, i);
    const std::set<std::string> ids(order.effects.begin(), order.effects.end());
    ASSERT_EQ(ids.size(), 3u);
    ASSERT_EQ(order.lambdas.size(), 3u);
    EXPECT_EQ(ids.count("label_swap"), 0u);
    const auto of = [&](const std::set<std::string>& group) {
      return std::count_if(ids.begin(), ids.end(), [&](const auto& id) { return group.count(id) > 0; });
    };
    EXPECT_LE(of(scatter), 1);
    EXPECT_LE(of(clips), 1);
  }
  syllabus.kinds = {"outside"};
  for (int i = 1; i <= 30; ++i) EXPECT_FALSE(recipe(draw_order(syllabus, i).effects.at(0)).in_vocabulary);
}

}  // namespace
}  // namespace muster::exam
