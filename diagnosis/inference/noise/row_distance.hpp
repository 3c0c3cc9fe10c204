// How far apart two rows lie for the field.
//
// A smooth field changes by hardly more along a row than its middle tells, so that its rows are as far apart as their
// middles. Of a rough one it is the mean distance of their readings, less half of what each has within: of a field with
// correlation exp(-h), means over the rows are correlated by exp of minus this, up to a factor for each row. It is of
// negative type, as distances are, so that this is a correlation whatever way the rows run (Schoenberg 1938). A row's
// readings are taken as three, a stretch away from its middle to either side and there.
#pragma once

#include "diagnosis/inference/noise/row_kernel.hpp"
#include "diagnosis/inference/noise/rows.hpp"

namespace muster::noise {

constexpr double own_share = mean_of_three / 2;  // of its stretch: half the mean distance of a row's three readings

// Whether any anchor is elsewhere than others of its group.
bool anchors_move(const Sites& sites);

// A row a site, m: its place and its anchor, the stretches of both, and half the mean distance of its readings, of
// places and of both ends. About the first site, so that floats tell them well.
using SiteFloats = Eigen::Matrix<float, Eigen::Dynamic, 14, Eigen::RowMajor>;
SiteFloats floats_of(const Sites& sites);

// Some of them as the kernels ask for them.
class PlacedSites {
 public:
  explicit PlacedSites(Index most) : values_(Eigen::MatrixXf::Zero((most + many - 1) / many * many, 14)) {}

  Index filled() const { return values_.rows(); }
  void set(Index site, const Eigen::Matrix<float, 1, 14>& values) { values_.row(site) = values; }
  // Valid for as long as this is. `by_readings`: or else by their middles, as those that lie farther apart than `far`.
  Places places(bool by_readings, bool anchors_move, float far) const;
  float longest_within() const { return values_.col(13).maxCoeff(); }

 private:
  Eigen::MatrixXf values_;
};

}  // namespace muster::noise
