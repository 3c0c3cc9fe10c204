// Effects of the path between the radios.
#include <complex>
#include <numbers>

#include "exam/effects/effect.hpp"

namespace muster::exam {
namespace {

constexpr double wavelength = 299792458 / 2.44e9;  // m

Effect dual_slope(const Scene& s, Random& random) {
  const double break_at = random.uniform(4, 10), blend = random.uniform(0.08, 0.2);
  Effect e{"dual_slope"};
  e.least = 0.1;
  e.most = 4;
  e.shift = scaled([&site = s.site, break_at, blend](const Reading& r) {
    return -10 * blend * std::log10(1 + std::pow(distance_of(place_of(site, r), r.at) / break_at, 1 / blend));
  });
  e.parameters = [=](double x) { return std::vector<Parameter>{{"break", break_at, "m"}, {"n_change", x, ""}}; };
  return e;
}

// Two-ray model: an image of the station below the floor, vertical polarisation, a smooth floor's reflection less its
// roughness loss.
Effect two_ray(const Scene& s, Random& random) {
  const double permittivity = random.uniform(3, 8);
  Effect e{"two_ray"};
  e.linear = false;
  e.least = 0.05;
  e.most = 0.95;
  e.shift = [&site = s.site, permittivity](const Data& data, double x) {
    Eigen::VectorXd result(static_cast<Eigen::Index>(data.size()));
    for (std::size_t i = 0; i < data.size(); ++i) {
      const Vec3 from = place_of(site, data.readings[i]), to = data.readings[i].at;
      const double direct = distance_of(from, to), mirrored = distance_of({from.x, from.y, -from.z}, to);
      const double sine = (from.z + to.z) / mirrored, root = std::sqrt(permittivity - 1 + sine * sine);
      const double reflected = x * (permittivity * sine - root) / (permittivity * sine + root) * direct / mirrored;
      const double phase = -2 * std::numbers::pi * (mirrored - direct) / wavelength;
      result[static_cast<Eigen::Index>(i)] = 20 * std::log10(std::abs(1.0 + std::polar(1.0, phase) * reflected));
    }
    return result;
  };
  e.parameters = [=](double x) {
    return std::vector<Parameter>{{"reflection", x, ""}, {"permittivity", permittivity, ""}};
  };
  return e;
}

// Waveguide: powers of all images between a corridor's two walls add up, with both radios in it.
Effect corridor(const Scene& s, Random&) {
  Effect e{"corridor"};
  e.linear = false;
  e.least = 0.05;
  e.most = 0.95;
  e.shift = [&site = s.site](const Data& data, double reflection) {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(data.size()));
    const Room& strip = site.plan.corridor;
    const double width = strip.high.y - strip.low.y;
    for (std::size_t i = 0; i < data.size(); ++i) {
      const Vec3 station = place_of(site, data.readings[i]), robot = data.readings[i].at;
      const Vec2 a = site.plan.to_own({station.x, station.y}), b = site.plan.to_own({robot.x, robot.y});
      if (!strip.holds(a) || !strip.holds(b)) continue;
      const double direct = distance_of(station, robot);
      double sum = 1;
      for (int image = 1; image <= 20; ++image)
        for (const int side : {-1, 1}) {
          // Image after `image` reflections, the first one at the wall on this side.
          const double from_wall = a.y - strip.low.y;
          const double y = image % 2 == 0 ? from_wall + side * image * width : -from_wall + (side * image + 1) * width;
          const double across = y - (b.y - strip.low.y), way = std::hypot(across, b.x - a.x, station.z - robot.z);
          sum += std::pow(reflection, 2 * image) * direct * direct / (way * way);
        }
      result[static_cast<Eigen::Index>(i)] = 10 * std::log10(sum);
    }
    return result;
  };
  e.parameters = [](double x) { return std::vector<Parameter>{{"reflection", x, ""}}; };
  return e;
}

}  // namespace

std::vector<Recipe> distance_recipes() {
  SiteNeeds in_corridor;
  in_corridor.plan.corridor_station = true;
  return {
      {"dual_slope", true, {}, dual_slope}, {"two_ray", true, {}, two_ray}, {"corridor", true, in_corridor, corridor}};
}

}  // namespace muster::exam
