// Distance of two rows for the covariance of the field.
//
// A smooth field is nearly linear along a row, so the distance is that of the rows' middles. For a rough field it is
// the mean distance of their readings, less half the mean distance within each row. With correlation exp(-h), means
// over rows are correlated by exp of minus this, up to a factor for each row. This distance is of negative type, so
// the result is a valid correlation for all directions of rows (Schoenberg 1938). A row's readings are taken as
// three: its middle, and a stretch away to either side.
#pragma once

#include "diagnosis/inference/noise/row_kernel.hpp"
#include "diagnosis/inference/noise/rows.hpp"

namespace muster::noise {

constexpr double own_share = mean_of_three / 2;  // half the mean distance of a row's three readings, in stretches

// True if an anchor moves, or differs from another of its group.
bool anchors_move(const Sites& sites);

// One row a site, m: place, anchor, their stretches, and half the mean distance of its readings by place and by place
// and anchor jointly. Relative to the first site, for float precision.
using SiteFloats = Eigen::Matrix<float, Eigen::Dynamic, 14, Eigen::RowMajor>;
SiteFloats floats_of(const Sites& sites);

// Sites in the kernel's layout.
class PlacedSites {
 public:
  explicit PlacedSites(Index most) : values_(Eigen::MatrixXf::Zero((most + many - 1) / many * many, 14)) {}

  Index filled() const { return values_.rows(); }
  void set(Index site, const Eigen::Matrix<float, 1, 14>& values) { values_.row(site) = values; }
  // Valid as long as this object. `by_readings`: mean distance of readings; otherwise, and beyond `far`, of middles.
  Places places(bool by_readings, bool anchors_move, float far) const;
  float longest_within() const { return values_.col(13).maxCoeff(); }

 private:
  Eigen::MatrixXf values_;
};

}  // namespace muster::noise
