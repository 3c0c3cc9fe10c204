// Latitude, longitude and altitude as metres east, north and up of an origin: the local tangent plane of WGS 84.
#pragma once

#include <array>
#include <string>

namespace muster::diagnosis {

struct GeodeticPoint {
  double latitude = 0, longitude = 0;  // degrees
  double altitude = 0;                 // m above the ellipsoid
};

// For an error: the reason why it is no point of the globe; empty if it is one.
std::string why_no_point(const GeodeticPoint& point);

class TangentPlane {
 public:
  explicit TangentPlane(const GeodeticPoint& origin);
  const GeodeticPoint& origin() const { return origin_; }
  // m east, north and up. Up falls below the altitude by the curvature of the earth: 0.8 m at 3 km, 785 m at 100 km.
  std::array<double, 3> east_north_up(const GeodeticPoint& point) const;

 private:
  GeodeticPoint origin_;
  std::array<double, 3> centre_;  // the origin from the centre of the earth, m
};

}  // namespace muster::diagnosis
