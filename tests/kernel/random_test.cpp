// Random numbers: the generator's published vectors, and the distributions of draws.
#include <gtest/gtest.h>

#include <cmath>
#include <muster/random.hpp>
#include <set>
#include <vector>

namespace muster {
namespace {

using Words = std::array<uint32_t, 4>;

// The lines "philox4x32 10" of kat_vectors in Random123 (D. E. Shaw Research).
TEST(Random, PhiloxGivesItsPublishedVectors) {
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr uint32_t all = 0xffffffff;
  EXPECT_EQ(philox({all, all, all, all}, {all, all}), (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

struct Moments {
  double mean = 0, variance = 0, skew = 0, kurtosis = 0;
};
Moments moments(const std::vector<double>& x) {
  Moments m;
  const auto n = static_cast<double>(x.size());
  for (const double v : x) m.mean += v / n;
  for (const double v : x) {
    const double d = v - m.mean;
    m.variance += d * d / n, m.skew += d * d * d / n, m.kurtosis += d * d * d * d / n;
  }
  return m;
}

constexpr int draws = 200000;
const double sigma = 1 / std::sqrt(static_cast<double>(draws));  // of a mean of draws of variance 1
constexpr double limit = 4.5;                                    // standard errors: 7e-6 of chance each

TEST(Random, UniformDrawsAreUniform) {
  const Stream stream(key_of("uniform"));
  std::vector<double> x;
  std::vector<int> bins(100, 0);
  for (int i = 0; i < draws; ++i) x.push_back(stream.uniform(static_cast<uint64_t>(i)));
  for (const double v : x) {
    ASSERT_GT(v, 0);
    ASSERT_LT(v, 1);
    ++bins[static_cast<std::size_t>(v * 100)];
  }
  const Moments m = moments(x);
  EXPECT_NEAR(m.mean, 0.5, limit * sigma * std::sqrt(1.0 / 12));
  EXPECT_NEAR(m.variance, 1.0 / 12, limit * sigma * std::sqrt(1.0 / 180));
  double chi = 0;
  for (const int n : bins) chi += (n - draws / 100.0) * (n - draws / 100.0) / (draws / 100.0);
  EXPECT_NEAR(chi, 99, limit * std::sqrt(2 * 99.0));
}

TEST(Random, NormalDrawsAreNormal) {
  const Stream stream(key_of("normal"));
  std::vector<double> x;
  int beyond = 0;
  for (int i = 0; i < draws; ++i) x.push_back(stream.normal(7, static_cast<uint64_t>(i)));
  for (const double v : x) beyond += std::abs(v) > 1.959963984540054;
  const Moments m = moments(x);
  EXPECT_NEAR(m.mean, 0, limit * sigma);
  EXPECT_NEAR(m.variance, 1, limit * sigma * std::sqrt(2.0));
  EXPECT_NEAR(m.skew, 0, limit * sigma * std::sqrt(15.0));
  EXPECT_NEAR(m.kurtosis, 3, limit * sigma * std::sqrt(96.0));
  EXPECT_NEAR(beyond, 0.05 * draws, limit * std::sqrt(0.05 * 0.95 * draws));
}

TEST(Random, ExponentialDrawsAreExponential) {
  const Stream stream(key_of("exponential"));
  std::vector<double> x;
  for (int i = 0; i < draws; ++i) x.push_back(stream.exponential(static_cast<uint64_t>(i)));
  EXPECT_NEAR(moments(x).mean, 1, limit * sigma);
  EXPECT_NEAR(moments(x).variance, 1, limit * sigma * std::sqrt(8.0));
}

// Neighbours in either index, in key and in stream are independent.
TEST(Random, NeighboursAreIndependent) {
  const Stream stream(key_of("neighbours"));
  const auto correlation = [&](auto&& other) {
    double sum = 0;
    for (uint64_t i = 0; i < draws; ++i) sum += stream.normal(i) * other(i) / draws;
    return sum;
  };
  EXPECT_NEAR(correlation([&](uint64_t i) { return stream.normal(i + 1); }), 0, limit * sigma);
  EXPECT_NEAR(correlation([&](uint64_t i) { return stream.normal(i, 1); }), 0, limit * sigma);
  EXPECT_NEAR(correlation([&](uint64_t i) { return stream.of(1).normal(i); }), 0, limit * sigma);
  EXPECT_NEAR(correlation([&](uint64_t i) { return Stream(key_of("neighbourt")).normal(i); }), 0, limit * sigma);
  EXPECT_NEAR(correlation([&](uint64_t i) { return stream.of(i).normal(0); }), 0, limit * sigma);
}

TEST(Random, KeysDiffer) {
  std::set<uint64_t> keys;
  for (int i = 0; i < 20000; ++i) keys.insert(key_of("robot" + std::to_string(i)));
  EXPECT_EQ(keys.size(), 20000u);
  EXPECT_NE(combined(1, 2), combined(2, 1));
  EXPECT_NE(Stream(1).of(2).uniform(0), Stream(2).of(1).uniform(0));
}

}  // namespace
}  // namespace muster
