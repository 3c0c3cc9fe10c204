// Reference distances of two rows, pair by pair in double precision, for tests of the kernels.
#pragma once

#include <algorithm>
#include <cmath>

#include "diagnosis/inference/noise/row_distance.hpp"

namespace muster::noise {

struct Apart {
  double place, both;  // m: by place, and by place and anchor jointly
};

inline Apart middles_apart(const Sites& sites, Index one, Index other) {
  const double place = (sites.place.col(one) - sites.place.col(other)).squaredNorm();
  return {std::sqrt(place), std::sqrt(place + (sites.anchor.col(one) - sites.anchor.col(other)).squaredNorm())};
}

inline Apart readings_apart(const Sites& sites, Index one, Index other) {
  const Eigen::Vector3d place = sites.place.col(one) - sites.place.col(other);
  const Eigen::Vector3d anchor = sites.anchor.col(one) - sites.anchor.col(other);
  double near = 0, joint = 0;
  for (int a = -1; a <= 1; ++a) {
    for (int b = -1; b <= 1; ++b) {
      const double square =
          (place + a * sites.place_stretch.col(one) - b * sites.place_stretch.col(other)).squaredNorm();
      near += std::sqrt(square) / 9;
      joint +=
          std::sqrt(square +
                    (anchor + a * sites.anchor_stretch.col(one) - b * sites.anchor_stretch.col(other)).squaredNorm()) /
          9;
    }
  }
  const auto of_place = [&](Index i) { return sites.place_stretch.col(i).norm(); };
  const auto of_both = [&](Index i) { return std::hypot(of_place(i), sites.anchor_stretch.col(i).norm()); };
  return {std::max(0.0, near - own_share * (of_place(one) + of_place(other))),
          std::max(0.0, joint - own_share * (of_both(one) + of_both(other)))};
}

}  // namespace muster::noise
