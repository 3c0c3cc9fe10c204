// Neighbouring readings of one group, averaged to one row. A row's mean carries its readings' own scatter divided by
// their count, and costs one place in the covariance instead of many.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace muster::noise {

using Eigen::Index;

// Of three readings, each a stretch from the next: the mean distance of two, of a stretch.
constexpr double mean_of_three = 8.0 / 9;

// Sites of the rows, between which errors are correlated: a place, and an anchor that may move too (zero where a site
// is one place or one time). Rows of one group share a field; rows of others share a part of it. A row counts as three
// readings of equal weight, in its middle and a stretch to either side, as far apart in the mean as its own are.
struct Sites {
  Eigen::Matrix3Xd place, anchor;                  // means, in the units of the decorrelation distance
  Eigen::Matrix3Xd place_stretch, anchor_stretch;  // the same units
  std::vector<int> group;                          // the anchor's
  Eigen::VectorXd count;                           // readings

  Index size() const { return count.size(); }
  double within() const;  // the mean distance of two readings of a row
  Sites of(const std::vector<Index>& rows) const;
  // These rows, then those of `more`.
  Sites with(const Sites& more) const;
};

class Rows {
 public:
  // `order`: all readings, row by row; `first`: where each row begins in it, and one past the last.
  Rows(std::vector<Index> order, std::vector<Index> first);

  Index size() const { return static_cast<Index>(first_.size()) - 1; }
  const std::vector<Index>& row_of() const { return row_of_; }  // one a reading
  // A reading of each row: what its readings share can be read there.
  Index example(Index row) const { return order_[static_cast<std::size_t>(first_[static_cast<std::size_t>(row)])]; }
  // The one in its middle.
  Index middle(Index row) const {
    const auto k = static_cast<std::size_t>(row);
    return order_[static_cast<std::size_t>((first_[k] + first_[k + 1] - 1) / 2)];
  }
  const Eigen::VectorXd& count() const { return count_; }
  const std::vector<Index>& in_order() const { return order_; }  // readings, row by row

  // The same rows, but for those within which an effect, one value a reading, changes by more than `step` from the
  // first reading on: they end there. `parent`: of each new row, the one that it was in.
  Rows ended_where(const Eigen::VectorXd& effect, double step, std::vector<Index>& parent) const;

  // The reading that ends each row.
  Index last(Index row) const {
    return order_[static_cast<std::size_t>(first_[static_cast<std::size_t>(row) + 1] - 1)];
  }

  // Means of columns that have one row a reading.
  Eigen::MatrixXd mean(const Eigen::Ref<const Eigen::MatrixXd>& columns) const;
  // A value a row, at each of its readings.
  Eigen::VectorXd at_readings(const Eigen::VectorXd& rows) const;

 private:
  void count_readings();

  std::vector<Index> order_;  // readings, row by row
  std::vector<Index> first_;  // in order_; one past the last row too
  std::vector<Index> row_of_;
  Eigen::VectorXd count_;
  std::vector<Index> by_count_;  // rows in the order of how many readings they have: one loop is as long as the next
};

}  // namespace muster::noise
