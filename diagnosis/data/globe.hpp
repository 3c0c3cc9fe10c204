// Latitude, longitude and altitude of readings as metres east, north and up of an origin.
#pragma once

#include <array>
#include <muster/globe.hpp>
#include <string>

namespace muster::diagnosis {

using GeodeticPoint = GlobePoint;

// For an error: the reason why it is no point of the globe; empty if it is one.
std::string why_no_point(const GeodeticPoint& point);

class TangentPlane {
 public:
  explicit TangentPlane(const GeodeticPoint& origin) : origin_(origin), plane_(origin) {}
  const GeodeticPoint& origin() const { return origin_; }
  // m east, north and up. Up falls below the altitude by the curvature of the earth: 0.8 m at 3 km, 785 m at 100 km.
  std::array<double, 3> east_north_up(const GeodeticPoint& point) const { return plane_.east_north_up(point); }

 private:
  GeodeticPoint origin_;
  GlobePlane plane_;
};

}  // namespace muster::diagnosis
