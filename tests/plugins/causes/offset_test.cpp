// Causes that belong to radios: offsets, antennas, bodies, places and names.
#include <cmath>
#include <map>
#include <set>

#include "survey.hpp"

namespace muster {
namespace {

TEST(Offset, OfASenderIsOnAllThatItSends) {
  expect_term("tx_offset", "radio=\"a\" offset=\"-3.5\"", [](const Reading& r) { return r.tx == "a" ? -3.5 : 0; });
}

TEST(Offset, OfAReceiverIsOnAllThatItHears) {
  expect_term("rx_offset", "radio=\"r\" offset=\"7\"", [](const Reading& r) { return r.rx == "r" ? 7 : 0; });
}

TEST(Offset, OfAnAsymmetricRadioIsItsDifferenceBetweenBothWays) {
  expect_term("asymmetry", "radio=\"b\" loss=\"6\" sending=\"0.25\"", [](const Reading& r) {
    return r.tx == "b" ? 1.5 : r.rx == "b" ? -4.5 : 0;
  });
}

TEST(Antenna, OfAStandingRadioIsTheSameBothWays) {
  expect_term("antenna_tx", "radio=\"b\" amplitude=\"4\" direction=\"1\"", [](const Reading& r) {
    if (r.tx == "b") return 4 * std::cos(seen(r.from, r.to) - 1);
    return r.rx == "b" ? 4 * std::cos(seen(r.to, r.from) - 1) : 0;
  });
}

TEST(Antenna, OfAMovingRadioTurnsWithIt) {
  expect_term("antenna_rx", "radio=\"r\" amplitude=\"4\" direction=\"-2.5\"", [](const Reading& r) {
    if (r.tx == "r") return 4 * std::cos(seen(r.from, r.to) + 2.5);
    return r.rx == "r" ? 4 * std::cos(seen(r.to, r.from) + 2.5) : 0;
  });
}

TEST(Antenna, OfEveryReceiverIsAtTheReceivingEnd) {
  expect_term("antenna_rx", "amplitude=\"4\" direction=\"0.5\"",
              [](const Reading& r) { return 4 * std::cos(seen(r.to, r.from) - 0.5); });
}

TEST(BodyShadow, IsFlatBehindTheBodyAndHalfWhereTheSectorEnds) {
  const auto shadow = [](const Reading::At& own, const Reading::At& other) {
    const double turn = seen(own, other) - 3, away = std::abs(std::atan2(std::sin(turn), std::cos(turn)));
    return -9 * std::exp(-std::log(2) * std::pow(away / 0.4, 4));
  };
  EXPECT_NEAR(shadow({0, 0, 0, 0}, {std::cos(3.4), std::sin(3.4), 0, 0}), -4.5, 1e-12);
  expect_term("body_shadow", "radio=\"s\" loss=\"9\" direction=\"3\" width=\"0.8\"", [=](const Reading& r) {
    return r.tx == "s" ? shadow(r.from, r.to) : r.rx == "s" ? shadow(r.to, r.from) : 0;
  });
  expect_term("body_shadow", "loss=\"9\" direction=\"3\" width=\"0.8\"",
              [=](const Reading& r) { return shadow(r.to, r.from); });
}

// Readings computed with the radio at that place.
std::vector<Reading> moved(std::vector<Reading> readings, const std::string& radio, const Reading::At& to) {
  for (Reading& r : readings) {
    if (r.tx == radio) r.from = to;
    if (r.rx == radio) r.to = to;
  }
  return readings;
}

TEST(Misplaced, TheChannelIsThatOfTheTruePlace) {
  const auto as_found = [] {
    return column(Site().world(effect("tx_misplaced", "radio=\"b\" x=\"9\" y=\"-1\"")), "link/*/rssi");
  }();
  const auto as_it_is = [] {
    const Site truth(moved(survey(), "b", {9, -1, 4, -2}));
    return column(truth.world(""), "link/*/rssi");
  }();
  EXPECT_TRUE(same_bits(as_found, as_it_is));
  EXPECT_FALSE(same_bits(as_found, column(Site().world(""), "link/*/rssi")));
}

TEST(LabelSwap, EachStandsWhereTheOtherOneWasSaidToBe) {
  const auto swapped = [] { return column(Site().world(effect("label_swap", "a=\"a\" b=\"b\"")), "link/*/rssi"); }();
  const auto as_it_is = [] {
    const Site truth(moved(moved(survey(), "b", {0, 0, 1, 0.5}), "a", {14, 9, 4, -2}));
    return column(truth.world(""), "link/*/rssi");
  }();
  EXPECT_TRUE(same_bits(swapped, as_it_is));
  EXPECT_FALSE(same_bits(swapped, column(Site().world(""), "link/*/rssi")));
}

TEST(PowerSteps, EachPowerHasItsOwnError) {
  expect_term("power_steps", "file=\"measured.csv\" error1=\"2\" error2=\"-1\" error3=\"0.5\"", [](const Reading& r) {
    return r.power == -10 ? 2 : r.power == 0 ? -1 : 0.5;
  });
}

TEST(PowerSteps, WhatStoodLastHolds) {
  Site site;
  std::vector<Reading> sparse;
  for (const Reading& r : site.readings)
    if (r.tx == "a" && (r.t < 1 || (r.t > 60 && r.power == 4))) sparse.push_back(r);
  site.put("powers.csv", csv(sparse));
  const auto part =
      column(site.world(effect("power_steps", "file=\"powers.csv\" error1=\"2\" error2=\"-1\"")), "link/*/level@it");
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Reading& r = site.readings[i];
    EXPECT_EQ(part[i], r.tx != "a" ? 0 : r.t < 60 ? 2 : -1) << r.t;
  }
}

TEST(PowerSteps, ErrorsOfMoreThanSixPowersChangeLinearly) {
  Site site;
  auto many = site.readings;
  const auto power_at = [](double t) { return std::fmod(std::floor(t), 11.0); };
  for (Reading& r : many) r.power = power_at(r.t);
  site.put("powers.csv", csv(many));
  const auto part = column(site.world(effect("power_steps",
                                             "file=\"powers.csv\" error1=\"1\" error2=\"2\" error3=\"4\" "
                                             "error4=\"4\" error5=\"4\" error6=\"-6\"")),
                           "link/*/level@it");
  const std::map<double, double> expected = {{0, 1}, {1, 1.5}, {2, 2}, {3, 3},  {4, 4},  {5, 4},
                                             {6, 4}, {7, 4},   {8, 4}, {9, -1}, {10, -6}};
  std::set<double> met;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const double power = power_at(site.readings[i].t);
    met.insert(power);
    EXPECT_NEAR(part[i], expected.at(power), 1e-12) << power;
  }
  EXPECT_EQ(met.size(), expected.size());
}

}  // namespace
}  // namespace muster
