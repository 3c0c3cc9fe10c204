// Laws of single readings: closed forms, and draws whose law is known.
#include "diagnosis/radio/laws/fading_tests.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/radio/laws/law_likelihood.hpp"
#include "tests/diagnosis/radio/declared_laws.hpp"
#include "tests/diagnosis/walk.hpp"

namespace muster::diagnosis {
namespace {

TEST(ReadingDistribution, VariancesAreThoseOfRayleighAndGamma) {
  const double decibel = 10 / std::log(10.0);
  const ReadingLaw& fading = *declared_law("effect.fading_law");
  EXPECT_NEAR(fading.variance({-40}, 1), decibel * decibel * M_PI * M_PI / 6, 0.1);
  EXPECT_NEAR(fading.variance({-40}, 4), decibel * decibel * 0.2838229557, 0.02);  // trigamma(4)
  for (const double k : {-3.0, 4.0, 12.0})
    EXPECT_NEAR(fading.strength_of(fading.variance({k}, 1), {0}, 1).value_or(99), k, 0.01);
  EXPECT_FALSE(fading.strength_of(60, {0}, 1));
  EXPECT_EQ(fading.nearest_strength(60, {0}), -40);
  EXPECT_EQ(fading.nearest_strength(0.001, {0}), 60);
}

// Outliers need winsorising; hopping channels do not.
TEST(ReadingDistribution, OnlyOutliersHaveHeavyTails) {
  for (const double share : {0.001, 0.1}) EXPECT_TRUE(declared_law("effect.outliers")->is_heavy_tailed({share, 20}));
  for (const double channels : {2.0, 3.0, 4.0})
    EXPECT_FALSE(declared_law("effect.channel_mixture")->is_heavy_tailed({3, channels}));
}

TEST(ReadingDistribution, DensitiesHaveUnitMassAndTheStatedMoments) {
  const ReadingDistribution law = law_of({.rician_k = 5, .outliers = 0.02, .channel_sd = 3, .channels = 2});
  ReadingDensities densities(law, 1);
  densities.reach(std::log(20.0));
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

std::vector<LawTest> tested(const Truth& truth, const Scatter& stated) {
  const Walk walk = drawn(truth, 2000);
  KrigedReadings field(walk.readings, walk.residual);
  return law_tests(field, 1, shipped_laws, law_of(stated), near_the_truth).tests;
}

TEST(FadingTests, NoFalseAlarmForTheStatedLaw) {
  for (const LawTest& test : tested({.rician_k = 6}, {.rician_k = 6}))
    EXPECT_GT(test.log_p, std::log(0.01)) << test.cause;
}

// A noisy receiver in a world whose readings do not scatter. A law of another shape is found all the same.
TEST(FadingTests, NormalNoiseOfAWorldThatStatesNoneIsNoLaw) {
  for (const LawTest& test : tested({.rician_k = 60, .noise = 1.5}, {.rician_k = 60}))
    EXPECT_GT(test.log_p, std::log(0.001)) << test.cause;
  const LawTest fading = tested({.rician_k = 5}, {.rician_k = 60}).front();
  EXPECT_EQ(fading.cause, "effect.fading_law");
  EXPECT_LT(fading.log_p, std::log(1e-6));
  ASSERT_FALSE(fading.values.empty());
  EXPECT_NEAR(fading.values[0].value, 5, 1.5);
}

// The null's noise is refined as that beside a law is: between the sizes that are tried a law gained 2.8 at 3.6 dB.
TEST(FadingTests, NormalNoiseBetweenTheSizesThatAreTriedIsNoLaw) {
  for (const double noise : {1.25, 3.6}) {
    const Walk walk = drawn_of_four({.rician_k = 60, .noise = noise}, 2000, 1.5);
    KrigedReadings field(walk.readings, walk.residual);
    const LawTests result = law_tests(field, 1, shipped_laws, law_of({.rician_k = 60}), near_the_truth);
    EXPECT_NEAR(result.stated.noise, noise, 0.05);
    for (const LawTest& test : result.tests) EXPECT_LT(test.gain, 2) << test.cause << ", noise " << noise;
  }
}

TEST(FadingTests, FieldSizeIsIndependentOfTheStart) {
  const ReadingDistribution law = law_of({.rician_k = 6});
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

TEST(FadingTests, TheLikelihoodIsTheSumOverReadings) {
  const Walk walk = drawn({.rician_k = 6, .outliers = 0.02}, 2000);
  KrigedReadings field(walk.readings, walk.residual);
  LawLikelihood judge(field, 1);
  for (const int place : {-4000, 0, 2600}) {
    const Peak there{0, {noise::Family::exponential, 400}, place};
    for (const ReadingDistribution& law : {law_of({.rician_k = 6}), law_of({.rician_k = 60, .outliers = 0.01})}) {
      const double sum = judge.each(law, there).sum();
      EXPECT_NEAR(judge.value(law, there), sum, 1e-9 * std::abs(sum)) << place;
    }
  }
}

// Between two tabulated spreads the density is linear in the variance.
TEST(ReadingDistribution, DensitiesAreInterpolatedInTheVariance) {
  ReadingDensities densities(law_of({.rician_k = 5}), 1);
  densities.reach(2);
  const double low = std::exp(0.4), high = std::exp(0.8);  // tabulated, 0.4 apart
  for (const double db : {-12.0, -3.3, 0.0, 2.1, 9.0}) {
    const double at_low = densities.at(db, 0.4, low), at_high = densities.at(db, 0.8, high);
    for (const double part : {0.1, 0.5, 0.8}) {
      const double variance = low + part * (high - low);
      const double density = densities.at(db, std::log(variance), variance);
      EXPECT_NEAR(density, at_low + part * (at_high - at_low), 1e-12) << db;
      EXPECT_EQ(densities.log_at(db, std::log(variance)),
                std::log(densities.at(db, std::log(variance), std::exp(std::log(variance)))));
    }
  }
}

// A spread narrower than a bin is not lost in it, or a field would look a little smaller than it is.
TEST(ReadingDistribution, NarrowSpreadsAddTheirVariance) {
  for (const bool steady : {true, false}) {
    const ReadingDistribution law = steady ? ReadingDistribution{} : law_of({.rician_k = 5});
    ReadingDensities densities(law, steady ? 0 : 1);
    densities.reach(1);
    const auto variance = [&](double spread) {
      double square = 0, mass = 0;
      for (double db = -40; db < 40; db += 0.05) {
        const double density = densities.at(db, std::log(spread), spread);
        mass += density;
        square += db * db * density;
      }
      return square / mass;
    };
    const double alone = variance(1e-9);
    for (const double spread : {1e-4, 1e-3, 0.01, 0.02, 0.05, 0.2, 1.0})
      EXPECT_NEAR(variance(spread) - alone, spread, 0.002 * spread + 1e-6) << spread;
  }
}

// A subsample gives the start; the result is the best on all readings.
TEST(FadingTests, ShapesOfASubsetAreRankedByAllReadings) {
  constexpr double likely = 6;  // nats
  const ReadingDistribution law = law_of({.rician_k = 6});
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

TEST(FadingTests, CloseReadingsGiveTheVarianceOfOne) {
  for (const double distance : {0.7, 1.5}) {
    const Walk walk = drawn({.rician_k = 4}, 6000, distance);
    LinkReadings near = walk.readings;
    near.rx_at *= 0.1;  // 1.5 cm apart, in a field that changes ten times as fast
    const CloseReadings close = KrigedReadings(near, walk.residual).close_readings();
    EXPECT_GT(close.pairs, 2500);
    EXPECT_LE(close.pairs, 3000);
    const double one = variance_of(law_of({.rician_k = 4}), 1);
    EXPECT_NEAR(close.variance, one, 3 * close.standard_error) << distance;
    EXPECT_LT(close.standard_error, 0.12 * one);
  }
  const Walk far = drawn({.rician_k = 4}, 150);  // all as far apart
  EXPECT_TRUE(std::isinf(KrigedReadings(far.readings, far.residual).close_readings().standard_error));
}

// The variogram of a smooth field begins as a parabola: a line would underestimate the variance.
TEST(FadingTests, CloseReadingsGiveTheVarianceInASmoothField) {
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
TEST(FadingTests, CloseReadingsPreventAnotherLaw) {
  Walk walk = drawn({.rician_k = 6}, 6000);
  for (Eigen::Index i = 0; i < walk.residual.size(); ++i) {
    const Eigen::Index first = i - i % 2;
    walk.readings.rx_at(0, i) =
        walk.readings.rx_at(0, first) + (i % 2 ? 0.005 * static_cast<double>(first / 2 % 5) : 0);
    walk.residual[i] += std::round(3 * Stream(key_of("places")).normal(static_cast<uint64_t>(first)));
  }
  KrigedReadings field(walk.readings, walk.residual);
  for (const LawTest& test : law_tests(field, 1, shipped_laws, law_of({.rician_k = 6}), near_the_truth).tests) {
    if (test.cause == "effect.outliers") continue;
    EXPECT_EQ(test.gain, 0) << test.cause;
  }
}

// Readings a fiftieth of the decorrelation distance apart, with deep fades: with winsorised predictions alone, a
// weaker fading law would gain 24.
TEST(FadingTests, NoFalseAlarmForClippedDeepFades) {
  const Walk walk = drawn_of_four({.rician_k = 5}, 1500, 30, 30);
  KrigedReadings field(walk.readings, walk.residual);
  const noise::Covariance dense{noise::Family::exponential,
                                {2.2, std::log(30), std::log(base_variance(law_of({.rician_k = 5}))), 0}};
  for (const LawTest& test : law_tests(field, 1, shipped_laws, law_of({.rician_k = 5}), dense).tests)
    EXPECT_LT(test.gain, 9) << test.cause;
}

TEST(FadingTests, MeasuresAnotherFading) {
  const LawTest best = tested({.rician_k = 2}, {.rician_k = 8}).front();
  EXPECT_EQ(best.cause, "effect.fading_law");
  EXPECT_GT(best.evidence, 20);
  EXPECT_LT(best.values[0].lower95, 2);
  EXPECT_GT(best.values[0].upper95, 2);
}

// In the field fitted to the stated law, the estimate was biased by a quarter towards the stated strength.
TEST(FadingTests, EstimateIsIndependentOfTheStatedLaw) {
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

TEST(FadingTests, MeasuresTheShareOfOutliers) {
  const LawTest best = tested({.rician_k = 8, .outliers = 0.03}, {.rician_k = 8}).front();
  EXPECT_EQ(best.cause, "effect.outliers");
  EXPECT_NEAR(best.values[0].value, 0.03, 0.012);
}

// Normal noise of 1.5 dB in a world that states no law of readings.
// Deep fades set adjacent readings as far apart as outliers do, but on one side only.
TEST(FadingTests, OutliersAreFoundUnderRayleighFading) {
  const LawTest test = tested({.rician_k = -40, .outliers = 0.04}, {.rician_k = -40}).front();
  EXPECT_EQ(test.cause, "effect.outliers");
  EXPECT_LT(test.log_p, std::log(1e-6));
  ASSERT_FALSE(test.values.empty());
  EXPECT_NEAR(test.values[0].value, 0.04, 0.02);
}

// The difference of two Rayleigh powers in dB is logistic: beyond d with probability 2 / (1 + 10^(d / 10)).
TEST(ReadingsApart, AreLogisticUnderRayleighFading) {
  const ReadingsApart apart(law_of({.rician_k = -40}), 0, {});
  for (const double db : {3.0, 10.0, 25.0}) EXPECT_NEAR(apart.beyond(db), 2 / (1 + std::pow(10, db / 10)), 0.003) << db;
}

// A field between the two makes half of them differ by as much as half of those seen do.
TEST(ReadingsApart, HaveTheFieldOfThoseSeen) {
  const Eigen::VectorXd seen = Eigen::VectorXd::LinSpaced(400, 0, 24);
  ReadingDistribution law = law_of({.rician_k = 60});
  law.noise = 2;
  const ReadingsApart apart(law, 1, seen);
  EXPECT_NEAR(apart.beyond(12), 0.5, 0.02);
  EXPECT_NEAR(apart.beyond(12 * 1.96 / 0.6745), 0.05, 0.01);  // normal
}

TEST(FadingTests, OutliersAreFoundWhereNoLawIsStated) {
  const auto tested_without_law = [](double outliers) {
    const Walk walk = drawn({.rician_k = 60, .outliers = outliers, .noise = 1.5}, 2000);
    KrigedReadings field(walk.readings, walk.residual);
    return law_tests(field, 1, shipped_laws, {}, near_the_truth).tests;
  };
  for (const LawTest& test : tested_without_law(0)) EXPECT_GT(test.log_p, std::log(0.001)) << test.cause;
  const LawTest best = tested_without_law(0.03).front();
  EXPECT_EQ(best.cause, "effect.outliers");
  EXPECT_LT(best.log_p, std::log(1e-12));
  ASSERT_FALSE(best.values.empty());
  EXPECT_NEAR(best.values[0].value, 0.03, 0.012);
}

// Fading that no plugin states is no outliers.
TEST(FadingTests, FadingThatNobodyStatesIsNoOutliers) {
  for (const double rician_k : {-40.0, 3.0, 8.0}) {
    const Walk walk = drawn({.rician_k = rician_k}, 2000);
    KrigedReadings field(walk.readings, walk.residual);
    for (const LawTest& test : law_tests(field, 1, shipped_laws, {}, near_the_truth).tests) {
      if (test.cause == "effect.fading_law") continue;
      EXPECT_GT(test.log_p, std::log(1e-4)) << test.cause << " K " << rician_k;
    }
  }
}

// Two readings on the wrong side of a wall's end are no outliers of the receiver, however far off. Where there is no
// wall they are; a single one is not.
TEST(FadingTests, AFewReadingsMakeNoLawBesideWalls) {
  Walk walk = drawn({.rician_k = 6}, 2000);
  const auto most_likely = [&](bool beside_walls) {
    KrigedReadings field(walk.readings, walk.residual);
    const std::vector<bool> unsure(2000, beside_walls);
    return law_tests(field, 1, shipped_laws, law_of({.rician_k = 6}), near_the_truth, unsure).tests.front();
  };
  walk.residual[300] += 25;
  EXPECT_GT(most_likely(false).log_p, std::log(1e-3));
  walk.residual[1200] += 20;
  EXPECT_GT(most_likely(true).log_p, std::log(1e-3));
  EXPECT_EQ(most_likely(false).cause, "effect.outliers");
  EXPECT_LT(most_likely(false).log_p, std::log(5e-4));
}

// Three readings at each place, of 1.2 dB, and a fade of Rayleigh's law that is fixed there.
Walk of_fixed_fades(double outliers) {
  constexpr int places = 600;
  const Walk field = drawn({.rician_k = 60}, places), fades = drawn({.rician_k = -40}, places, 1e-6),
             levels = drawn({.rician_k = 60}, places, 1e-6);
  Walk result;
  std::vector<Eigen::Index> at;
  for (Eigen::Index i = 0; i < 3 * places; ++i) at.push_back(i / 3);
  result.readings.tx_at = field.readings.tx_at(Eigen::all, at);
  result.readings.rx_at = field.readings.rx_at(Eigen::all, at);
  const Stream random(key_of("readings of places"));
  for (const Eigen::Index k : at) {
    const auto i = static_cast<uint64_t>(result.readings.tx.size());
    result.readings.t.push_back(0.4 * static_cast<double>(i));
    result.readings.tx.push_back(0);
    result.readings.rx.push_back(9);
    const double far = random.uniform(i, 1) < outliers ? 40 * random.uniform(i, 2) - 20 : 0;
    result.residual.conservativeResize(static_cast<Eigen::Index>(i) + 1);
    result.residual[static_cast<Eigen::Index>(i)] =
        std::round(field.residual[k] + fades.residual[k] - levels.residual[k] + 1.2 * random.normal(i, 0) + far);
  }
  return result;
}

// What is fixed at a place has a law of its own: only what readings of it differ by is judged.
TEST(FadingTests, JudgesReadingsOfAPlaceByWhatTheyDifferBy) {
  const noise::Covariance near{noise::with_fixed(noise::Family::exponential, 3, 0), {3.5, 0.4, 0.4, 0}};
  const auto tests_of = [&](double outliers) {
    const Walk walk = of_fixed_fades(outliers);
    KrigedReadings field(walk.readings, walk.residual, nullptr, near.family);
    EXPECT_EQ(field.judged().size(), 1200u);
    EXPECT_EQ(field.families().size(), 3u);
    return law_tests(field, 1, shipped_laws, {}, near).tests;
  };
  for (const LawTest& test : tests_of(0)) EXPECT_GT(test.log_p, std::log(0.001)) << test.cause;
  const LawTest best = tests_of(0.03).front();
  EXPECT_EQ(best.cause, "effect.outliers");
  EXPECT_LT(best.log_p, std::log(1e-12));
  ASSERT_FALSE(best.values.empty());
  EXPECT_NEAR(best.values[0].value, 0.03, 0.015);
}

TEST(FadingTests, DistinguishesChannelHoppingFromFading) {
  const LawTest best = tested({.rician_k = 12, .channel_sd = 4}, {.rician_k = 12}).front();
  EXPECT_EQ(best.cause, "effect.channel_mixture");
  EXPECT_NEAR(best.values[0].value, 4, 0.6);
}

}  // namespace
}  // namespace muster::diagnosis
