#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "robot_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

Simulation wandering(const Folder& folder, const std::string& robots, const std::string& seed = "1") {
  return world_of(folder,
                  robots + R"(<test.turner/><control.wander slowest="-0.1" fastest="0.5" turn="1.5" ramp="0.2"/>)", {},
                  "dt=\"0.05\" until=\"100\" seed=\"" + seed + "\"");
}

const std::string a = R"(<robot name="a" at="0 0 0"/>)", b = R"(<robot name="b" at="1 0 0"/>)";

TEST(Wander, DrawsWithinItsBoundsAndHoldsForAPeriod) {
  Folder folder;
  Simulation run = wandering(folder, a);
  double least = 9, most = -9, sharpest = 0, sum = 0;
  int drawn = 0;
  Command before{0, 0};
  while (!run.done()) {
    const double since = std::fmod(run.time() + 1e-9, 1.0);
    run.step();
    const auto now = row<Command>(run, "robot/a/command");
    if (run.tick() == 1) {
      EXPECT_LT(std::abs(now.v), 0.5 * 0.25 + 1e-9);  // on its way from rest
    } else if (since > 0.24) {
      EXPECT_NEAR(now.v, before.v, 1e-9) << run.time();
      EXPECT_NEAR(now.w, before.w, 1e-9) << run.time();
    } else if (since > 0.19) {
      least = std::min(least, now.v), most = std::max(most, now.v), sharpest = std::max(sharpest, std::abs(now.w));
      sum += now.v;
      ++drawn;
    }
    before = now;
  }
  EXPECT_GE(least, -0.1);
  EXPECT_LT(least, -0.07);
  EXPECT_LE(most, 0.5);
  EXPECT_GT(most, 0.47);
  EXPECT_LE(sharpest, 1.5);
  EXPECT_GT(sharpest, 1.4);
  EXPECT_NEAR(sum / drawn, 0.2, 3 * 0.6 / std::sqrt(12.0 * drawn));
}

TEST(Wander, BoundsInTheWrongOrderAndARampBeyondThePeriodAreRefused) {
  const auto refused = [](const std::string& attributes) -> std::string {
    const Folder folder;
    try {
      world_of(folder, a + "<test.turner/><control.wander " + attributes + "/>");
    } catch (const Error& error) {
      EXPECT_EQ(error.exit(), Exit::invalid_input);
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refused("slowest=\"0.7\""), testing::HasSubstr("slowest=\"0.7\" is above fastest=\"0.6\""));
  EXPECT_THAT(refused("period=\"0.2\""),
              testing::HasSubstr("attribute \"ramp\": 0.250 s is above the period of 0.200 s; expected at most that"));
  EXPECT_EQ(refused("slowest=\"0.6\" period=\"0.25\""), "");
}

TEST(Wander, GoesByNameAndSeedAndByNothingElse) {
  Folder folder;
  const auto course = [&](const std::string& robots, const std::string& name, const std::string& seed) {
    Simulation run = wandering(folder, robots, seed);
    double sum = 0;
    for (int k = 0; k < 200; ++k) {
      run.step();
      sum += row<Command>(run, "robot/" + name + "/command").w * (k + 1);
    }
    return sum;
  };
  EXPECT_EQ(course(a + b, "a", "1"), course(b + a, "a", "1"));
  EXPECT_EQ(course(a, "a", "1"), course(b + a, "a", "1"));
  EXPECT_NE(course(a + b, "a", "1"), course(a + b, "b", "1"));
  EXPECT_NE(course(a, "a", "1"), course(a, "a", "2"));
}

}  // namespace
