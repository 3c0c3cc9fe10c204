// Averages neighbouring readings of one group to rows. A row's mean carries its readings' variance divided by their
// count, and takes one row of the covariance instead of many.
//
// Twins are two readings of one site and one moment, in its two streams, that share their scatter. Rows of twins come
// in pairs: one of means of twins, and one of half their differences, in which all that they share cancels.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

namespace muster::noise {

using Eigen::Index;

// As an index of a standard container.
inline std::size_t at(Index i) { return static_cast<std::size_t>(i); }

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
  // Variance of one reading [squared units] of a row that shares no field with others, and 0 of those that do. Empty:
  // all do.
  std::vector<double> alone{};
  // Where errors are correlated over time instead of over places, each series by itself: of each row its series, and
  // its moment in the units of the decorrelation distance. Empty: over places.
  std::vector<int> series{};
  std::vector<double> moment{};

  Index size() const { return count.size(); }
  bool is_alone(Index row) const { return !alone.empty() && alone[static_cast<std::size_t>(row)] > 0; }
  bool over_time() const { return !series.empty(); }
  double within() const;  // the mean distance of two readings of a row
  Sites of(const std::vector<Index>& rows) const;
  // These sites, then those of `more`.
  Sites with(const Sites& more) const;
};

class Rows {
 public:
  // `order`: all readings but second twins, row by row; `first`: where each row begins in it, and one past the last.
  // `twin`: of each reading its twin, or -1; empty: none has one. A row has twins only, or none.
  Rows(std::vector<Index> order, std::vector<Index> first, std::vector<Index> twin = {});

  // Rows of means, then those of differences.
  Index size() const { return means() + static_cast<Index>(mean_row_.size()); }
  Index means() const { return static_cast<Index>(first_.size()) - 1; }
  bool is_difference(Index row) const { return row >= means(); }
  const std::vector<Index>& with_twins() const { return mean_row_; }  // rows of means of twins
  bool is_second_twin(Index reading) const { return !second_.empty() && second_[static_cast<std::size_t>(reading)]; }
  const std::vector<Index>& row_of() const { return row_of_; }  // the row of means; one a reading
  // A reading of the row, for values that all its readings share. Of a row of differences: a second twin.
  Index example(Index row) const { return seen_by(row, first_of(row)); }
  // The row's middle reading.
  Index middle(Index row) const { return seen_by(row, (first_of(row) + end_of(row) - 1) / 2); }
  // Of a row of means readings, of one of differences pairs.
  const Eigen::VectorXd& count() const { return count_; }
  const std::vector<Index>& in_order() const { return order_; }  // readings but second twins, row by row

  // Splits rows where an effect, one value a reading, differs by more than `step` from the row's first reading.
  // `parent`: the old row of each new one.
  Rows ended_where(const Eigen::VectorXd& effect, double step, std::vector<Index>& parent) const;

  // The row's last reading.
  Index last(Index row) const { return seen_by(row, end_of(row) - 1); }

  // Means of columns that have one row a reading; of twins their mean, and half the first less the second.
  Eigen::MatrixXd mean(const Eigen::Ref<const Eigen::MatrixXd>& columns) const;
  // One value a row, repeated at each of its readings.
  Eigen::VectorXd at_readings(const Eigen::VectorXd& rows) const;
  // The same rows, but of the first twins and of the second ones instead of means and differences.
  Eigen::MatrixXd by_stream(Eigen::MatrixXd rows) const;
  // The inverse.
  Eigen::MatrixXd by_twins(Eigen::MatrixXd streams) const;

 private:
  void count_readings();
  Index mean_of(Index row) const {
    return is_difference(row) ? mean_row_[static_cast<std::size_t>(row - means())] : row;
  }
  Index first_of(Index row) const { return first_[static_cast<std::size_t>(mean_of(row))]; }
  Index end_of(Index row) const { return first_[static_cast<std::size_t>(mean_of(row)) + 1]; }
  Index seen_by(Index row, Index k) const {
    return (is_difference(row) ? twins_ : order_)[static_cast<std::size_t>(k)];
  }

  std::vector<Index> order_;     // readings but second twins, row by row
  std::vector<Index> twins_;     // of these, themselves without one; empty: there are none
  std::vector<char> second_;     // of each reading: it is a second twin; empty: there are none
  std::vector<Index> first_;     // in order_; one past the last row too
  std::vector<Index> mean_row_;  // of each row of differences
  std::vector<Index> row_of_;
  Eigen::VectorXd count_;
  std::vector<Index> by_count_;  // rows of means sorted by count: successive loops have equal length
};

}  // namespace muster::noise
