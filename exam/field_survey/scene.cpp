#include "exam/field_survey/scene.hpp"

#include <algorithm>
#include <complex>
#include <numbers>

namespace muster::exam::survey {
namespace {

// Twice the area of a triangle in the plan, positive to the left of the way from a to b.
double area(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

}  // namespace

bool passes(const Panel& panel, Point a, Point b) {
  const double from = area(a, b, panel.from), to = area(a, b, panel.to);
  const double near = area(panel.from, panel.to, a), far = area(panel.from, panel.to, b);
  if (!(from * to < 0 && near * far < 0)) return false;
  const double share = near / (near - far);
  return a.z + share * (b.z - a.z) < panel.height;
}

Path path_of(const Scene& scene, const Row& row) {
  const Radio& tx = scene.radios[static_cast<std::size_t>(row.tx)];
  const Radio& rx = scene.radios[static_cast<std::size_t>(row.rx)];
  Path path{row, tx.moves ? row.mobile : tx.at, rx.moves ? row.mobile : rx.at, tx.moves ? row.yaw : tx.yaw,
            rx.moves ? row.yaw : rx.yaw};
  path.length = length(path.tx, path.rx);
  return path;
}

double mean_level(const Scene& scene, const Row& row) {
  const Path path = path_of(scene, row);
  double level = scene.power - scene.l0 - 10 * scene.n * std::log10(std::max(path.length, 0.01));
  for (const Panel& panel : scene.panels)
    if (passes(panel, path.tx, path.rx)) level -= panel.loss;
  for (const auto& term : scene.terms) level += term(path);
  return level;
}

double two_ray_gain(double distance_on_ground, double height_a, double height_b, double frequency, double permittivity,
                    double roughness) {
  const double direct = std::hypot(distance_on_ground, height_a - height_b);
  const double reflected = std::hypot(distance_on_ground, height_a + height_b);
  const double sine = (height_a + height_b) / reflected, cosine = distance_on_ground / reflected;
  // Fresnel's coefficient of a field in the plane of incidence, at grazing angle asin(sine).
  const double root = std::sqrt(permittivity - cosine * cosine);
  const double fresnel = (permittivity * sine - root) / (permittivity * sine + root);
  const double phase = 2 * std::numbers::pi * frequency / 299792458.0 * (reflected - direct);
  return 20 * std::log10(std::abs(1.0 + roughness * fresnel * direct / reflected * std::polar(1.0, -phase)));
}

}  // namespace muster::exam::survey
