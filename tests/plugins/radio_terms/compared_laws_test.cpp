// Channels of other simulators, against their formulas, and their errors compared with a field that fills the
// environment.
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "radio_fading/pair_process.hpp"
#include "radio_fading/per_end_field.hpp"
#include "radio_fading/rician.hpp"
#include "radio_fading/shadow_field.hpp"
#include "tests/plugins/radio/statistics.hpp"

namespace muster {
namespace {

constexpr double turn = 6.283185307179586;
constexpr int seeds = 8000;
constexpr double sure = 4.5;  // standard errors

struct Point {
  double x, y, z;
};
struct Link {
  Point p, q;
};

double normal_share(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

double of_link(const PerEndField& field, const Link& link) {
  return field.between(field.end_at(link.p.x, link.p.y, link.p.z), field.end_at(link.q.x, link.q.y, link.q.z));
}

double of_link(const ShadowField& field, const Link& link) {
  return field.between({link.p.x, link.p.y, link.p.z}, {link.q.x, link.q.y, link.q.z});
}

// A link's value in each of many independent fields.
template <class Field>
std::vector<double> in_fields(const Link& link) {
  static const std::vector<Field> fields = [] {
    std::vector<Field> made;
    for (uint64_t seed = 0; seed < seeds; ++seed) made.emplace_back(Stream(mixed(seed)));
    return made;
  }();
  std::vector<double> result;
  for (const Field& field : fields) result.push_back(of_link(field, link));
  return result;
}

double covariance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i] / static_cast<double>(a.size());
  return sum;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  return covariance(a, b) / std::sqrt(covariance(a, a) * covariance(b, b));
}

TEST(Gudmundson, IsNormalOfVarianceOneAtAnyLength) {
  for (const double length : {0.0, 0.3, 2.0, 40.0}) {
    const auto samples = in_fields<PerEndField>({{3, 1, 0.5}, {3 + 0.6 * length, 1 + 0.8 * length, 0.5}});
    EXPECT_LT(kolmogorov(samples, normal_share), 1.95) << length;
    EXPECT_NEAR(covariance(samples, samples), 1, sure * std::sqrt(2.0 / seeds)) << length;
  }
}

TEST(Gudmundson, DecorrelatesExponentiallyWithTheWayOfEachEnd) {
  const Link link{{0, 0, 0}, {8, 0, 0}};
  const std::vector<std::pair<Link, double>> others{
      {{{0.5, 0, 0}, {8, 0, 0}}, std::exp(-0.5)},      {{{0, 0, 0}, {8, 0.6, 0.8}}, std::exp(-1)},
      {{{0.3, 0.4, 0}, {8, -0.7, 0}}, std::exp(-1.2)}, {{{-1, 2, 2}, {8, 0, 0}}, std::exp(-3)},
      {{{8, 0, 0}, {0, 0, 0.7}}, std::exp(-0.7)},  // the ends exchanged
  };
  const auto here = in_fields<PerEndField>(link);
  for (const auto& [other, expected] : others) {
    const double error = std::sqrt((1 + expected * expected) / seeds);
    EXPECT_NEAR(covariance(here, in_fields<PerEndField>(other)), expected, sure * error) << expected;
  }
}

TEST(Gudmundson, IsCorrelatedAsTheClosedFormWhereEndsAreNear) {
  const PerEndField field(Stream(1));
  const auto at = [&](const Point& p) { return field.end_at(p.x, p.y, p.z); };
  const std::vector<std::pair<Link, Link>> cases{{{{0, 0, 0}, {0.5, 0, 0}}, {{0.2, 0, 0}, {1, 0.3, 0}}},
                                                 {{{0, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {2, 0, 0}}},
                                                 {{{0, 0, 0}, {0, 0, 0}}, {{0, 0.4, 0}, {0, 0, 0.3}}}};
  for (const auto& [a, b] : cases) {
    const double expected = PerEndField::correlation(at(a.p), at(a.q), at(b.p), at(b.q));
    const double error = std::sqrt((1 + expected * expected) / seeds);
    EXPECT_NEAR(covariance(in_fields<PerEndField>(a), in_fields<PerEndField>(b)), expected, sure * error);
  }
}

TEST(Gudmundson, IsTheSameBothWaysAndOnReturnBitForBit) {
  const PerEndField field(Stream(7)), again(Stream(7));
  const Stream random(1);
  for (uint64_t i = 0; i < 1000; ++i) {
    const auto at = [&](uint64_t j) { return 40 * random.uniform(i, j); };
    const auto p = field.end_at(at(0), at(1), at(2)), q = field.end_at(at(3), at(4), at(5));
    EXPECT_EQ(field.between(p, q), field.between(q, p));
    EXPECT_EQ(field.between(p, q), again.between(again.end_at(at(0), at(1), at(2)), again.end_at(at(3), at(4), at(5))));
  }
}

// A pair of which one radio moves `step` metres each time, here and there by `way`, and the other by `other`.
std::vector<PairProcess> walk(uint64_t seed, int steps, const std::function<double(int)>& x, double other = 0) {
  std::vector<PairProcess> result;
  PairProcess pair{0, 1, {}, {}, 0, 0, 0, 0};
  for (int i = 0; i <= steps; ++i) {
    pair.follow({x(i), 0, 0, 1, 0, 0, 0}, {20, other * i, 0, 1, 0, 0, 0}, 2, 0.125, Stream(mixed(seed)));
    result.push_back(pair);
  }
  return result;
}

TEST(Ar1, LawsAreNormalAndExponential) {
  std::vector<double> shadow, power;
  for (uint64_t seed = 0; seed < seeds; ++seed) {
    const PairProcess last = walk(seed, 9, [](int i) { return 0.03 * i; }).back();
    shadow.push_back(last.shadow);
    power.push_back(std::norm(last.diffuse()));
  }
  EXPECT_LT(kolmogorov(shadow, normal_share), 1.95);
  EXPECT_LT(kolmogorov(power, [](double x) { return -std::expm1(-x); }), 1.95);
}

// The share below x of Rician power of mean one, by the trapezoid rule over its density.
double rician_share(double k, double x) {
  constexpr int steps = 400;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double at = x * i / steps;
    const double density =
        (k + 1) * std::exp(-k - (k + 1) * at) * std::cyl_bessel_i(0, 2 * std::sqrt(k * (k + 1) * at));
    sum += (i == 0 || i == steps ? 0.5 : 1) * density * x / steps;
  }
  return sum;
}

TEST(Ar1, LawIsRicesUnderASteadyWave) {
  const double k = rician_ratio(4);
  std::vector<double> power;
  for (uint64_t seed = 0; seed < 2000; ++seed) {
    const PairProcess last = walk(seed, 5, [](int i) { return 0.03 * i; }).back();
    power.push_back(rician_gain(k, last.diffuse(), 0.1 * static_cast<double>(seed)));
  }
  EXPECT_LT(kolmogorov(power, [&](double x) { return rician_share(k, x); }), 1.95);
}

TEST(Ar1, CorrelationIsAPowerOfThatOfAStep) {
  constexpr double step = 0.02, other = 0.01, wavelength = 0.125, unit = 2;
  const double of_fading =
      std::cyl_bessel_j(0, turn * step / wavelength) * std::cyl_bessel_j(0, turn * other / wavelength);
  const double of_shadowing = std::exp(-(step + other) / unit);
  std::vector<std::vector<PairProcess>> walks;
  for (uint64_t seed = 0; seed < seeds; ++seed)
    walks.push_back(walk(
        seed, 8, [](int i) { return step * i; }, other));
  for (const std::size_t lag : {1u, 2u, 3u, 5u, 8u}) {
    double fading = 0, shadowing = 0;
    for (const auto& w : walks) {
      fading += (w[0].diffuse() * std::conj(w[lag].diffuse())).real() / seeds;
      shadowing += w[0].shadow * w[lag].shadow / seeds;
    }
    const double power = static_cast<double>(lag);
    EXPECT_NEAR(fading, std::pow(of_fading, power), sure / std::sqrt(seeds)) << lag;
    EXPECT_NEAR(shadowing, std::pow(of_shadowing, power), sure * std::sqrt(2.0 / seeds)) << lag;
  }
}

TEST(Ar1, HardlyChangesOverAHairsBreadth) {
  for (const double step : {1e-15, 1e-12, 1e-9, 1e-7}) {
    const auto way = walk(5, 20, [&](int i) { return step * i; });
    EXPECT_NEAR(way.front().shadow, way.back().shadow, 1e-2) << step;
    EXPECT_NEAR(std::abs(way.front().diffuse() - way.back().diffuse()), 0, 1e-3) << step;
  }
}

TEST(Ar1, StandsStillWithItsRadios) {
  const auto stood = walk(3, 6, [](int i) { return i < 3 ? 0.1 * i : 0.2; });
  EXPECT_NE(stood[1].shadow, stood[2].shadow);
  EXPECT_EQ(stood[2].shadow, stood[6].shadow);
  EXPECT_EQ(stood[2].diffuse(), stood[6].diffuse());
  EXPECT_EQ(stood[6].moves, 3);
}

// Measurements are recorded in the test's report too, in the order of docs/explanation/radio.md.
void report(const std::string& what, double value) { testing::Test::RecordProperty(what, std::to_string(value)); }

// Out by a decorrelation distance and back: correlation of the shadowing.
TEST(WhatOthersGetWrong, APathForgetsThePlace) {
  std::vector<double> before, after;
  for (uint64_t seed = 0; seed < seeds; ++seed) {
    const auto way = walk(seed, 20, [](int i) { return 0.2 * std::min(i, 20 - i); });
    before.push_back(way.front().shadow), after.push_back(way.back().shadow);
  }
  report("ar1", correlation(before, after));
  EXPECT_NEAR(correlation(before, after), std::exp(-2), sure / std::sqrt(seeds));
}

// Two links that cross in their middles at right angles, each four decorrelation distances long.
TEST(WhatOthersGetWrong, EndsDoNotKnowWhatLiesBetween) {
  const Link one{{-2, 0, 0}, {2, 0, 0}}, across{{0, -2, 0}, {0, 2, 0}};
  const double ours = correlation(in_fields<ShadowField>(one), in_fields<ShadowField>(across));
  const double others = correlation(in_fields<PerEndField>(one), in_fields<PerEndField>(across));
  report("field", ours), report("gudmundson", others);
  EXPECT_GT(ours, 0.33);
  EXPECT_NEAR(others, 2 * std::exp(-2 * std::sqrt(8.0)), sure / std::sqrt(seeds));
  EXPECT_LT(others, 0.07);
}

// Radios a tenth of a decorrelation distance apart.
TEST(WhatOthersGetWrong, RadiosSideBySideAreShadowed) {
  const Link close{{0, 0, 0}, {0.1, 0, 0}};
  const auto ours = in_fields<ShadowField>(close), others = in_fields<PerEndField>(close);
  report("field", std::sqrt(covariance(ours, ours))), report("gudmundson", std::sqrt(covariance(others, others)));
  EXPECT_NEAR(std::sqrt(covariance(ours, ours)), std::sqrt(1 - (1 - std::exp(-0.1)) / 0.1), 0.01);
  EXPECT_NEAR(std::sqrt(covariance(others, others)), 1, 0.04);
}

// Correlation of a gain where J0 has its first zero, 0.383 wavelengths on, reached in one step or in ten.
TEST(WhatOthersGetWrong, FadingThatStepsFinerForgetsLess) {
  constexpr double zero = 2.404825557695773 / turn * 0.125;
  for (const int steps : {1, 10}) {
    std::complex<double> left = 0;
    for (uint64_t seed = 0; seed < seeds; ++seed) {
      const auto way = walk(seed, steps, [&](int i) { return zero * i / steps; });
      left += way.front().diffuse() * std::conj(way.back().diffuse()) / static_cast<double>(seeds);
    }
    const double expected = steps == 1 ? 0 : std::pow(std::cyl_bessel_j(0, 0.2404825557695773), 10);
    report("steps_" + std::to_string(steps), left.real());
    EXPECT_NEAR(left.real(), expected, sure / std::sqrt(seeds)) << steps;
  }
}

}  // namespace
}  // namespace muster
