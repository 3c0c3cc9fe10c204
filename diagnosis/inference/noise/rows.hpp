// Averages neighbouring readings of one group to rows. A row's mean carries its readings' variance divided by their
// count, and takes one row of the covariance instead of many.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace muster::noise {

using Eigen::Index;

class StatedCorrelation;

// Mean distance of two of three readings a stretch apart, in stretches.
constexpr double mean_of_three = 8.0 / 9;

// Sites of the rows, between which errors are correlated: a place, and an anchor that may move too. The anchor is
// zero where a site is one place or one time. Rows of one group share a field; rows of different groups share a part
// of it. A row counts as three readings of equal weight: its middle, and a stretch to either side. The stretch keeps
// the mean distance of its own readings.
struct Sites {
  Eigen::Matrix3Xd place, anchor;                     // means, in the units of the decorrelation distance
  Eigen::Matrix3Xd place_stretch, anchor_stretch;     // the same units
  std::vector<int> group;                             // the anchor's
  Eigen::VectorXd count;                              // readings
  std::shared_ptr<const StatedCorrelation> stated{};  // correlation of the model's own draws, if it states one
  std::vector<int> stream{};                          // of rows at one site; empty: one

  Index size() const { return count.size(); }
  double within() const;  // the mean distance of two readings of a row
  Sites of(const std::vector<Index>& rows) const;
  // These sites, then those of `more`.
  Sites with(const Sites& more) const;
};

class Rows {
 public:
  // `order`: all readings, row by row; `first`: where each row begins in it, and one past the last.
  Rows(std::vector<Index> order, std::vector<Index> first);

  Index size() const { return static_cast<Index>(first_.size()) - 1; }
  const std::vector<Index>& row_of() const { return row_of_; }  // one a reading
  // A reading of the row, for values that all its readings share.
  Index example(Index row) const { return order_[static_cast<std::size_t>(first_[static_cast<std::size_t>(row)])]; }
  // The row's middle reading.
  Index middle(Index row) const {
    const auto k = static_cast<std::size_t>(row);
    return order_[static_cast<std::size_t>((first_[k] + first_[k + 1] - 1) / 2)];
  }
  const Eigen::VectorXd& count() const { return count_; }
  const std::vector<Index>& in_order() const { return order_; }  // readings, row by row

  // Splits rows where an effect, one value a reading, differs by more than `step` from the row's first reading.
  // `parent`: the old row of each new one.
  Rows ended_where(const Eigen::VectorXd& effect, double step, std::vector<Index>& parent) const;

  // The row's last reading.
  Index last(Index row) const {
    return order_[static_cast<std::size_t>(first_[static_cast<std::size_t>(row) + 1] - 1)];
  }

  // Means of columns that have one row a reading.
  Eigen::MatrixXd mean(const Eigen::Ref<const Eigen::MatrixXd>& columns) const;
  // One value a row, repeated at each of its readings.
  Eigen::VectorXd at_readings(const Eigen::VectorXd& rows) const;

 private:
  void count_readings();

  std::vector<Index> order_;  // readings, row by row
  std::vector<Index> first_;  // in order_; one past the last row too
  std::vector<Index> row_of_;
  Eigen::VectorXd count_;
  std::vector<Index> by_count_;  // rows sorted by count: successive loops have equal length
};

}  // namespace muster::noise
