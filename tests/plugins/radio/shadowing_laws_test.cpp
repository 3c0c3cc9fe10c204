// Shadowing as a field: symmetric, without memory, with the variance and the correlations of line integrals.
#include <gtest/gtest.h>

#include <vector>

#include "radio_fading/line_integral.hpp"
#include "radio_fading/shadow_field.hpp"
#include "statistics.hpp"

namespace muster {
namespace {

struct Segment {
  FieldPoint p, q;
};

double shadow(const ShadowField& field, const Segment& s) { return field.between(s.p, s.q); }

Segment random_segment(const Stream& random, uint64_t i) {
  const auto at = [&](uint64_t j) { return 40 * random.uniform(i, j) - 20; };
  return {{at(0), at(1), at(2) / 10}, {at(3), at(4), at(5) / 10}};
}

// Agrawal and Patwari's double integral for a field of correlation exp(-r), by the midpoint rule.
double covariance(const Segment& a, const Segment& b) {
  constexpr int steps = 600;
  const auto length = [](const Segment& s) { return std::hypot(s.q.x - s.p.x, s.q.y - s.p.y, s.q.z - s.p.z); };
  const auto on = [](const Segment& s, int i) {
    const double f = (i + 0.5) / steps;
    return FieldPoint{s.p.x + f * (s.q.x - s.p.x), s.p.y + f * (s.q.y - s.p.y), s.p.z + f * (s.q.z - s.p.z)};
  };
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const FieldPoint u = on(a, i), v = on(b, j);
      sum += std::exp(-std::hypot(u.x - v.x, u.y - v.y, u.z - v.z));
    }
  }
  return sum / (steps * steps) * std::sqrt(length(a) * length(b)) / 2;
}

// What radio.fading states of its draws: any pair of links, some of which share an end or hardly differ.
TEST(Shadowing, TheStatedCovarianceIsTheDoubleIntegral) {
  const Stream random(3);
  for (uint64_t i = 0; i < 40; ++i) {
    Segment a = random_segment(random, i), b = random_segment(random, i + 100);
    for (FieldPoint* p : {&a.p, &a.q, &b.p, &b.q}) p->x /= 4, p->y /= 4;
    if (i % 2) b.p = a.p;
    if (i % 4 == 3) b.q = {a.q.x + 0.1, a.q.y, a.q.z};
    constexpr double decorrelation = 1.7;
    std::vector<double> ends;
    for (const FieldPoint& p : {a.p, a.q, b.q, b.p}) {  // one of them the other way round
      for (const double x : {p.x, p.y, p.z}) ends.push_back(decorrelation * x);
    }
    const uint32_t one = 0, other = 1;
    double found = 0;
    covariance_of_line_integrals(decorrelation, ends.data(), &one, &other, 1, &found);
    EXPECT_NEAR(found, covariance(a, b), 1e-3) << i;
    covariance_of_line_integrals(decorrelation, ends.data(), &one, &one, 1, &found);
    const double length = std::hypot(a.q.x - a.p.x, a.q.y - a.p.y, a.q.z - a.p.z);
    EXPECT_NEAR(found, ShadowField::variance(length), 1e-12);
  }
}

constexpr int fields = 8000;
constexpr double sure = 4.5;  // standard errors

// Over independent fields, which are seeds.
double ensemble_covariance(const Segment& a, const Segment& b) {
  static const std::vector<ShadowField> ensemble = [] {
    std::vector<ShadowField> made;
    for (uint64_t seed = 0; seed < fields; ++seed) made.emplace_back(Stream(mixed(seed)));
    return made;
  }();
  double sum = 0;
  for (const ShadowField& field : ensemble) sum += shadow(field, a) * shadow(field, b) / fields;
  return sum;
}

TEST(Shadowing, IsTheSameBothWaysBitForBit) {
  const ShadowField field(Stream(7));
  const Stream random(1);
  for (uint64_t i = 0; i < 2000; ++i) {
    const Segment s = random_segment(random, i);
    EXPECT_EQ(shadow(field, s), shadow(field, {s.q, s.p}));
  }
}

TEST(Shadowing, IsTheSameOnReturn) {
  const Stream random(2);
  const ShadowField field(Stream(7));
  const Segment first = random_segment(random, 0);
  const double before = shadow(field, first);
  for (uint64_t i = 1; i < 50; ++i) shadow(field, random_segment(random, i));
  EXPECT_EQ(shadow(field, first), before);
  EXPECT_EQ(shadow(ShadowField(Stream(7)), first), before);
  EXPECT_NE(shadow(ShadowField(Stream(8)), first), before);
}

TEST(Shadowing, HasMeanZero) {
  std::vector<double> samples;
  for (uint64_t seed = 0; seed < 4000; ++seed) {
    samples.push_back(shadow(ShadowField(Stream(mixed(seed))), {{1, 2, 0.5}, {9, -3, 1}}));
  }
  const Moments found = moments(samples);
  EXPECT_NEAR(found.mean, 0, sure * found.mean_error);
}

TEST(Shadowing, VarianceGrowsWithLengthAsTheLineIntegralSays) {
  for (const double length : {0.1, 1.0, 3.0, 8.0, 30.0}) {
    const Segment level{{3, 1, 0.3}, {3 + 0.6 * length, 1 + 0.8 * length, 0.3}};
    const double expected = 1 - (1 - std::exp(-length)) / length;
    EXPECT_NEAR(ShadowField::variance(length), expected, 1e-12);
    EXPECT_NEAR(ensemble_covariance(level, level), expected, sure * expected * std::sqrt(2.0 / fields));
  }
}

TEST(Shadowing, TreatsUpLikeAnyDirection) {
  const Segment upright{{3, 1, 0}, {3, 1, 8}};
  const double expected = ShadowField::variance(8);
  EXPECT_NEAR(ensemble_covariance(upright, upright), expected, sure * expected * std::sqrt(2.0 / fields));
}

TEST(Shadowing, LinksAreCorrelatedAsTheirLineIntegralsAre) {
  const Segment link{{0, 0, 0}, {8, 0, 0}};
  const std::vector<Segment> others{
      {{0, 0.5, 0}, {8, 0.5, 0}},
      {{0, 2, 0}, {8, 2, 0}},  // beside it
      {{0, 0, 1}, {8, 0, 1}},  // above it
      {{0, 0, 0}, {8 * std::cos(0.2), 8 * std::sin(0.2), 0}},
      {{0, 0, 0}, {0, 8, 0}},      // from the same end
      {{4, -4, 0}, {4, 4, 0}},     // across it
      {{30, 30, 0}, {38, 30, 0}},  // far from it
  };
  for (const Segment& other : others) {
    const double expected = covariance(link, other), variance = ShadowField::variance(8);
    const double error = std::sqrt((variance * variance + expected * expected) / fields);
    EXPECT_NEAR(ensemble_covariance(link, other), expected, sure * error);
  }
}

TEST(Shadowing, IsSmoothWhereAWaveRunsAcrossTheLink) {
  // About a fixed middle, a short link's value over the root of its length changes with the square of length times wave
  // number only: by 1e-7 between links so short that every wave is in the series, and links of which some are.
  const ShadowField field(Stream(3));
  const auto density = [&](double length) {
    return shadow(field, {{1 - length / 2, 1, 0}, {1 + length / 2, 1, 0}}) / std::sqrt(length);
  };
  for (const double length : {1e-6, 4e-6, 1e-5, 2e-5}) EXPECT_NEAR(density(length), density(1e-7), 1e-5) << length;
  EXPECT_EQ(shadow(field, {{1, 1, 0}, {1, 1, 0}}), 0);
}

}  // namespace
}  // namespace muster
