// Causes on the path between the radios: slopes, reflections, walls behind walls.
#include <complex>

#include "survey.hpp"

namespace muster {
namespace {

TEST(DualSlope, BeginsAtTheBreakpoint) {
  expect_term("dual_slope", "break=\"6\" n_change=\"1.5\"",
              [](const Reading& r) { return length(r) > 6 ? -15 * std::log10(length(r) / 6) : 0; });
}

// With Snell's law, as Fresnel has it: tan(i - t) / tan(i + t), i and t the angles to the normal.
double upright_fresnel(double sine, double permittivity) {
  const double i = std::acos(sine), t = std::asin(std::sin(i) / std::sqrt(permittivity));
  return std::tan(i - t) / std::tan(i + t);
}

TEST(TwoRay, IsTheSumOfTwoWaves) {
  const auto both = [](const Reading& r) {
    const double high = r.from.z + r.to.z + 0.2, mirrored = std::hypot(r.from.x - r.to.x, r.from.y - r.to.y, high);
    const double k = 2 * 3.141592653589793 * 2.4e9 / 299792458;
    const double share = 0.8 * upright_fresnel(high / mirrored, 4.5) * length(r) / mirrored;
    return 20 * std::log10(std::abs(1.0 + share * std::polar(1.0, -k * (mirrored - length(r)))));
  };
  expect_term("two_ray", "reflection=\"0.8\" permittivity=\"4.5\" ground=\"-0.1\" frequency=\"2.4e9\"", both);
}

// At Brewster's angle, whose tangent to the normal is sqrt(permittivity), nothing is reflected; straight down R is
// (sqrt(permittivity) - 1) / (sqrt(permittivity) + 1).
TEST(TwoRay, TurnsItsSignAtBrewstersAngle) {
  Site site({{0, "a", "r", {0, 0, 1, 0}, {4, 0, 1, 0}, 0, 0}, {1, "a", "r", {0, 0, 3, 0}, {0, 0, 1, 0}, 0, 0}});
  const auto part = column(site.world(effect("two_ray", "reflection=\"1\" permittivity=\"4\"")), "link/*/level@it");
  EXPECT_NEAR(part[0], 0, 1e-12);
  const double k = 2 * 3.141592653589793 * 2.44e9 / 299792458;
  EXPECT_NEAR(part[1], 20 * std::log10(std::abs(1.0 + 1. / 3 * 2 / 4 * std::polar(1.0, -k * 2))), 1e-9);
}

// Rappaport's approximation for flat angles: both waves differ by the phase 4 pi h h' / (wavelength d). There R is -1,
// up to twice the sine by permittivity / sqrt(permittivity - 1).
TEST(TwoRay, FarAwayItIsTheTextbookPhase) {
  Site site({{0, "a", "r", {0, 0, 1, 0}, {400, 0, 0.5, 0}, 0, 0}, {1, "a", "r", {0, 0, 1, 0}, {800, 0, 0.5, 0}, 0, 0}});
  const auto part = column(site.world(effect("two_ray", "reflection=\"0.95\" permittivity=\"5\"")), "link/*/level@it");
  for (const std::size_t i : {0, 1}) {
    const double phase = 4 * 3.141592653589793 * 1 * 0.5 / (299792458 / 2.44e9 * length(site.readings[i]));
    const double share = 0.95 * (1 - 2 * 5 / 2. * 1.5 / length(site.readings[i]));
    EXPECT_NEAR(part[i], 10 * std::log10((1 - share) * (1 - share) + share * phase * phase), 0.03);
  }
}

TEST(MultiwallSaturation, BendsTheSumOfWallsTowardsTheKnee) {
  const Site site;
  const auto world = site.world(effect("multiwall_saturation", "knee=\"9\""));
  const auto walls = column(world, "link/*/level@radio.multiwall.walls"), part = column(world, "link/*/level@it");
  double most = 0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    EXPECT_NEAR(walls[i] + part[i], -9 * (1 - std::exp(walls[i] / 9)), 1e-12);
    most = std::max(most, part[i]);
  }
  EXPECT_GT(most, 3);
}

TEST(MultiwallSaturation, ReadsTheInstanceThatIsNamed) {
  const Site site;
  const std::string renamed = "<radio.multiwall name=\"building\"/><radio.receiver/>";
  const auto world = site.world(effect("multiwall_saturation", "knee=\"9\" of=\"building\""), false, 1, plan + renamed);
  EXPECT_GT(column(world, "link/*/level@it")[1], -1);
  EXPECT_THROW(site.world(effect("multiwall_saturation", "knee=\"9\""), false, 1, plan + renamed), Error);
}

}  // namespace
}  // namespace muster
