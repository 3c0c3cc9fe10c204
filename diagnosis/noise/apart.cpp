#include "diagnosis/noise/apart.hpp"

#include <algorithm>
#include <cmath>

namespace muster::noise {

Apart middles_apart(const Sites& sites, Index one, Index other) {
  const double place = (sites.place.col(one) - sites.place.col(other)).squaredNorm();
  return {std::sqrt(place), std::sqrt(place + (sites.anchor.col(one) - sites.anchor.col(other)).squaredNorm())};
}

Apart readings_apart(const Sites& sites, Index one, Index other) {
  const Eigen::Vector3d place = sites.place.col(one) - sites.place.col(other);
  const Eigen::Vector3d anchor = sites.anchor.col(one) - sites.anchor.col(other);
  const auto place_one = sites.place_stretch.col(one), place_other = sites.place_stretch.col(other);
  const auto anchor_one = sites.anchor_stretch.col(one), anchor_other = sites.anchor_stretch.col(other);
  const bool anchors_stand = anchor.isZero(0) && anchor_one.isZero(0) && anchor_other.isZero(0);
  double near = 0, joint = 0;
  for (int a = -1; a <= 1; ++a) {
    for (int b = -1; b <= 1; ++b) {
      const double square = (place + a * place_one - b * place_other).squaredNorm();
      near += std::sqrt(square) / 9;
      if (!anchors_stand) joint += std::sqrt(square + (anchor + a * anchor_one - b * anchor_other).squaredNorm()) / 9;
    }
  }
  const double one_place = place_one.norm(), other_place = place_other.norm();
  const double places = std::max(0.0, near - own_share * (one_place + other_place));
  if (anchors_stand) return {places, places};
  const double one_both = std::hypot(one_place, anchor_one.norm()),
               other_both = std::hypot(other_place, anchor_other.norm());
  return {places, std::max(0.0, joint - own_share * (one_both + other_both))};
}

}  // namespace muster::noise
