// Every cause hidden in worlds of its own at lambda 60, and found. The seeds are fixed, so what is found of a cause is
// a figure of the tool, and the table holds it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "effect.hpp"
#include "tests/hidden/examined.hpp"

namespace muster::exam {
namespace {

struct Hidden {
  const char* effect;
  int seed;
  int found;  // of 3, measured; 0: not found at this strength yet, and the test is skipped
};

// Measured at the commit that last changed this table.
constexpr Hidden table[] = {
    {"tx_offset", 901, 1},
    {"rx_offset", 902, 3},
    {"antenna_tx", 903, 3},
    {"antenna_rx", 904, 3},
    {"body_shadow", 905, 3},
    {"tx_misplaced", 906, 0},
    {"label_swap", 907, 3},
    {"asymmetry", 908, 0},
    {"wall_material", 909, 1},
    {"wall_absent", 910, 0},
    {"unmapped_wall", 911, 1},
    {"obstacle", 912, 1},
    {"room_clutter", 913, 0},
    {"multiwall_saturation", 914, 2},
    {"incidence", 915, 3},
    {"height", 916, 3},
    {"dual_slope", 917, 3},
    {"two_ray", 918, 0},
    {"corridor", 919, 0},
    {"drift", 920, 3},
    {"step", 921, 3},
    {"periodic", 922, 3},
    {"people", 923, 0},
    {"power_steps", 924, 3},
    {"noise_floor_rssi", 925, 3},
    {"rssi_saturation", 926, 0},
    {"rssi_floor", 927, 0},
    {"fading_law", 928, 0},
    {"outliers", 929, 0},
    {"channel_mixture", 930, 0},
    {"shadowing_correlation", 931, 0},
};

void PrintTo(const Hidden& hidden, std::ostream* out) { *out << hidden.effect; }

class HiddenEffect : public testing::TestWithParam<Hidden> {};

TEST_P(HiddenEffect, IsFoundAtLambda60) {
  const auto& [effect, seed, found] = GetParam();
  if (found == 0) GTEST_SKIP() << effect << " is not found at lambda 60 yet";
  const Grades grades = examined("--seed " + std::to_string(seed) +
                                 " --cases 3 --mix one --lambda 60 --rows 2000 3000 --effects " + effect);
  ASSERT_TRUE(grades.missing.empty());
  const Share& share = grades.shares.at("one / found / all");
  std::printf("%s: %d of %d found\n", effect, share.hits, share.of);
  // A change of the search may turn one world; a cause that is no longer found at all turns the test.
  EXPECT_GE(share.hits, std::max(found - 1, 1)) << as_text(grades);
}

INSTANTIATE_TEST_SUITE_P(Effects, HiddenEffect, testing::ValuesIn(table),
                         [](const auto& hidden) { return std::string(hidden.param.effect); });

TEST(HiddenTable, HoldsEveryEffectOfTheVocabulary) {
  for (const Recipe& r : recipes()) {
    const bool in_table =
        std::any_of(std::begin(table), std::end(table), [&](const Hidden& h) { return std::string(r.id) == h.effect; });
    EXPECT_EQ(in_table, r.in_vocabulary) << r.id;
  }
}

}  // namespace
}  // namespace muster::exam
