// Small-scale fading: its law at a random place, its correlation along a path, its expectations in dB.
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "radio_fading/multipath.hpp"
#include "radio_fading/reading_key.hpp"
#include "radio_fading/rician.hpp"
#include "statistics.hpp"

namespace muster {
namespace {

constexpr std::size_t samples = 160000;
constexpr double sure = 4;                 // standard errors
constexpr double euler_db = 2.5068;        // 10 log10(e) times Euler's constant
constexpr double rayleigh_sd_db = 5.5700;  // 10 log10(e) pi / sqrt 6

// Complex gains between places drawn at random in a square of 500 wavelengths, one field each `per_field` samples.
std::vector<std::complex<double>> gains_by_place(std::size_t count, std::size_t per_field) {
  std::vector<std::complex<double>> result;
  const Stream random(11);
  for (std::size_t i = 0; result.size() < count; ++i) {
    const Multipath field(Stream(mixed(i)));
    for (std::size_t j = 0; j < per_field; ++j) {
      const auto at = [&](uint64_t k) { return 500 * random.uniform(i * per_field + j, k); };
      result.push_back(field.between({at(0), at(1), 1}, {at(2), at(3), 2}));
    }
  }
  return result;
}

std::vector<std::complex<double>> gains_by_reading(std::size_t count) {
  std::vector<std::complex<double>> result;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = 0.1 * static_cast<double>(i);
    result.push_back(diffuse(Stream(5), end_key(1, t, {}), end_key(2, t, {})));
  }
  return result;
}

std::vector<double> powers(const std::vector<std::complex<double>>& gains, double k) {
  std::vector<double> result;
  for (std::size_t i = 0; i < gains.size(); ++i) result.push_back(rician_gain(k, gains[i], static_cast<double>(i)));
  return result;
}

std::vector<double> in_db(std::vector<double> gains) {
  for (double& gain : gains) gain = to_db(gain);
  return gains;
}

class FadingLaw : public testing::TestWithParam<bool> {
 protected:
  static const std::vector<std::complex<double>>& gains(bool by_place) {
    static const auto places = gains_by_place(samples, 1000);
    static const auto readings = gains_by_reading(samples);
    return by_place ? places : readings;
  }
};
INSTANTIATE_TEST_SUITE_P(Each, FadingLaw, testing::Bool(),
                         [](const auto& each) { return each.param ? "ByPlace" : "ByReading"; });

TEST_P(FadingLaw, MeanGainIsOne) {
  for (const double k : {0.0, 0.5, 4.0}) {
    const Moments found = moments(powers(gains(GetParam()), k));
    EXPECT_NEAR(found.mean, 1, sure * found.mean_error);
  }
}

TEST_P(FadingLaw, RayleighPowerIsExponential) {
  EXPECT_LT(kolmogorov(powers(gains(GetParam()), 0), [](double x) { return -std::expm1(-x); }), 1.95);
}

TEST_P(FadingLaw, RayleighLiesTwoAndAHalfDecibelsLowInDecibels) {
  const Moments found = moments(in_db(powers(gains(GetParam()), 0)));
  EXPECT_NEAR(found.mean, -euler_db, sure * found.mean_error);
  // The logarithm's kurtosis is 5.4, so the standard error of its sd is sd sqrt(4.4 / (4 N)).
  EXPECT_NEAR(std::sqrt(found.variance), rayleigh_sd_db, sure * rayleigh_sd_db * std::sqrt(4.4 / 4 / samples));
}

TEST_P(FadingLaw, RicianMeanOfDecibelsIsTheClosedForm) {
  for (const double k_db : {-6.0, 0.0, 6.0, 12.0}) {
    const double k = rician_ratio(k_db);
    const Moments found = moments(in_db(powers(gains(GetParam()), k)));
    EXPECT_NEAR(found.mean, to_db(rician_typical_gain(k)), sure * found.mean_error);
  }
}

// E[ln gain] under the density of Rician power, over y = ln gain by the trapezoid rule.
double mean_log_by_quadrature(double k) {
  double sum = 0;
  constexpr double step = 1e-3;
  for (double y = -40; y < 4; y += step) {
    const double x = std::exp(y);
    sum += step * y * x * (k + 1) * std::exp(-k - (k + 1) * x) * std::cyl_bessel_i(0, 2 * std::sqrt(k * (k + 1) * x));
  }
  return sum;
}

TEST(Rician, ClosedFormOfTheMeanLogarithmMatchesQuadrature) {
  for (const double k_db : {-39.0, -20.0, -10.0, -3.0, 0.0, 3.0, 6.0, 10.0, 13.0}) {
    const double k = rician_ratio(k_db);
    EXPECT_NEAR(std::log(rician_typical_gain(k)), mean_log_by_quadrature(k), 1e-7) << k_db << " dB";
  }
}

TEST(Rician, FortyDecibelsDownIsRayleighExactly) {
  EXPECT_EQ(rician_ratio(-40), 0);
  EXPECT_NEAR(to_db(rician_typical_gain(0)), -euler_db, 1e-4);
  EXPECT_EQ(rician_gain(0, {0.6, 0.8}, 1.0), 0.6 * 0.6 + 0.8 * 0.8);
  EXPECT_NEAR(rician_typical_gain(rician_ratio(60)), 1, 2e-6);
}

TEST(Multipath, IsTheSameBothWaysBitForBit) {
  const Multipath field(Stream(7));
  const Stream random(1);
  for (uint64_t i = 0; i < 2000; ++i) {
    const auto at = [&](uint64_t j) { return 900 * random.uniform(i, j); };
    const FieldPoint p{at(0), at(1), at(2)}, q{at(3), at(4), at(5)};
    EXPECT_EQ(field.between(p, q), field.between(q, p));
  }
}

TEST(Multipath, IsTheSameOnReturn) {
  const auto there = [](const Multipath& field) { return field.between({1, 2, 3}, {40, 50, 6}); };
  EXPECT_EQ(there(Multipath(Stream(7))), there(Multipath(Stream(7))));
  EXPECT_NE(there(Multipath(Stream(7))), there(Multipath(Stream(8))));
}

// Re E[h(p, q) conj h(p + s, q)] over places and fields; s in wavelengths.
double correlation(double east, double north, double up) {
  double sum = 0;
  constexpr int fields = 80, places = 250;
  const Stream random(3);
  for (uint64_t i = 0; i < fields; ++i) {
    const Multipath field(Stream(mixed(i)));
    for (uint64_t j = 0; j < places; ++j) {
      const auto at = [&](uint64_t k) { return 500 * random.uniform(i * places + j, k); };
      const double x = at(0), y = at(1);
      const FieldPoint q{at(2), at(3), 0};
      const auto here = field.between({x, y, 0}, q), there = field.between({x + east, y + north, up}, q);
      sum += (here * std::conj(there)).real() / (fields * places);
    }
  }
  return sum;
}

TEST(Multipath, DecorrelatesOverTheGroundAsBesselsJ0) {
  for (const double s : {0.05, 0.1, 0.2, 0.3, 0.38, 0.5, 0.61, 0.8, 1.0}) {
    const double expected = std::cyl_bessel_j(0, 6.283185307179586 * s);
    EXPECT_NEAR(correlation(s, 0, 0), expected, 0.03) << s << " wavelengths east";
    EXPECT_NEAR(correlation(0.6 * s, 0.8 * s, 0), expected, 0.03) << s << " wavelengths north by east";
  }
}

TEST(Multipath, DecorrelatesWithHeightToo) {
  EXPECT_GT(correlation(0, 0, 0.3), 0.9);
  EXPECT_LT(correlation(0, 0, 3), 0.1);
}

TEST(Reading, DrawBelongsToRadiosPlaceAndTimeInEitherOrder) {
  const Pose here{1, 2, 3, 1, 0, 0, 0}, there{4, 5, 6, 1, 0, 0, 0};
  const uint64_t a = end_key(1, 0.5, here), b = end_key(2, 0.5, there);
  EXPECT_EQ(diffuse(Stream(5), a, b), diffuse(Stream(5), b, a));
  EXPECT_NE(diffuse(Stream(5), a, b), diffuse(Stream(5), end_key(3, 0.5, here), b));
  EXPECT_NE(diffuse(Stream(5), a, b), diffuse(Stream(5), end_key(1, 0.6, here), b));
  EXPECT_NE(diffuse(Stream(5), a, b), diffuse(Stream(5), end_key(1, 0.5, there), b));
  EXPECT_NE(diffuse(Stream(5), a, b), diffuse(Stream(5), end_key(1, 0.5, {1, 2, 3.5, 1, 0, 0, 0}), b));
}

}  // namespace
}  // namespace muster
