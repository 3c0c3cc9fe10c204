#include <cmath>

#include "description/robot.hpp"

namespace muster::description {

using Eigen::Vector3d;

double LegDrive::track() const {
  double left = 0, right = 0;
  for (const Leg& leg : legs) (leg.hip.y() > 0 ? left : right) += leg.hip.y() / 3;
  return left - right;
}

Vector3d LegDrive::place(double angle, double way) const {
  const double x = -radius * std::sin(way), z = radius * (std::cos(way) - 1);
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * x + s * z, 0, c * z - s * x};
}

// The direction from the circle's middle to its lowest point, if that is in the leg's half.
double LegDrive::lowest_way(double angle, const Vector3d& up) {
  constexpr double pi = 3.141592653589793;
  const double c = std::cos(angle), s = std::sin(angle);
  const double ahead = c * up.x() - s * up.z(), above = s * up.x() + c * up.z();  // rise of the leg's axes
  return ahead > 0 ? std::atan2(ahead, -above) : above > 0 ? pi : 0;
}

}  // namespace muster::description
