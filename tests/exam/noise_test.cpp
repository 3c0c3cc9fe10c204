// Clean cases hold the stated model and nothing else.
#include <gtest/gtest.h>

#include "exam/field.hpp"
#include "exam/reading_law.hpp"
#include "made.hpp"

namespace muster::exam {
namespace {

TEST(CleanCase, IsTheBaseModelPlusItsNoiseRoundedToWholeDecibels) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Case c = made(seed, "");
    const Eigen::VectorXd level =
        level_by_base(c, c.measured) + draw_noise(c, Field(*c.site, c.seed), c.measured, "measured");
    for (Eigen::Index i = 0; i < level.size(); ++i)
      if (!std::isnan(c.measured.rssi[i]) && level[i] < -1) {
        ASSERT_EQ(c.measured.rssi[i], std::round(level[i])) << "seed " << seed << ", reading " << i;
      }
  }
}

TEST(CleanCase, LosesAsManyReadingsAsItSays) {
  double lost = 0, expected = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Case c = made(seed, "", 0, 600);
    for (const double v : c.measured.rssi) lost += std::isnan(v);
    expected += c.site->noise.lost * static_cast<double>(c.measured.size());
    all += static_cast<double>(c.measured.size());
  }
  EXPECT_GT(expected, 0.005 * all);
  EXPECT_NEAR(lost, expected, 5 * std::sqrt(expected));
}

// Covariance of the field over distance, averaged over many fields on one site.
TEST(Noise, FieldHasTheStatedCovariance) {
  GroundTruth site = draw_site(3, {}, 600);
  for (const Family family : {Family::exponential, Family::gaussian, Family::two_scale}) {
    site.noise.field = {family, 4, 1.5, 0.25};
    const Vec2 origin{site.plan.whole.high.x / 2, site.plan.whole.high.y / 2};
    for (const double distance : {0.0, 0.4, 1.2, 2.4, 4.8}) {
      double same = 0, other = 0;
      int count = 0;
      for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const Field field(site, seed);
        for (double x = -8; x <= 8; x += 1.6)
          for (double y = -4; y <= 4; y += 1.6, ++count) {
            const Vec2 a = site.plan.to_world({origin.x + x, origin.y + y}),
                       b = site.plan.to_world({origin.x + x + distance, origin.y + y});
            same += field(0, a) * field(0, b);
            other += field(0, a) * field(1, b);
          }
      }
      const double wanted = 16 * correlation(site.noise.field, distance), error = 16 * 5 / std::sqrt(count / 3.0);
      EXPECT_NEAR(same / count, wanted, error) << "family " << static_cast<int>(family) << " at " << distance << " m";
      EXPECT_NEAR(other / count, 0.25 * wanted, error)
          << "family " << static_cast<int>(family) << " at " << distance << " m";
    }
  }
}

// With the covariance used for lambda, whitened noise has variance 1: in the means of rows, and in the single
// readings beside them.
TEST(Noise, IsWhiteOnceWhitened) {
  double rows = 0, row_count = 0, all = 0, count = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const Case c = made(seed, "", 0, 2000);
    const Eigen::VectorXd noise = c.measured.rssi - level_by_base(c, c.measured);
    const Eigen::VectorXd safe = noise.unaryExpr([](double v) { return std::isnan(v) ? 0 : v; });
    const auto white = [&](Detail detail) -> Eigen::VectorXd {
      return Whitener(c.measured, c.site->noise, heard(c.measured), detail)(safe);
    };
    const Eigen::VectorXd of_rows = white(Detail::rows), of_readings = white(Detail::readings);
    rows += of_rows.squaredNorm();
    row_count += static_cast<double>(of_rows.size());
    all += of_readings.squaredNorm();
    count += static_cast<double>(of_readings.size());
  }
  ASSERT_GT(count, 2 * row_count);
  EXPECT_NEAR(rows / row_count, 1, 0.03);
  EXPECT_NEAR(all / count, 1, 0.03);
}

TEST(Noise, FadingHasTheMomentsOfItsDensity) {
  EXPECT_NEAR(fading_moments({-40, 1, 0, {}}).mean, -2.507, 0.01);  // Rayleigh: -10 log10(e) x Euler's constant
  EXPECT_NEAR(std::sqrt(fading_moments({-40, 1, 0, {}}).variance), 5.570, 0.03);
  Random random(1, "test");
  for (const double k : {0.0, 6.0, 10.0}) {
    const ReadingLaw law{k, 1, 0, {}};
    double first = 0, second = 0;
    constexpr int draws = 200000;
    for (int i = 0; i < draws; ++i) {
      const double db = draw_reading(law, random);
      first += db / draws;
      second += db * db / draws;
    }
    EXPECT_NEAR(first, fading_moments(law).mean, 0.05) << k;
    EXPECT_NEAR(second - first * first, fading_moments(law).variance, 0.03 * second) << k;
  }
}

TEST(Noise, AveragedFadesAreStatedByTheFactorOfTheSameVariance) {
  const ReadingLaw averaged{4, 4, 0, {}};
  const double k = equivalent_rician_k(averaged);
  EXPECT_GT(k, 8);
  EXPECT_NEAR(fading_moments({k, 1, 0, {}}).variance, fading_moments(averaged).variance, 0.05);
}

}  // namespace
}  // namespace muster::exam
