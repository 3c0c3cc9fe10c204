#include "diagnosis/data/globe.hpp"

#include <cmath>

#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

constexpr double equator = 6378137;               // m, WGS 84
constexpr double flattening = 1 / 298.257223563;  // WGS 84
constexpr double eccentricity2 = flattening * (2 - flattening);
constexpr double degree = 3.141592653589793 / 180;  // rad

std::array<double, 3> from_centre(const GeodeticPoint& p) {
  const double lat = p.latitude * degree, lon = p.longitude * degree;
  const double normal = equator / std::sqrt(1 - eccentricity2 * std::sin(lat) * std::sin(lat));
  return {(normal + p.altitude) * std::cos(lat) * std::cos(lon), (normal + p.altitude) * std::cos(lat) * std::sin(lon),
          (normal * (1 - eccentricity2) + p.altitude) * std::sin(lat)};
}

}  // namespace

std::string why_no_point(const GeodeticPoint& p) {
  if (!(std::abs(p.latitude) <= 90))
    return print_real(p.latitude) + " is no latitude; expected degrees from -90 to 90, before the longitude";
  if (!(std::abs(p.longitude) <= 360))
    return print_real(p.longitude) + " is no longitude; expected degrees from -180 to 180";
  return "";
}

TangentPlane::TangentPlane(const GeodeticPoint& origin) : origin_(origin), centre_(from_centre(origin)) {}

std::array<double, 3> TangentPlane::east_north_up(const GeodeticPoint& point) const {
  const auto at = from_centre(point);
  const double x = at[0] - centre_[0], y = at[1] - centre_[1], z = at[2] - centre_[2];
  const double lat = origin_.latitude * degree, lon = origin_.longitude * degree;
  const double outward = std::cos(lon) * x + std::sin(lon) * y;  // from the axis of the earth
  return {-std::sin(lon) * x + std::cos(lon) * y, -std::sin(lat) * outward + std::cos(lat) * z,
          std::cos(lat) * outward + std::sin(lat) * z};
}

}  // namespace muster::diagnosis
