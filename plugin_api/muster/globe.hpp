// Places on the globe (WGS 84) and in the plane that touches it at an origin: metres east, north and up, both ways.
#pragma once

#include <array>
#include <cmath>

namespace muster {

struct GlobePoint {
  double latitude = 0, longitude = 0;  // [deg]
  double altitude = 0;                 // above the ellipsoid [m]
};

class GlobePlane {
 public:
  explicit GlobePlane(const GlobePoint& origin)
      : sin_lat_(std::sin(origin.latitude * degree)),
        cos_lat_(std::cos(origin.latitude * degree)),
        sin_lon_(std::sin(origin.longitude * degree)),
        cos_lon_(std::cos(origin.longitude * degree)),
        centre_(from_centre(origin)) {}

  std::array<double, 3> east_north_up(const GlobePoint& point) const {
    const auto at = from_centre(point);
    const double x = at[0] - centre_[0], y = at[1] - centre_[1], z = at[2] - centre_[2];
    const double outward = cos_lon_ * x + sin_lon_ * y;  // from the axis of the earth
    return {-sin_lon_ * x + cos_lon_ * y, -sin_lat_ * outward + cos_lat_ * z, cos_lat_ * outward + sin_lat_ * z};
  }

  // The inverse; Bowring's iteration (1976), to rounding for altitudes from -10 to 10,000 km.
  GlobePoint point(double east, double north, double up) const {
    const double outward = -sin_lat_ * north + cos_lat_ * up;
    const double x = centre_[0] - sin_lon_ * east + cos_lon_ * outward;
    const double y = centre_[1] + cos_lon_ * east + sin_lon_ * outward;
    const double z = centre_[2] + cos_lat_ * north + sin_lat_ * up;
    const double from_axis = std::hypot(x, y), pole = equator * (1 - flattening);
    double reduced = std::atan2(z, from_axis * (1 - flattening)), latitude = 0;  // the first: of the ellipse's circle
    for (int i = 0; i < 5; ++i) {
      const double s = std::sin(reduced), c = std::cos(reduced);
      latitude = std::atan2(z + eccentricity2 / (1 - eccentricity2) * pole * s * s * s,
                            from_axis - eccentricity2 * equator * c * c * c);
      reduced = std::atan2((1 - flattening) * std::sin(latitude), std::cos(latitude));
    }
    const double s = std::sin(latitude), c = std::cos(latitude);
    const double altitude = from_axis * c + z * s - equator * std::sqrt(1 - eccentricity2 * s * s);
    return {latitude / degree, std::atan2(y, x) / degree, altitude};
  }

 private:
  static constexpr double equator = 6378137;               // [m]
  static constexpr double flattening = 1 / 298.257223563;  // of WGS 84
  static constexpr double eccentricity2 = flattening * (2 - flattening);
  static constexpr double degree = 3.141592653589793 / 180;  // [rad]

  static std::array<double, 3> from_centre(const GlobePoint& p) {
    const double lat = p.latitude * degree, lon = p.longitude * degree;
    const double normal = equator / std::sqrt(1 - eccentricity2 * std::sin(lat) * std::sin(lat));
    return {(normal + p.altitude) * std::cos(lat) * std::cos(lon),
            (normal + p.altitude) * std::cos(lat) * std::sin(lon),
            (normal * (1 - eccentricity2) + p.altitude) * std::sin(lat)};
  }

  double sin_lat_, cos_lat_, sin_lon_, cos_lon_;
  std::array<double, 3> centre_;  // the origin from the centre of the earth [m]
};

}  // namespace muster
