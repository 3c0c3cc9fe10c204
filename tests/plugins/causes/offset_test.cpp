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

TEST(Offset, OfAFeederIsOnBothWays) {
  expect_term("feeder_loss", "radio=\"b\" loss=\"6\"",
              [](const Reading& r) { return r.tx == "b" || r.rx == "b" ? -6 : 0; });
}

TEST(Antenna, OfAStandingRadioIsTheSameBothWays) {
  expect_term("antenna_tx", "radio=\"b\" amplitude=\"4\" direction=\"1\"", [](const Reading& r) {
    if (r.tx == "b") return 4 * std::cos(seen(r.from, r.to) - 1);
    return r.rx == "b" ? 4 * std::cos(seen(r.to, r.from) - 1) : 0;
  });
}

// Half of the sector's 20 dB at edge / sqrt(2), all of them from the edge on, the same both ways.
TEST(Antenna, OfASectorLosesNoMoreThanItsFrontToBack) {
  expect_term("sector_antenna", "radio=\"b\" front_to_back=\"20\" direction=\"1\" edge=\"1.5\"", [](const Reading& r) {
    if (r.tx != "b" && r.rx != "b") return 0.0;
    const double off = std::remainder((r.tx == "b" ? seen(r.from, r.to) : seen(r.to, r.from)) - 1, 2 * M_PI);
    return std::abs(off) > 1.5 ? -20.0 : -20 * std::pow(off / 1.5, 2);
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

// Of two radios that stand the first is where the second is listed, and the other way round; r and s move.
TEST(LabelsShifted, TheListOfStandingRadiosSlips) {
  const auto shifted = [] { return column(Site().world(effect("labels_shifted", "first=\"b\"")), "link/*/rssi"); }();
  const auto swapped = [] { return column(Site().world(effect("label_swap", "a=\"a\" b=\"b\"")), "link/*/rssi"); }();
  EXPECT_TRUE(same_bits(shifted, swapped));
}

// A station that nobody hears has its line in the list: the second is where that one is listed.
TEST(LabelsShifted, ASilentRadioHasItsLine) {
  const std::string silent = "<station name=\"c\" at=\"5 3 1.5\" yaw=\"1\"/>";
  const auto shifted = column(Site().world(effect("labels_shifted", "first=\"b\"") + silent), "link/*/rssi");
  const Site truth(moved(moved(survey(), "a", {14, 9, 4, -2}), "b", {5, 3, 1.5, 1}));
  EXPECT_TRUE(same_bits(shifted, column(truth.world(silent), "link/*/rssi")));
}

// By names the order is a, a2, a10, b, in the world a, b, a2, a10.
TEST(LabelsShifted, ByNamesTheOrderIsThatOfAListOfPeople) {
  const std::string silent = "<station name=\"a2\" at=\"7 3 1.5\"/><station name=\"a10\" at=\"5 3 1.5\"/>";
  const auto shifted = [&](const std::string& how) {
    return column(Site().world(effect("labels_shifted", "first=\"a2\"" + how) + silent), "link/*/rssi");
  };
  const Site truth(moved(moved(survey(), "b", {0, 0, 1, 0.5}), "a", {7, 3, 1.5, 0}));
  EXPECT_TRUE(same_bits(shifted(" order=\"names\""), column(truth.world(silent), "link/*/rssi")));
  EXPECT_FALSE(same_bits(shifted(" order=\"names\""), shifted("")));
}

std::vector<double> turned(const std::string& of, const std::string& how) {
  const std::string attributes = "of=\"" + of + "\" how=\"" + how + "\" x=\"6\" y=\"2\"";
  return column(Site().world(effect("plan_turned", attributes), true), "link/*/level");
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-9);
}

// The listed place is the true one turned: what is undone is the turn. Headings turn back, too.
TEST(PlanTurned, RadiosThatStandAreTurnedBack) {
  const Site mirrored(moved(moved(survey(), "a", {12, 0, 1, M_PI - 0.5}), "b", {-2, 9, 4, M_PI + 2}));
  expect_near(turned("stations", "mirrored_x"), column(mirrored.world("", true), "link/*/level"));
  const Site back(moved(moved(survey(), "a", {4, 8, 1, 0.5 - M_PI / 2}), "b", {13, -6, 4, -2 - M_PI / 2}));
  expect_near(turned("stations", "turned_90"), column(back.world("", true), "link/*/level"));
  const Site exchanged(moved(moved(survey(), "a", {4, -4, 1, M_PI / 2 - 0.5}), "b", {13, 10, 4, M_PI / 2 + 2}));
  expect_near(turned("stations", "transposed"), column(exchanged.world("", true), "link/*/level"));
}

// Without walls, whether all that moves or all that stands is turned is no matter but of the direction.
TEST(PlanTurned, OfRobotsItIsTheOppositeTurnOfStations) {
  const auto without_walls = [](const std::string& of, const std::string& how) {
    const std::string attributes = "of=\"" + of + "\" how=\"" + how + "\" x=\"6\" y=\"2\"";
    return column(Site().world(effect("plan_turned", attributes), true, 1, channel), "link/*/level");
  };
  expect_near(without_walls("robots", "turned_90"), without_walls("stations", "turned_270"));
  expect_near(without_walls("walls", "turned_90"), column(Site().world("", true, 1, channel), "link/*/level"));
  EXPECT_FALSE(same_bits(turned("walls", "turned_90"), column(Site().world("", true), "link/*/level")));
}

std::vector<double> shifted(const std::string& of, const std::string& east, const std::string& north,
                            const std::string& model = "") {
  const std::string attributes = "of=\"" + of + "\" east=\"" + east + "\" north=\"" + north + '"';
  const std::string it = effect("plan_shifted", attributes);
  return column(model.empty() ? Site().world(it, true) : Site().world(it, true, 1, model), "link/*/level");
}

TEST(PlanShifted, RadiosThatStandAreWhereTheyAreListedLessTheShift) {
  const Site moved_back(moved(moved(survey(), "a", {-3, 1, 1, 0.5}), "b", {11, 10, 4, -2}));
  expect_near(shifted("stations", "3", "-1"), column(moved_back.world("", true), "link/*/level"));
}

TEST(PlanShifted, OfWallsItIsTheOppositeShiftOfAllRadios) {
  EXPECT_FALSE(same_bits(shifted("walls", "3", "-1"), column(Site().world("", true), "link/*/level")));
  expect_near(shifted("robots", "3", "-1", channel), shifted("stations", "-3", "1", channel));
  expect_near(shifted("walls", "3", "-1", channel), column(Site().world("", true, 1, channel), "link/*/level"));
}

// Readings of a and b in turn, read a row late, are of the other one. The last row has none after it.
TEST(ColumnShifted, NamesComeFromTheRowAfter) {
  std::vector<Reading> alternating;
  for (const Reading& r : survey())
    if ((r.tx == "a" || r.tx == "b") && r.rx == "r") alternating.push_back(r);
  std::vector<Reading> sound = alternating;
  for (std::size_t i = 0; i + 1 < sound.size(); ++i) {
    sound[i].tx = alternating[i + 1].tx;
    sound[i].from = alternating[i + 1].from;
  }
  const auto shifted =
      column(Site(alternating).world(effect("column_shifted", "column=\"names\" by=\"1\""), true), "link/*/level");
  EXPECT_TRUE(same_bits(shifted, column(Site(sound).world("", true), "link/*/level")));
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

// Without times the file's rows are those of the readings; a file of another length is refused.
TEST(PowerSteps, WithoutTimesEachRowHoldsForItsReading) {
  Site site;
  std::string powers = "tx,power[dBm]\n";
  for (const Reading& r : site.readings) powers += r.tx + "," + (r.power == -10 ? "-10" : "0") + "\n";
  site.put("powers.csv", powers);
  const std::string it = effect("power_steps", "file=\"powers.csv\" error1=\"2\" error2=\"-1\"");
  const auto part = column(site.world(it), "link/*/level@it");
  for (std::size_t i = 0; i < part.size(); ++i) EXPECT_EQ(part[i], site.readings[i].power == -10 ? 2 : -1) << i;
  site.put("powers.csv", powers + "a,0\n");
  try {
    column(site.world(it), "link/*/level@it");
    ADD_FAILURE() << "a file of another length was taken";
  } catch (const std::exception& e) {
    EXPECT_NE(std::string(e.what()).find("without a column t the file's rows are those of the readings"),
              std::string::npos)
        << e.what();
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
