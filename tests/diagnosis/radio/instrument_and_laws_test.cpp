// Receiver checks and laws of a single reading, against closed forms and draws of known laws.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/radio/laws/fading_tests.hpp"
#include "diagnosis/radio/laws/law_likelihood.hpp"
#include "diagnosis/radio/links/receiver_checks.hpp"
#include "tests/diagnosis/scratch.hpp"
#include "tests/diagnosis/walk.hpp"

namespace muster::diagnosis {
namespace {

// `at_top` readings at -40 dBm, five at -41, `before` at -42 and -43, and 10 at each level down to -60.
Dataset readings(const Scratch& scratch, int at_top, int before = 10) {
  std::string text = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
  int row = 0;
  const auto add = [&](int level, int count) {
    for (int k = 0; k < count; ++k, ++row)
      text += std::to_string(row) + ",a,b,0,0," + std::to_string(row % 9 + 1) + ",2," + std::to_string(level) + "\n";
  };
  for (int level = -60; level < -41; ++level) add(level, level < -43 ? 10 : before);
  add(-41, 5);
  add(-40, at_top);
  return read_dataset(scratch.write("data.csv", text));
}

TEST(InstrumentChecks, ReadingsThatPileUpAreAClip) {
  const Scratch scratch;
  const ReceiverChecks found = receiver_checks(readings(scratch, 40));
  EXPECT_DOUBLE_EQ(found.step, 1);
  ASSERT_TRUE(found.top);
  EXPECT_DOUBLE_EQ(found.top->level, -40);
  EXPECT_EQ(found.top->count, 40u);
  EXPECT_EQ(found.top->beside, 5u);
  EXPECT_EQ(found.top->row, 195u);
  EXPECT_LT(found.top->log_p, std::log(1e-6));
  EXPECT_FALSE(found.bottom);  // 10 at the lowest level, 10 beside it
}

TEST(InstrumentChecks, ALevelThatIsReadOftenIsNoClip) {
  const Scratch scratch;
  EXPECT_FALSE(receiver_checks(readings(scratch, 10)).top);  // no more than its neighbours
  EXPECT_FALSE(receiver_checks(readings(scratch, 14)).top);  // too few to decide
}

TEST(InstrumentChecks, ASmallPileShowsBesideAllThatIsNear) {
  const Scratch scratch;
  EXPECT_FALSE(receiver_checks(readings(scratch, 27)).top);
  EXPECT_TRUE(receiver_checks(readings(scratch, 27, 3)).top);
}

ReceiverCheck check_called(const ReceiverChecks& instrument, const std::string& what) {
  for (const ReceiverCheck& c : instrument.checks)
    if (c.what.rfind(what, 0) == 0) return c;
  return {};
}

// 40 distinct readings with two decimals: their step is unknown, not zero.
std::string two_decimals(const std::string& sign) {
  std::string text = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
  for (int row = 0; row < 40; ++row)
    text += std::to_string(row) + ",a,b,0,0,1,2," + sign + "0." + std::to_string(11 + row) + "\n";
  return text;
}

TEST(InstrumentChecks, TooFewReadingsTellNoStep) {
  const Scratch scratch;
  EXPECT_EQ(check_called(receiver_checks(readings(scratch, 40)), "the step").found, "1 dB");
  EXPECT_EQ(check_called(receiver_checks(read_dataset(scratch.write("data.csv", two_decimals("-")))), "the step").found,
            "not known: 40 readings of 40 levels are too few to tell; three levels and four readings a level would do");
}

TEST(InstrumentChecks, MilliwattsAreNoLevels) {
  const Scratch scratch;
  const auto check = [&](const std::string& sign) {
    const auto file = scratch.write("data.csv", two_decimals(sign));
    return check_called(receiver_checks(read_dataset(file)), "levels above 0 dBm");
  };
  EXPECT_TRUE(check("-").fine);
  EXPECT_EQ(check("-").found, "none in 40 rows");
  EXPECT_FALSE(check("").fine);
  EXPECT_EQ(check("").found, "40 of 40 readings: are they in mW (dBm = 10 log10 of mW), or is a sign lost?");
  EXPECT_EQ(check("").row, 1u);
}

TEST(InstrumentChecks, AReadingFarFromAllOthersIsToldWithItsRow) {
  const Scratch scratch;
  const auto check = [&](const std::string& more) {
    const auto file = scratch.write("data.csv", two_decimals("-") + more);
    return check_called(receiver_checks(read_dataset(file)), "one to three readings 30 dB");
  };
  EXPECT_TRUE(check("41,a,b,0,0,1,2,-30\n").fine);  // 29.5 dB below the next
  const ReceiverCheck low = check("41,a,b,0,0,1,2,-90\n42,a,b,0,0,1,2,-95\n");
  EXPECT_FALSE(low.fine);
  EXPECT_EQ(low.found, "-95 dBm");
  EXPECT_EQ(low.row, 42u);
  EXPECT_EQ(check("41,a,b,0,0,1,2,29.9\n").row, 41u);
  std::string many;
  for (int row = 41; row < 45; ++row) many += std::to_string(row) + ",a,b,0,0,1,2,-90\n";
  EXPECT_TRUE(check(many).fine);  // four are a level of their own
}

TEST(InstrumentChecks, LevelsAreToldWithoutDigitsThatNobodyMeasured) {
  const Scratch scratch;
  std::string text = two_decimals("-") + "41,a,b,0,0,1,2,-0.1000000000000003\n";
  const ReceiverChecks found = receiver_checks(read_dataset(scratch.write("data.csv", text)));
  EXPECT_EQ(check_called(found, "readings that pile up at the highest").found, "1 at -0.1 dBm");
}

TEST(LawOfAReading, VariancesAreThoseOfRayleighAndGamma) {
  const double decibel = 10 / std::log(10.0);
  EXPECT_NEAR(fading_variance(-40, 1), decibel * decibel * M_PI * M_PI / 6, 0.1);
  EXPECT_NEAR(fading_variance(-40, 4), decibel * decibel * 0.2838229557, 0.02);  // trigamma(4)
  for (const double k : {-3.0, 4.0, 12.0}) EXPECT_NEAR(rician_k_of(fading_variance(k, 1), 1), k, 0.01);
  EXPECT_TRUE(std::isnan(rician_k_of(60, 1)));
}

TEST(LawOfAReading, DensitiesHaveTheirMassAboutTheirMean) {
  const ReadingDistribution law{.rician_k = 5, .outliers = 0.02, .channel_sd = 3, .channels = 2};
  const ReadingDensities densities(law, 1, std::log(0.3), std::log(20.0));
  for (const double spread : {0.3, 1.1, 7.0, 20.0}) {
    double mass = 0, mean = 0, square = 0;
    for (double db = -60; db < 50; db += 0.05) {
      const double density = 0.05 * std::exp(densities.log_at(db, std::log(spread)));
      mass += density;
      mean += db * density;
      square += db * db * density;
    }
    EXPECT_NEAR(mass, 1, 0.001);
    EXPECT_NEAR(mean, 0, 0.01);
    EXPECT_NEAR(square, variance_of(law, 1) + spread, 0.01 * (variance_of(law, 1) + spread));
  }
}

const noise::Covariance near_the_truth{noise::Family::exponential, {2.2, 0.4, 1.5, 0}};

std::vector<LawTest> tested(const Truth& truth, const ReadingDistribution& stated) {
  const Walk walk = drawn(truth, 2000);
  KrigedReadings field(walk.readings, walk.residual);
  return law_tests(field, 1, stated, near_the_truth).tests;
}

TEST(LawsOfReadings, TheStatedLawIsNotLeftWithoutReason) {
  for (const LawTest& test : tested({.rician_k = 6}, {.rician_k = 6}))
    EXPECT_GT(test.log_p, std::log(0.01)) << test.cause;
}

TEST(LawsOfReadings, TheFieldsSizeIsTheSameFromWhereverItIsSought) {
  const ReadingDistribution law{.rician_k = 6};
  const Walk walk = drawn({.rician_k = 6}, 2000);
  KrigedReadings field(walk.readings, walk.residual);
  LawLikelihood judge(field, 1);
  const FieldShape shape{noise::Family::exponential, 400};
  const Peak near = judge.best(law, {0, shape, 0});
  for (const int from : {-6000, -3000, 3000, 6000}) {
    const Peak far = judge.best(law, {0, shape, from});
    EXPECT_NEAR(far.place, near.place, LawLikelihood::places) << from;
    EXPECT_NEAR(far.value, near.value, 1) << from;
  }
}

// A subsample gives the start; the result is the best on all readings.
TEST(LawsOfReadings, ShapesOfManyReadingsAreTheBestByAllOfThem) {
  constexpr double likely = 6;  // nats
  const ReadingDistribution law{.rician_k = 6};
  Walk walk = drawn_of_four({.rician_k = 6}, 7750, 7.5);
  walk.readings.rx_at *= 0.2;
  KrigedReadings field(walk.readings, walk.residual);
  LawLikelihood judge(field, 1);
  const std::vector<Peak> peaks = judge.shapes(law, near_the_truth);
  const auto lower = [](const Peak& a, const Peak& b) { return a.value < b.value; };
  const Peak best = *std::max_element(peaks.begin(), peaks.end(), lower);
  for (const Peak& peak : peaks) {
    const double further = judge.best_distance(law, peak).value;
    EXPECT_LT(further, peak.value > best.value - likely ? peak.value + 1 : best.value - likely);
  }
  KrigedReadings some = field.some(10000);
  EXPECT_GT(some.size(), 5000);
  EXPECT_LT(some.size(), 11000);
  // The subsample keeps whole neighbourhoods: every fourth reading alone would have larger prediction errors.
  const auto told = [&](KrigedReadings& of) { return of.view(best.shape, best.place).log_spread.mean(); };
  EXPECT_NEAR(told(some), told(field), 0.06);
}

TEST(LawsOfReadings, ReadingsSideBySideTellTheVarianceOfOne) {
  for (const double distance : {0.7, 1.5}) {
    const Walk walk = drawn({.rician_k = 4}, 6000, distance);
    LinkReadings near = walk.readings;
    near.rx_at *= 0.1;  // 1.5 cm apart, in a field that changes ten times as fast
    const CloseReadings close = KrigedReadings(near, walk.residual).close_readings();
    EXPECT_GT(close.pairs, 2500);
    EXPECT_LE(close.pairs, 3000);
    const double one = variance_of({.rician_k = 4}, 1);
    EXPECT_NEAR(close.variance, one, 3 * close.standard_error) << distance;
    EXPECT_LT(close.standard_error, 0.12 * one);
  }
  const Walk far = drawn({.rician_k = 4}, 150);  // all as far apart
  EXPECT_TRUE(std::isinf(KrigedReadings(far.readings, far.residual).close_readings().standard_error));
}

// The variogram of a smooth field begins as a parabola: a line would underestimate the variance.
TEST(LawsOfReadings, ReadingsSideBySideTellTheVarianceInASmoothFieldToo) {
  constexpr int count = 6000;
  constexpr double sd = 1.4;  // dB
  const Stream random(key_of("smooth field"));
  Walk walk = drawn({.rician_k = 4}, count);
  double x = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = static_cast<uint64_t>(i);
    x += 0.3 * random.uniform(k, 0);  // m
    walk.readings.rx_at.col(i) = Eigen::Vector3d(x, 0, 1);
    walk.residual[i] = 8 * std::sin(2 * x) + sd * random.normal(k, 1);
  }
  const CloseReadings close = KrigedReadings(walk.readings, walk.residual).close_readings();
  EXPECT_GT(close.pairs, 2000);
  EXPECT_NEAR(close.variance, sd * sd, 3 * close.standard_error);
  EXPECT_LT(close.standard_error, 0.1 * sd * sd);
}

// A field faster than any tried resembles a wider law; adjacent readings separate them. (They hold too little on
// tails to exclude outliers.)
TEST(LawsOfReadings, ReadingsSideBySideSpeakAgainstAnotherLaw) {
  Walk walk = drawn({.rician_k = 6}, 6000);
  for (Eigen::Index i = 0; i < walk.residual.size(); ++i) {
    const Eigen::Index first = i - i % 2;
    walk.readings.rx_at(0, i) =
        walk.readings.rx_at(0, first) + (i % 2 ? 0.005 * static_cast<double>(first / 2 % 5) : 0);
    walk.residual[i] += std::round(3 * Stream(key_of("places")).normal(static_cast<uint64_t>(first)));
  }
  KrigedReadings field(walk.readings, walk.residual);
  for (const LawTest& test : law_tests(field, 1, {.rician_k = 6}, near_the_truth).tests) {
    if (test.cause == "effect.outliers") continue;
    EXPECT_EQ(test.gain, 0) << test.cause;
  }
}

// Readings a fiftieth of the decorrelation distance apart, with deep fades: with winsorised predictions alone, a
// weaker fading law would gain 24.
TEST(LawsOfReadings, TamedDeepFadesAreNoOtherFading) {
  const Walk walk = drawn_of_four({.rician_k = 5}, 1500, 30, 30);
  KrigedReadings field(walk.readings, walk.residual);
  const noise::Covariance dense{noise::Family::exponential, {2.2, std::log(30), std::log(fading_variance(5, 1)), 0}};
  for (const LawTest& test : law_tests(field, 1, {.rician_k = 5}, dense).tests) EXPECT_LT(test.gain, 9) << test.cause;
}

TEST(LawsOfReadings, AnotherFadingIsMeasured) {
  const LawTest best = tested({.rician_k = 2}, {.rician_k = 8}).front();
  EXPECT_EQ(best.cause, "effect.fading_law");
  EXPECT_GT(best.evidence, 20);
  EXPECT_LT(best.values[0].lower95, 2);
  EXPECT_GT(best.values[0].upper95, 2);
}

// In the field fitted to the stated law, the estimate was biased by a quarter towards the stated strength.
TEST(LawsOfReadings, WhatIsStatedDoesNotPullWhatIsMeasured) {
  std::vector<double> measured;
  for (const double stated : {2.0, 3.5, 12.0}) {
    const LawTest best = tested({.rician_k = 6}, {.rician_k = stated}).front();
    ASSERT_EQ(best.cause, "effect.fading_law") << stated;
    EXPECT_NEAR(best.values[0].value, 6, 0.6) << stated;
    measured.push_back(best.values[0].value);
  }
  EXPECT_NEAR(measured[0], measured[2], 0.1);
  EXPECT_NEAR(measured[1], measured[2], 0.1);
}

TEST(LawsOfReadings, OutliersAreCounted) {
  const LawTest best = tested({.rician_k = 8, .outliers = 0.03}, {.rician_k = 8}).front();
  EXPECT_EQ(best.cause, "effect.outliers");
  EXPECT_NEAR(best.values[0].value, 0.03, 0.012);
}

TEST(LawsOfReadings, HoppingChannelsAreToldFromFading) {
  const LawTest best = tested({.rician_k = 12, .channel_sd = 4}, {.rician_k = 12}).front();
  EXPECT_EQ(best.cause, "effect.channel_mixture");
  EXPECT_NEAR(best.values[0].value, 4, 0.6);
}

}  // namespace
}  // namespace muster::diagnosis
