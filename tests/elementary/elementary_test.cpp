// The elementary functions that programs and plugins are linked to, against the C library's in extended precision.
#include <gtest/gtest.h>
#include <sleef.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// In units of the last place of the exact value.
double off(double value, long double exact) {
  const double near = static_cast<double>(exact);
  const double ulp = std::nextafter(std::abs(near), infinity) - std::abs(near);
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact)) / ulp;
}

struct Function {
  std::string name;
  double (*value)(double);
  long double (*exact)(long double);
  double from, to;
  double ulp = 1.001;  // as SLEEF states, and the rounding of the reference
};
constexpr double trigonometric = 3.501;

std::string name_of(const testing::TestParamInfo<Function>& info) { return info.param.name; }

class Elementary : public testing::TestWithParam<Function> {};
INSTANTIATE_TEST_SUITE_P(
    Functions, Elementary,
    testing::Values(Function{"sin", std::sin, sinl, -100, 100, trigonometric},
                    Function{"cos", std::cos, cosl, -100, 100, trigonometric},
                    Function{"tan", std::tan, tanl, -1.5, 1.5, trigonometric},
                    Function{"asin", std::asin, asinl, -1, 1, trigonometric},
                    Function{"acos", std::acos, acosl, -1, 1, trigonometric},
                    Function{"atan", std::atan, atanl, -10, 10, trigonometric},
                    Function{"exp", std::exp, expl, -50, 50}, Function{"expm1", std::expm1, expm1l, -1, 1},
                    Function{"log", std::log, logl, 1e-6, 1e3}, Function{"log2", std::log2, log2l, 1e-6, 1e3},
                    Function{"sinh", std::sinh, sinhl, -5, 5}, Function{"cosh", std::cosh, coshl, -5, 5},
                    Function{"tanh", std::tanh, tanhl, -5, 5}, Function{"asinh", std::asinh, asinhl, -5, 5},
                    Function{"acosh", std::acosh, acoshl, 1, 50}, Function{"atanh", std::atanh, atanhl, -0.9, 0.9},
                    Function{"erf", std::erf, erfl, -3, 3}, Function{"erfc", std::erfc, erfcl, -3, 10, 1.501},
                    Function{"lgamma", std::lgamma, lgammal, 3, 100},
                    Function{"tgamma", std::tgamma, tgammal, 0.1, 50}),
    name_of);

TEST_P(Elementary, IsAsExactAsStated) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> at(GetParam().from, GetParam().to);
  for (int k = 0; k < 20000; ++k) {
    const double x = at(random);
    ASSERT_LE(off(GetParam().value(x), GetParam().exact(x)), GetParam().ulp) << GetParam().name << '(' << x << ')';
  }
}

uint64_t bits_of(double value) {
  uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

struct Portable {
  std::string name;
  double (*value)(double);
  decltype(Sleef_cinz_expd1_u10purec)* portable;
};

class PortableBits : public testing::TestWithParam<Portable> {};
INSTANTIATE_TEST_SUITE_P(Functions, PortableBits,
                         testing::Values(Portable{"sin", std::sin, Sleef_cinz_sind1_u35purec},
                                         Portable{"cos", std::cos, Sleef_cinz_cosd1_u35purec},
                                         Portable{"tan", std::tan, Sleef_cinz_tand1_u35purec},
                                         Portable{"asin", std::asin, Sleef_cinz_asind1_u35purec},
                                         Portable{"acos", std::acos, Sleef_cinz_acosd1_u35purec},
                                         Portable{"atan", std::atan, Sleef_cinz_atand1_u35purec},
                                         Portable{"exp", std::exp, Sleef_cinz_expd1_u10purec},
                                         Portable{"expm1", std::expm1, Sleef_cinz_expm1d1_u10purec},
                                         Portable{"log", std::log, Sleef_cinz_logd1_u10purec},
                                         Portable{"log2", std::log2, Sleef_cinz_log2d1_u10purec},
                                         Portable{"sinh", std::sinh, Sleef_cinz_sinhd1_u10purec},
                                         Portable{"cosh", std::cosh, Sleef_cinz_coshd1_u10purec},
                                         Portable{"tanh", std::tanh, Sleef_cinz_tanhd1_u10purec},
                                         Portable{"asinh", std::asinh, Sleef_cinz_asinhd1_u10purec},
                                         Portable{"acosh", std::acosh, Sleef_cinz_acoshd1_u10purec},
                                         Portable{"atanh", std::atanh, Sleef_cinz_atanhd1_u10purec},
                                         Portable{"erf", std::erf, Sleef_cinz_erfd1_u10purec},
                                         Portable{"erfc", std::erfc, Sleef_cinz_erfcd1_u15purec},
                                         Portable{"lgamma", std::lgamma, Sleef_cinz_lgammad1_u10purec},
                                         Portable{"tgamma", std::tgamma, Sleef_cinz_tgammad1_u10purec}),
                         [](const auto& function) { return function.param.name; });

// Numbers of all magnitudes and signs, subnormal, infinite and none: a machine without these lanes comes to the same.
TEST_P(PortableBits, AreThoseOfTheLanes) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> usual(-30, 30);
  for (int k = 0; k < 200000; ++k) {
    const uint64_t bits = random();
    double x = usual(random);
    if (k % 2) std::memcpy(&x, &bits, sizeof x);
    const double value = GetParam().value(x), portable = GetParam().portable(x);
    if (std::isnan(value) && std::isnan(portable)) continue;
    ASSERT_EQ(bits_of(value), bits_of(portable)) << GetParam().name << '(' << x << ')';
  }
  for (const double x : {0.0, -0.0, infinity, -infinity, 5e-324, -5e-324, 1.0, -1.0, 1e308, -1e308}) {
    const double value = GetParam().value(x), portable = GetParam().portable(x);
    EXPECT_TRUE(bits_of(value) == bits_of(portable) || (std::isnan(value) && std::isnan(portable)))
        << GetParam().name << '(' << x << ')';
  }
}

TEST(PortableBitsOfTwo, AreThoseOfTheLanes) {
  std::mt19937_64 random(10);
  std::uniform_real_distribution<double> at(-40, 40);
  for (int k = 0; k < 200000; ++k) {
    const double x = k % 7 ? at(random) : std::round(at(random)), y = k % 5 ? at(random) : std::round(at(random));
    ASSERT_EQ(bits_of(std::atan2(y, x)), bits_of(Sleef_cinz_atan2d1_u35purec(y, x))) << y << ' ' << x;
    const double value = std::pow(x, y), portable = Sleef_cinz_powd1_u10purec(x, y);
    ASSERT_TRUE(bits_of(value) == bits_of(portable) || (std::isnan(value) && std::isnan(portable))) << x << ' ' << y;
  }
}

TEST(ElementaryOfTwo, AreAsExactAsStated) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> at(-10, 10);
  for (int k = 0; k < 20000; ++k) {
    const double x = at(random), y = at(random);
    ASSERT_LE(off(std::atan2(y, x), atan2l(y, x)), trigonometric);
    ASSERT_LE(off(std::pow(std::abs(x), y), powl(std::abs(x), y)), 1.001);
  }
}

// What people compare for equality: decibels of powers of ten, squares, full turns.
TEST(Elementary, ExactValuesAreExact) {
  for (int n = -15; n <= 15; ++n) {
    EXPECT_EQ(std::log10(std::pow(10.0, n)), n) << n;
    EXPECT_EQ(std::pow(n, 2), n * n) << n;
    if (n >= 0) {
      EXPECT_EQ(std::pow(10.0, n),
                static_cast<double>(std::stoll("1" + std::string(static_cast<std::size_t>(n), '0'))));
    }
  }
  EXPECT_EQ(std::sin(0.0), 0);
  EXPECT_EQ(std::cos(0.0), 1);
  EXPECT_EQ(std::exp(0.0), 1);
  EXPECT_EQ(std::log(1.0), 0);
  EXPECT_EQ(std::hypot(3.0, 4.0), 5);
  EXPECT_EQ(std::atan2(1.0, 0.0), M_PI / 2);
  EXPECT_EQ(std::atan2(0.0, -1.0), M_PI);
  EXPECT_TRUE(std::signbit(std::sin(-0.0)));
}

TEST(Elementary, WhatIsNoNumberIsNone) {
  const double nan = std::nan("");
  for (double (*f)(double) : {static_cast<double (*)(double)>(std::sin), static_cast<double (*)(double)>(std::cos),
                              static_cast<double (*)(double)>(std::exp), static_cast<double (*)(double)>(std::log),
                              static_cast<double (*)(double)>(std::log10), static_cast<double (*)(double)>(std::tanh)})
    EXPECT_TRUE(std::isnan(f(nan)));
  EXPECT_TRUE(std::isnan(std::sin(infinity)));
  EXPECT_TRUE(std::isnan(std::log(-1.0)));
  EXPECT_TRUE(std::isnan(std::asin(2.0)));
  EXPECT_TRUE(std::isnan(std::pow(-8.0, 0.5)));
  EXPECT_EQ(std::log(0.0), -infinity);
  EXPECT_EQ(std::log10(0.0), -infinity);
  EXPECT_EQ(std::exp(infinity), infinity);
  EXPECT_EQ(std::exp(-infinity), 0);
  EXPECT_EQ(std::exp(1000.0), infinity);
  EXPECT_EQ(std::pow(0.0, 0.0), 1);
  EXPECT_EQ(std::pow(-2.0, 3.0), -8);
  EXPECT_EQ(std::hypot(infinity, nan), infinity);
}

}  // namespace
