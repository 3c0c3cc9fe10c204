// Antennas on their formulas: directivities and beamwidths in closed form, frames, and measured tables.
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "radio_antenna/antenna_shapes.hpp"
#include "radio_antenna/gain_table.hpp"

namespace muster {
namespace {

using Shape = std::function<double(const Direction&)>;

// Highest gain [dBi] of a lossless antenna.
double directivity(const Shape& shape) {
  return -10 * std::log10(mean_over_sphere([&](const Direction& d) { return std::pow(10, shape(d) / 10); }));
}

Direction toward(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

// Cin(x), the integral of (1 - cos t)/t from 0 to x, by its series.
double cin_integral(double x) {
  double sum = 0, term = 1;
  for (int n = 1; n < 40; ++n) {
    term *= -x * x / ((2.0 * n - 1) * (2.0 * n));
    sum -= term / (2 * n);
  }
  return sum;
}

TEST(Antenna, DipoleHasTheDirectivityAndTheBeamOfTheTextbook) {
  EXPECT_NEAR(directivity(dipole_shape), 10 * std::log10(4 / cin_integral(2 * half_turn)), 1e-3);
  EXPECT_NEAR(directivity(dipole_shape), 2.15, 0.005);
  EXPECT_NEAR(dipole_shape(toward(1, 0)), 0, 1e-12);
  EXPECT_NEAR(dipole_shape(toward(-2, 78.08 / 360 * half_turn)), -3.0103, 1e-3);  // half of 78.08 degrees
  EXPECT_LT(dipole_shape(toward(0, half_turn / 2)), -200);
  EXPECT_LT(dipole_shape({0, 0, -1}), -200);
}

TEST(Antenna, CosineLobeIsStrongerAsItIsNarrower) {
  for (const double beamwidth : {0.1, 0.3, 0.8, 1.5, 2.0943951023931953, 2.8}) {
    const auto shape = [&](const Direction& d) { return cosine_shape(d, beamwidth); };
    const double order = std::log(0.5) / std::log(std::cos(beamwidth / 2));
    EXPECT_NEAR(directivity(shape), 10 * std::log10(2 * (order + 1)), 5e-3) << beamwidth;
    EXPECT_NEAR(shape(toward(beamwidth / 2, 0)), -3.0103, 1e-4);
    EXPECT_NEAR(shape(toward(0, -beamwidth / 2)), -3.0103, 1e-4);
    EXPECT_LT(shape(toward(2, 0.1)), -200);
  }
}

TEST(Antenna, SectorIsThatOfItsTable) {
  const double width = 70 * half_turn / 180, up = 10 * half_turn / 180;  // 3GPP TR 36.814's
  const auto shape = [&](double azimuth, double elevation) {
    return sector_shape(toward(azimuth, elevation), width, up, 25);
  };
  EXPECT_NEAR(shape(0, 0), 0, 1e-12);
  EXPECT_NEAR(shape(width / 2, 0), -3, 1e-9);
  EXPECT_NEAR(shape(0, up / 2), -3, 1e-9);
  EXPECT_NEAR(shape(width / 2, -up / 2), -6, 1e-9);
  EXPECT_NEAR(shape(half_turn, 0), -25, 1e-9);
}

TEST(Antenna, IsTurnedToTheLeftThenUpwardThenAboutItsLobe) {
  const auto seen = [](const Direction& d, const Pose& turned) { return in_frame(turned, d); };
  const auto expect = [](const Direction& found, const Direction& expected) {
    EXPECT_NEAR(found.x, expected.x, 1e-12);
    EXPECT_NEAR(found.y, expected.y, 1e-12);
    EXPECT_NEAR(found.z, expected.z, 1e-12);
  };
  for (const double azimuth : {-2.0, 0.4, 3.0}) {
    for (const double elevation : {-1.2, 0.3, 1.5}) {
      for (const double roll : {-0.7, 0.0, 2.0}) {
        expect(seen(toward(azimuth, elevation), turn(azimuth, elevation, roll)), {1, 0, 0});
      }
    }
  }
  expect(seen({0, 0, 1}, turn(0.5, 0, half_turn / 2)), {0, 1, 0});  // rolled to the right, up is on the left
  expect(seen({1, 0, 0}, turn(0.5, 0, 0)), toward(-0.5, 0));
  expect(seen({1, 0, 0}, turn(0, 0.5, 0)), toward(0, -0.5));
}

TEST(Antenna, SeesNoDirectionWhereBothAreInOnePlace) {
  const Pose here{1, 2, 3, 1, 0, 0, 0}, there{1, 2, 5, 1, 0, 0, 0};
  EXPECT_EQ(from_to(here, here).z, 0);
  EXPECT_EQ(from_to(here, there).z, 1);
  EXPECT_EQ(from_to(there, here).z, -1);
}

std::vector<MeasuredGain> measured(int azimuths, int elevations, const Shape& gain) {
  std::vector<MeasuredGain> rows;
  for (int e = elevations - 1; e >= 0; --e) {
    for (int a = 0; a < azimuths; ++a) {
      const double azimuth = 2 * half_turn * (a + 0.4) / azimuths - half_turn,
                   elevation = half_turn * e / (elevations - 1) - half_turn / 2;
      rows.push_back({azimuth, elevation, gain(toward(azimuth, elevation))});
    }
  }
  return rows;
}

GainTable table_of(const std::vector<MeasuredGain>& rows) {
  return GainTable(Rows<const MeasuredGain>(&rows.data()->azimuth, rows.size()));
}

TEST(GainTable, FollowsTheAntennaThatWasMeasured) {
  const Shape lobe = [](const Direction& d) { return 1 + 2 * d.x + d.y - 5 * d.z * d.z; };
  const auto rows = measured(72, 37, lobe);
  const GainTable table = table_of(rows);
  for (const MeasuredGain& row : rows) EXPECT_NEAR(table.gain(toward(row.azimuth, row.elevation)), row.gain, 1e-9);
  for (double azimuth = -half_turn; azimuth < half_turn; azimuth += 0.093) {  // over the seam too
    for (double elevation = -1.57; elevation < 1.57; elevation += 0.071) {
      const Direction d = toward(azimuth, elevation);
      EXPECT_NEAR(table.gain(d), lobe(d), 0.02) << azimuth << ' ' << elevation;
    }
  }
}

TEST(GainTable, OfOneAzimuthIsTheSameAllAround) {
  const GainTable table = table_of(measured(1, 61, [](const Direction& d) { return 1 - 6 * d.z * d.z; }));
  EXPECT_EQ(table.gain(toward(2, 0)), table.gain(toward(-1, 0)));
  EXPECT_NEAR(table.gain(toward(2, 0)), 1, 1e-9);
}

TEST(GainTable, RefusesWhatIsNoAntenna) {
  const Shape even = [](const Direction&) { return 0.0; };
  const auto refusal = [](const std::vector<MeasuredGain>& rows) -> std::string {
    try {
      table_of(rows);
    } catch (const BadInput& refused) {
      return refused.what();
    }
    return "";
  };
  auto rows = measured(4, 3, even);
  EXPECT_EQ(refusal(rows), "");
  rows.pop_back();
  EXPECT_EQ(
      refusal(rows),
      "attribute \"file\": it has no gain at azimuth 2.199, elevation -1.571; expected one at each of its azimuths "
      "and elevations");
  rows.push_back(rows.front());
  EXPECT_EQ(refusal(rows), "attribute \"file\": it has two gains at azimuth -2.513, elevation 1.571");
  EXPECT_EQ(
      refusal({{0, 90, 0}}),
      "attribute \"file\": row 1 is azimuth 0.000, elevation 90.000; expected radians, an azimuth within -pi and pi "
      "and an elevation within -pi/2 and pi/2; are these degrees? a degree is 0.017453293 rad");
  EXPECT_EQ(refusal({{0, 0, 2.15}, {1, 0, 2.15}}),
            "attribute \"file\": it ends at the elevations 0.000 and 0.000; expected gains from -pi/2 to pi/2");
  EXPECT_EQ(
      refusal(measured(4, 3, [](const Direction&) { return 1.25; })),
      "attribute \"file\": it radiates more than it is fed: its mean gain over all directions is 1.250 dBi; expected "
      "at most 0, or 0.5 for errors of calibration");
}

}  // namespace
}  // namespace muster
