#include "colour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace muster::plotting {
namespace {

// Oklab, a perceptually uniform space: https://bottosson.github.io/posts/oklab (public domain).
struct Lab {
  double l, a, b;
};

double to_linear(std::uint8_t channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

std::uint8_t from_linear(double c) {
  const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(encoded, 0.0, 1.0)));
}

Lab to_lab(Colour colour) {
  const double r = to_linear(colour.r), g = to_linear(colour.g), b = to_linear(colour.b);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

Colour from_lab(Lab lab) {
  const double l = std::pow(lab.l + 0.3963377774 * lab.a + 0.2158037573 * lab.b, 3);
  const double m = std::pow(lab.l - 0.1055613458 * lab.a - 0.0638541728 * lab.b, 3);
  const double s = std::pow(lab.l - 0.0894841775 * lab.a - 1.2914855480 * lab.b, 3);
  return {from_linear(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          from_linear(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          from_linear(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

constexpr std::array viridis{Colour{68, 1, 84},    Colour{71, 44, 122},  Colour{59, 81, 139},
                             Colour{44, 113, 142}, Colour{33, 144, 141}, Colour{39, 173, 129},
                             Colour{92, 200, 99},  Colour{170, 220, 50}, Colour{253, 231, 37}};
// Okabe and Ito's blue and vermillion, extended to light and to dark. The middle is not white: a cell of 0 differs from
// a gap.
constexpr std::array diverging{Colour{9, 46, 92},     blue,       Colour{146, 196, 224}, Colour{236, 234, 226},
                               Colour{244, 184, 146}, vermillion, Colour{112, 38, 4}};

Colour between(std::span<const Colour> anchors, double at) {
  const double place = std::clamp(at, 0.0, 1.0) * static_cast<double>(anchors.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), anchors.size() - 2);
  const double f = place - static_cast<double>(i);
  const Lab p = to_lab(anchors[i]), q = to_lab(anchors[i + 1]);
  return from_lab({std::lerp(p.l, q.l, f), std::lerp(p.a, q.a, f), std::lerp(p.b, q.b, f)});
}

}  // namespace

std::string Colour::hex() const { return fmt::format("#{:02x}{:02x}{:02x}", r, g, b); }

Colour series_colour(std::size_t i) {
  constexpr std::array cycle{blue, vermillion, green, purple, sky, orange};
  return cycle[i % cycle.size()];
}

Colour map_colour(Map map, double at) { return map == Map::viridis ? between(viridis, at) : between(diverging, at); }

double lightness(Colour colour) { return to_lab(colour).l; }

}  // namespace muster::plotting
