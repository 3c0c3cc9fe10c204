// Shape of a cause, from attributes of its plugin.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "diagnosis/pipeline/cause_estimate.hpp"
#include "diagnosis/pipeline/declared_law_check.hpp"
#include "diagnosis/planning/second_station.hpp"
#include "diagnosis/radio/causes/applicability.hpp"
#include "diagnosis/radio/causes/place_axes.hpp"
#include "tests/diagnosis/scratch.hpp"
#include "tests/diagnosis/worlds.hpp"

namespace muster::diagnosis {
namespace {

// exp(log(100)) is above 100, which a plugin would refuse.
TEST(CauseShape, AParameterSoughtByItsLogarithmStaysInsideItsBounds) {
  muster_param permittivity{};
  permittivity.name = "permittivity";
  permittivity.unit = "";
  permittivity.min = 1.5;
  permittivity.max = 100;
  permittivity.flags = MUSTER_LOG;
  CauseShape shape;
  const auto axis = axis_of(permittivity, MeasurementGeometry{}, shape, true);
  ASSERT_TRUE(axis);
  shape.axes = {*axis};
  for (const double end : {axis->lower, axis->upper}) {
    const double value = shape.parameters(Eigen::Vector2d(0, end)).at("permittivity");
    EXPECT_GE(value, permittivity.min);
    EXPECT_LE(value, permittivity.max);
  }
}

// The grid is dense enough for oscillations: half a cycle off over the data, a wave keeps 40 % of its energy.
TEST(CauseShape, SwingsOfManyCyclesAreSought) {
  muster_param period{};
  period.name = "period";
  period.unit = "s";
  period.min = 0.1;
  period.max = 1e6;
  period.flags = MUSTER_LOG;
  CauseShape shape;
  shape.wave = "phase";
  // Of a short log 31 swings: one of 3.4 s and 6 dB was below the shortest period.
  for (const auto& [span, most] : {std::pair(1200.0, 120.0), std::pair(100.0, 31.0)}) {
    MeasurementGeometry survey;
    survey.time = Span{100, 100 + span};
    const auto axis = axis_of(period, survey, shape, true);
    ASSERT_TRUE(axis);
    for (double cycles = 2; cycles < most; cycles += 0.37) {
      double nearest = 1e9;
      for (const double value : axis->values) nearest = std::min(nearest, std::abs(span / std::exp(value) - cycles));
      EXPECT_LE(nearest, 0.4) << cycles;
      EXPECT_LT(axis->lower, std::log(span / cycles));
    }
  }
}

// Sessions of 20 minutes a year apart: jumps are sought within them and between them, swings of minutes in each.
TEST(CauseShape, StartsOfTimesLieWithinTheSessions) {
  std::vector<double> t;
  for (int k = 0; k <= 1200; ++k) t.push_back(k), t.push_back(3.15e7 + k);
  const RecordedTime time(t);
  muster_param at{};
  at.name = "at";
  at.unit = "s";
  at.max = 1e10;
  const auto jumps = axis_over(at, time, {}, true);
  ASSERT_TRUE(jumps);
  int first = 0, second = 0;
  for (const double entry : jumps->values) {
    const double v = jumps->value_at(entry);
    first += v >= 0 && v <= 1200;
    second += v >= 3.15e7 && v <= 3.15e7 + 1200;
  }
  EXPECT_GE(first, 12);
  EXPECT_GE(second, 12);
  EXPECT_LT(first + second, static_cast<int>(jumps->values.size()));
  muster_param period{};
  period.name = "period";
  period.unit = "s";
  period.min = 0.1;
  period.max = 1e6;
  period.flags = MUSTER_LOG;
  CauseShape wave;
  wave.wave = "phase";
  const auto swings = axis_over(period, time, wave, true);
  ASSERT_TRUE(swings);
  EXPECT_LT(std::exp(swings->values.back()), 30);
  EXPECT_LT(swings->values.size(), 400u);
}

// Data of a month, and of half a year, for an author's cause that settles in eleven days at most: the second leave no
// time to settle, and it stays as it is set.
TEST(CauseShape, DataThatLastLongerThanItMaySettleLeaveItAsItIs) {
  muster_param settling{};
  settling.name = "settling";
  settling.unit = "s";
  settling.min = 1;
  settling.max = 1e6;
  settling.flags = MUSTER_LOG;
  const auto over = [&](double days) {
    std::vector<double> t;
    for (int k = 0; k <= 1000; ++k) t.push_back(days * 86400 * k / 1000);
    return axis_over(settling, RecordedTime(t), {}, true);
  };
  ASSERT_TRUE(over(30));
  EXPECT_LT(over(30)->lower, over(30)->upper);
  EXPECT_FALSE(over(180));
}

TEST(CauseRows, AnInstanceIsFoundByTheNameThatItHas) {
  const Scratch scratch;
  const auto data = scratch.write("data.csv",
                                  "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m],rssi[dBm]\n"
                                  "0,a,b,0,0,1,9,0,1,-60\n1,a,b,0,0,1,8,0,1,-59\n");
  const auto named = [&](const std::string& name) {
    const auto world =
        scratch.write("world.xml",
                      "<world name=\"w\" dt=\"0.1\" until=\"1\"><station name=\"a\" at=\"0 0 1\"/><station name=\"b\" "
                      "at=\"9 0 1\"/><radio.multiwall tx_power=\"0\"/><radio.fading" +
                          name + " shadowing=\"3\"/></world>\n");
    const LinkModel model(world, data, plugins);
    return names_of_instances(cause_on(plugins, "effect.shadowing_correlation"), model.simulation());
  };
  EXPECT_TRUE(named("").empty());
  EXPECT_EQ(named(" name=\"fades\""), (std::map<std::string, std::string>{{"of", "fades"}}));
}

// One of the data's radios turns: a cause may be about it, whether the world lists it or not.
TEST(CauseRows, ARadioThatOnlyTheDataNameIsOne) {
  const Scratch scratch;
  const std::string rows =
      "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rx_yaw[rad],rssi[dBm]\n"
      "0,s,rover,0,0,1,0,0,-50\n1,s,rover,0,0,2,0,1,-51\n2,s,rover,0,0,3,0,2,-52\n"
      "3,s,rover,0,0,4,0,3,-50\n4,s,rover,0,0,5,0,4,-51\n";
  muster_param radio{};
  radio.name = radio.text = "radio";
  radio.kind = MUSTER_REFERENCE;
  radio.flags = MUSTER_REQUIRED;
  muster_cause meaning{};
  meaning.title = meaning.tell_apart = "";
  meaning.ranges_over = "radio";
  meaning.covariates = "rx_yaw";
  muster_plugin plugin{};
  plugin.params = &radio;
  plugin.param_count = 1;
  plugin.cause = &meaning;
  const Cause cause{"effect.notch", {}, &plugin};
  const auto told = [&](const std::string& station) {
    const auto world =
        scratch.write("world.xml", "<world name=\"w\" dt=\"1\" until=\"1\"><station name=\"s\" at=\"0 0 1\"/>" +
                                       station + "<radio.multiwall/></world>");
    const auto file = scratch.write("d.csv", rows);
    const LinkModel model(world, file, plugins);
    const MeasurementGeometry survey = measurement_geometry(model, read_dataset(file));
    const auto found = rows_for(cause, model, survey);
    return found.empty() ? why_no_rows(cause) : "about " + found.at(0).at(0);
  };
  EXPECT_EQ(told(""), "about rover");
  EXPECT_EQ(told("<station name=\"rover\" at=\"1 0 1\"/>"), "about rover");
}

// A radio that is not where the map says casts no shadow that a second station would see from the side.
TEST(CauseShape, APlaceOfWhatTheMapHasIsNoneOfAThing) {
  muster_param radio{};
  radio.name = radio.text = "radio";
  radio.kind = MUSTER_REFERENCE;
  muster_cause meaning{};
  meaning.ranges_over = "radio";
  muster_plugin plugin{};
  plugin.cause = &meaning;
  plugin.params = &radio;
  CauseShape shape;
  shape.place = PlaceShape::point;
  shape.cause = {"effect.moved", {}, &plugin};
  inference::Finding finding;
  finding.thetas = {Eigen::Vector3d(0, 1, 2)};
  EXPECT_EQ(places_of(shape, finding).size(), 1u);
  plugin.param_count = 1;
  EXPECT_TRUE(places_of(shape, finding).empty());
}

// What a robot sends is heard by stations that all look east: a pattern about their heading is one over the plan.
TEST(CauseRows, WhatDependsOnAHeadingIsAboutEveryReceiverOnlyWhereReceiversTurn) {
  const auto rows_about_all = [](bool receivers_turn) {
    const Scratch scratch;
    std::string rows = "t[s],tx,rx,tx_x[m],tx_y[m],tx_yaw[rad],rx_x[m],rx_y[m],rx_yaw[rad],rssi[dBm]\n";
    for (int k = 0; k < 60; ++k) {
      const std::string robot = fmt::format("{},{},{}", 1 + k % 9, 2 + k % 7, 0.1 * k), station = "0,0,0";
      rows += receivers_turn ? fmt::format("{},s,rover,{},{},{}\n", k, station, robot, -50 - k % 3)
                             : fmt::format("{},rover,s,{},{},{}\n", k, robot, station, -50 - k % 3);
    }
    const auto world = scratch.write("world.xml",
                                     "<world name=\"w\" dt=\"1\" until=\"1\"><station name=\"s\" at=\"0 0 1\"/>"
                                     "<station name=\"rover\" at=\"1 0 1\"/><radio.multiwall/></world>");
    const auto file = scratch.write("d.csv", rows);
    const LinkModel model(world, file, plugins);
    std::vector<std::string> names;
    for (const Cause& cause : causes_on(plugins)) {
      if (cause.id != "effect.body_shadow") continue;
      for (const CauseRow& row : rows_for(cause, model, measurement_geometry(model, read_dataset(file))))
        names.push_back(row.at(0));
    }
    return names;
  };
  EXPECT_EQ(rows_about_all(true), (std::vector<std::string>{"", "rover"}));
  EXPECT_EQ(rows_about_all(false), std::vector<std::string>{"rover"});
}

// A cause that tells sending from receiving is about radios that do both; a reading in a hundred is not enough.
TEST(CauseRows, SendingIsToldFromReceivingWhereARadioDoesBoth) {
  const auto asymmetric = [](int sent_by_b) {
    const Scratch scratch;
    std::string rows = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
    for (int k = 0; k < 100; ++k) {
      const bool turned = k < sent_by_b;
      rows += fmt::format("{},{},{},0,0,{},1,{}\n", k, turned ? "b" : "a", turned ? "a" : "b", 1 + k % 7, -50 - k % 3);
    }
    const auto world = scratch.write("world.xml",
                                     "<world name=\"w\" dt=\"1\" until=\"1\"><station name=\"a\" at=\"0 0 1\"/>"
                                     "<station name=\"b\" at=\"1 0 1\"/><radio.multiwall/></world>");
    const auto file = scratch.write("d.csv", rows);
    const LinkModel model(world, file, plugins);
    for (const Cause& cause : causes_on(plugins)) {
      if (cause.id != "effect.asymmetry") continue;
      const auto found = rows_for(cause, model, measurement_geometry(model, read_dataset(file)));
      return found.empty() ? why_no_rows(cause) : fmt::format("{} radios", found.size());
    }
    return std::string("no such cause");
  };
  const std::string none =
      "not testable: the world has no row that it could be about (one is needed, of the radios that send and receive)";
  EXPECT_EQ(asymmetric(0), none);
  EXPECT_EQ(asymmetric(1), none);
  EXPECT_EQ(asymmetric(40), "2 radios");
}

// Measurement geometry of a radio with these poses that receives from one station.
MeasurementGeometry heard_at(const std::vector<std::array<double, 3>>& places_and_headings) {
  const Scratch scratch;
  std::string rows = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rx_yaw[rad],rssi[dBm]\n";
  for (std::size_t k = 0; k < 60; ++k) {
    const auto [x, y, yaw] = places_and_headings[k * places_and_headings.size() / 60];
    rows += fmt::format("{},a,b,0,0,{},{},{},{}\n", k, x, y, yaw, k % 2 == 0 ? -50 : -51);
  }
  const auto world = scratch.write("world.xml",
                                   "<world name=\"w\" dt=\"1\" until=\"1\"><station name=\"a\" at=\"0 0 1\"/>"
                                   "<station name=\"b\" at=\"1 0 1\"/><radio.multiwall/></world>");
  const auto file = scratch.write("d.csv", rows);
  return measurement_geometry(LinkModel(world, file, plugins), read_dataset(file));
}

// Snapshots an hour apart, of 20 readings within a minute each, have no swing of an hour; an even run of the same
// length may.
TEST(MeasurementGeometry, KnowsAScheduleOfSnapshots) {
  const auto sampling = [](const auto& time_of) {
    const Scratch scratch;
    std::string rows = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
    for (int k = 0; k < 200; ++k) rows += fmt::format("{},a,b,0,0,{},1,{}\n", time_of(k), 1 + k % 7, -50 - k % 3);
    const auto world = scratch.write("world.xml",
                                     "<world name=\"w\" dt=\"1\" until=\"1\"><station name=\"a\" at=\"0 0 1\"/>"
                                     "<station name=\"b\" at=\"1 0 1\"/><radio.multiwall/></world>");
    const auto file = scratch.write("d.csv", rows);
    return measurement_geometry(LinkModel(world, file, plugins), read_dataset(file)).sampling;
  };
  EXPECT_NEAR(sampling([](int k) { return 3600 * (k / 20) + 3 * (k % 20); }), 3600, 60);
  EXPECT_NEAR(sampling([](int k) { return 0.3 * k; }), 0.3, 1e-6);
  // A long pause in an even run is no schedule.
  EXPECT_NEAR(sampling([](int k) { return 0.3 * k + (k < 100 ? 0 : 1e5); }), 0.3, 1e-6);
}

TEST(MeasurementGeometry, TakesARadioThatIsSetUpAFewTimesForOneThatStands) {
  const MeasurementGeometry turned = heard_at({{3, 1, 0}, {3, 1, M_PI / 2}}), moved = heard_at({{3, 1, 0}, {8, 5, 0}});
  for (const MeasurementGeometry& s : {turned, moved}) {
    EXPECT_FALSE(s.turns.at(1));
    EXPECT_FALSE(s.moves.at(1));
  }
  EXPECT_EQ(moved.standing.size(), 3u);  // of the station and of both
  const MeasurementGeometry on_the_spot = heard_at({{3, 1, 0}, {3, 1, 1}, {3, 1, 2}, {3, 1, 3}, {3, 1, 4}, {3, 1, 5}});
  EXPECT_TRUE(on_the_spot.turns.at(1));
  EXPECT_FALSE(on_the_spot.moves.at(1));
  const MeasurementGeometry drives =
      heard_at({{3, 1, 0}, {4, 1, 0}, {5, 1, 1.5}, {5, 2, 1.5}, {5, 3, 1.5}, {5, 4, 1.5}});
  EXPECT_TRUE(drives.turns.at(1));
  EXPECT_TRUE(drives.moves.at(1));
}

// Beyond 520 m an exponent of 3 was lower by 5: a hill, as it happens.
TEST(CauseEstimate, AStrengthAtItsBoundIsInDoubt) {
  CauseEstimate slope;
  slope.values = {{"break", "m", 520, 30, 440, 590, 0.5, 1e5}, {"n_change", "", -5, 0.5, -5, -3, -5, 10}};
  EXPECT_EQ(doubt_at_own_bound(slope), "its n_change ends at the bound of -5, so that something else may do this");
  slope.values[1].value = -4.9;
  EXPECT_EQ(doubt_at_own_bound(slope), "");
  CauseEstimate hard, whole;
  hard.values = {{"edge", "m", 0, 0, 0, 0.3, 0, 1}, {"loss", "dB", 0, 1, 0, 2, 0, 40}};
  whole.values = {{"share", "", 1, 0.1, 0.9, 1, 0, 1}};
  EXPECT_EQ(doubt_at_own_bound(hard) + doubt_at_own_bound(whole), "");
  CauseEstimate two;  // channels, of which there are two at least
  two.values = {{"channels", "", 2, 0, 2, 2, 2, 100}};
  EXPECT_EQ(doubt_at_own_bound(two), "");
}

// Of 1 to 10,000 dB a thousandth is 10 dB; by ratios 8 dB are a fifth of the way from 1.
TEST(CauseEstimate, AStrengthSoughtByItsLogarithmIsAtItsBoundByItsRatio) {
  CauseEstimate saturates;
  saturates.values = {{"knee", "dB", 8, 1, 6, 10, 1, 1e4, false, true}};
  EXPECT_EQ(doubt_at_own_bound(saturates), "");
  saturates.values[0].value = 1.005;
  EXPECT_NE(doubt_at_own_bound(saturates), "");
}

// A factor of e in either direction: 1.96 of those, not 216 dB about 100.
TEST(CauseEstimate, IntervalOfAParameterSoughtByItsLogarithmIsAFactor) {
  muster_param knee{};
  knee.name = "knee";
  knee.unit = "dB";
  knee.min = 1;
  knee.max = 1e4;
  knee.flags = MUSTER_LOG;
  muster_cause meaning{};
  meaning.title = meaning.ranges_over = meaning.tell_apart = "";
  muster_plugin plugin{};
  plugin.params = &knee;
  plugin.param_count = 1;
  plugin.cause = &meaning;
  auto shape = std::make_shared<CauseShape>();
  shape->cause.plugin = &plugin;
  shape->axes = {*axis_of(knee, MeasurementGeometry{}, *shape, true)};
  inference::Finding found;
  found.theta = Eigen::Vector2d(0, std::log(100));
  for (const double way : {-1, 1}) found.thetas.push_back(Eigen::Vector2d(0, std::log(100) + way));
  const CauseEstimate cause = cause_estimate(found, {shape, {}});
  ASSERT_EQ(cause.values.size(), 1u);
  EXPECT_NEAR(cause.values[0].lower95, 100 * std::exp(-1.96), 1e-9);
  EXPECT_NEAR(cause.values[0].upper95, 100 * std::exp(1.96), 1e-9);
}

}  // namespace
}  // namespace muster::diagnosis
