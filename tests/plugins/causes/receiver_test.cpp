// Causes in the receiver's chain.
#include "survey.hpp"

namespace muster {
namespace {

// Checks the stage's output for its input.
void expect_stage(const std::string& name, const std::string& attributes,
                  const std::function<double(double, const Reading&)>& closed_form) {
  const Site site;
  const auto world = site.world(effect(name, attributes));
  const auto in = column(world, "link/*/rssi@base"), out = column(world, "link/*/rssi");
  int changed = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const double expected = closed_form(in[i], site.readings[i]);
    if (std::isnan(expected)) {
      EXPECT_TRUE(same_bits(out[i], expected)) << in[i];
    } else {
      EXPECT_NEAR(out[i], expected, 1e-12);
    }
    changed += !(out[i] == in[i]);
  }
  EXPECT_GT(changed, 10);
  EXPECT_FALSE(std::any_of(in.begin(), in.end(), [](double x) { return std::isnan(x); }));
}

TEST(Saturation, CutsReadingsAtTheCeiling) {
  expect_stage("rssi_saturation", "level=\"-60\"", [](double in, const Reading&) { return std::min(in, -60.0); });
}

TEST(Compression, TakesAShareOfTheExcessOverTheKnee) {
  expect_stage("rssi_compression", "knee=\"-65\" share=\"0.4\"",
               [](double in, const Reading&) { return in > -65 ? -65 + 0.6 * (in + 65) : in; });
}

TEST(Floor, LosesReadingsBelowIt) {
  expect_stage("rssi_floor", "level=\"-70\"", [](double in, const Reading&) { return in < -70 ? null() : in; });
}

TEST(Floor, ShowsItsLowestCodeWhereItIsNotSilent) {
  expect_stage("rssi_floor", "level=\"-70\" silent=\"false\"",
               [](double in, const Reading&) { return std::max(in, -70.0); });
}

TEST(NoiseFloor, IsTakenAwayFromTheReading) {
  expect_stage("noise_floor_rssi", "file=\"measured.csv\" share=\"0.9\" reference=\"-92\"",
               [](double in, const Reading& r) { return in - 0.9 * (r.noise + 92); });
}

TEST(Stages, WhatWasNotReceivedStaysSo) {
  const Site site;
  const std::string deaf = plan + "<radio.multiwall/><radio.fading/><radio.receiver sensitivity=\"-65\"/>";
  for (const std::string& stage :
       {effect("rssi_saturation", "level=\"-60\""), effect("rssi_floor", "level=\"-70\" silent=\"false\""),
        effect("noise_floor_rssi", "file=\"measured.csv\" share=\"1\""), effect("outliers", "share=\"1\"")}) {
    const auto world = site.world(stage, false, 1, deaf);
    const auto in = column(world, "link/*/rssi@base"), out = column(world, "link/*/rssi");
    int lost = 0;
    for (std::size_t i = 0; i < in.size(); ++i) {
      EXPECT_EQ(std::isnan(in[i]), std::isnan(out[i]));
      lost += std::isnan(in[i]);
    }
    EXPECT_GT(lost, 10);
  }
}

TEST(Stages, ExpectationsAreNeitherCutNorLost) {
  const Site site;
  const auto plain = column(site.world("", true), "link/*/rssi");
  for (const std::string& stage : {effect("rssi_saturation", "level=\"-60\""), effect("rssi_floor", "level=\"-70\""),
                                   effect("rssi_floor", "level=\"-70\" silent=\"false\"")})
    EXPECT_TRUE(same_bits(column(site.world(stage, true), "link/*/rssi"), plain));
}

}  // namespace
}  // namespace muster
