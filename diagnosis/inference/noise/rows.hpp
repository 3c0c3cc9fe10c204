// Readings of one link that lie close together, averaged to one row: a row's mean carries the small-scale fading of its
// readings divided by their count, and costs one place in the covariance instead of many.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace muster::noise {

using Eigen::Index;

struct Readings {
  std::vector<double> t;          // s; empty: readings of a link stand in the order of their time
  std::vector<int> tx, rx;        // radios, by numbers that do not depend on the order of the readings
  Eigen::Matrix3Xd tx_at, rx_at;  // m
  std::vector<double> rx_yaw;     // rad; empty: unknown
  std::vector<double> tx_yaw;     // the same of the transmitter
  std::vector<double> level;      // dB that a model expects; empty: unknown

  Index size() const { return static_cast<Index>(tx.size()); }
};

// A row ends where the next reading lies so far from its first one.
struct RowLimits {
  double time = 1.2;     // s
  double turn = 0.6109;  // rad, 35 degrees
  double way = 1.0;      // m, of either end
  double level = 1.5;    // dB: what a wall does to a link is not averaged with what it is without
};

// Of three readings, each a stretch from the next: the mean distance of two, of a stretch.
constexpr double mean_of_three = 8.0 / 9;

// Where the rows' field lives: `place` is the end that moves more, `anchor` the other one, the same for both directions
// of a pair. A row is seen as three readings of the same weight, in its middle and a stretch to either side of that,
// which lie as far apart in the mean as its own do.
struct Sites {
  Eigen::Matrix3Xd place, anchor;                  // m, in the mean
  Eigen::Matrix3Xd place_stretch, anchor_stretch;  // m
  std::vector<int> radio;                          // the anchor's
  Eigen::VectorXd count;                           // readings

  Index size() const { return count.size(); }
  double within() const;  // m: the mean distance of two readings of a row
  Sites of(const std::vector<Index>& rows) const;
  // These rows, then those of `more`.
  Sites with(const Sites& more) const;
};

class Rows {
 public:
  explicit Rows(const Readings& readings, const RowLimits& limits = {});

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

  // Means of columns that have one row a reading.
  Eigen::MatrixXd mean(const Eigen::Ref<const Eigen::MatrixXd>& columns) const;
  // A value a row, at each of its readings.
  Eigen::VectorXd at_readings(const Eigen::VectorXd& rows) const;

  Sites sites(const Readings& readings) const;
  // The reading in the middle of each row.
  Readings middles(const Readings& readings) const;

 private:
  void count_readings();

  std::vector<Index> order_;  // readings by link, then time
  std::vector<Index> first_;  // in order_; one past the last row too
  std::vector<Index> row_of_;
  Eigen::VectorXd count_;
  std::vector<Index> by_count_;  // rows in the order of how many readings they have: one loop is as long as the next
};

// What suits a search. A wall that no map has shows best in short rows, down to single readings, while each row costs
// time: they are as short as 4,000 rows allow. Of many readings they are longer than usual, up to four times where
// there would be more than 10,000, and not for time's sake alone: each row is conditioned on so many near ones, and
// where these lie dense nothing of them tells how far the field reaches.
RowLimits limits_for(const Readings& readings);

}  // namespace muster::noise
