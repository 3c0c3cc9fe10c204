#include "diagnosis/inference/noise/rows.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace muster::noise {
namespace {

std::vector<Index> by_link_and_time(const Readings& readings) {
  std::vector<Index> order(readings.tx.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](Index i) {
    const auto k = static_cast<std::size_t>(i);
    return std::tuple(readings.tx[k], readings.rx[k], readings.t.empty() ? 0.0 : readings.t[k]);
  };
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return key(a) < key(b); });
  return order;
}

bool ends_row(const Readings& r, const RowLimits& limits, Index first, Index next) {
  const auto a = static_cast<std::size_t>(first), b = static_cast<std::size_t>(next);
  if (r.tx[a] != r.tx[b] || r.rx[a] != r.rx[b]) return true;
  if (!r.t.empty() && r.t[b] - r.t[a] >= limits.time) return true;
  for (const std::vector<double>* yaw : {&r.rx_yaw, &r.tx_yaw}) {
    if (!yaw->empty() && std::abs(std::remainder((*yaw)[b] - (*yaw)[a], 2 * M_PI)) > limits.turn) return true;
  }
  if (!r.level.empty() && std::abs(r.level[b] - r.level[a]) > limits.level) return true;
  return (r.rx_at.col(next) - r.rx_at.col(first)).norm() > limits.way ||
         (r.tx_at.col(next) - r.tx_at.col(first)).norm() > limits.way;
}

// How far the radios of each pair went. What shadows a link shadows its return, so both directions have one anchor: the
// radio that moved less. Where neither did, it is that end of a lone direction that moves less in all.
class Ways {
 public:
  void add(int tx, int rx, double tx_way, double rx_way) {
    Pair& pair = of_[std::minmax(tx, rx)];
    (tx < rx ? pair.low : pair.high) += tx_way;
    (tx < rx ? pair.high : pair.low) += rx_way;
    (tx < rx ? pair.up : pair.down) = true;
    by_tx_ += tx_way;
    by_rx_ += rx_way;
  }

  int anchor_of(int tx, int rx) const {
    const auto found = of_.find(std::minmax(tx, rx));
    const Pair pair = found == of_.end() ? Pair{} : found->second;
    if (pair.low == pair.high && !(pair.up && pair.down)) return by_tx_ <= by_rx_ ? tx : rx;
    return pair.low <= pair.high ? std::min(tx, rx) : std::max(tx, rx);
  }

 private:
  struct Pair {
    double low = 0, high = 0;       // m, of the radio with the lower number and of the other
    bool up = false, down = false;  // whether the lower transmits, and the other
  };
  std::map<std::pair<int, int>, Pair> of_;
  double by_tx_ = 0, by_rx_ = 0;  // m, of all
};

}  // namespace

Rows::Rows(const Readings& readings, const RowLimits& limits)
    : order_(by_link_and_time(readings)), row_of_(order_.size()) {
  for (std::size_t k = 0; k < order_.size(); ++k) {
    if (k == 0 || ends_row(readings, limits, order_[static_cast<std::size_t>(first_.back())], order_[k]))
      first_.push_back(static_cast<Index>(k));
  }
  first_.push_back(static_cast<Index>(order_.size()));
  count_readings();
}

void Rows::count_readings() {
  count_.resize(size());
  for (Index i = 0; i < size(); ++i)
    count_[i] = static_cast<double>(first_[static_cast<std::size_t>(i) + 1] - first_[static_cast<std::size_t>(i)]);
  for (Index i = 0; i < size(); ++i) {
    for (Index k = first_[static_cast<std::size_t>(i)]; k < first_[static_cast<std::size_t>(i) + 1]; ++k)
      row_of_[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])] = i;
  }
  by_count_.resize(static_cast<std::size_t>(size()));
  std::iota(by_count_.begin(), by_count_.end(), 0);
  std::stable_sort(by_count_.begin(), by_count_.end(), [this](Index a, Index b) { return count_[a] < count_[b]; });
}

Rows Rows::ended_where(const Eigen::VectorXd& effect, double step, std::vector<Index>& parent) const {
  Rows result = *this;
  result.first_.clear();
  parent.clear();
  const auto at = [&](Index k) { return effect[order_[static_cast<std::size_t>(k)]]; };
  for (Index i = 0; i < size(); ++i) {
    Index first = first_[static_cast<std::size_t>(i)];
    result.first_.push_back(first);
    parent.push_back(i);
    for (Index k = first + 1; k < first_[static_cast<std::size_t>(i) + 1]; ++k) {
      if (std::abs(at(k) - at(first)) <= step) continue;
      first = k;
      result.first_.push_back(k);
      parent.push_back(i);
    }
  }
  result.first_.push_back(first_.back());
  result.count_readings();
  return result;
}

Eigen::MatrixXd Rows::mean(const Eigen::Ref<const Eigen::MatrixXd>& columns) const {
  Eigen::MatrixXd result(size(), columns.cols());
  for (Index j = 0; j < columns.cols(); ++j) {
    for (const Index i : by_count_) {
      double sum = 0;
      for (Index k = first_[static_cast<std::size_t>(i)]; k < first_[static_cast<std::size_t>(i) + 1]; ++k)
        sum += columns(order_[static_cast<std::size_t>(k)], j);
      result(i, j) = sum / count_[i];
    }
  }
  return result;
}

Eigen::VectorXd Rows::at_readings(const Eigen::VectorXd& rows) const {
  Eigen::VectorXd result(static_cast<Index>(row_of_.size()));
  for (Index k = 0; k < result.size(); ++k) result[k] = rows[row_of_[static_cast<std::size_t>(k)]];
  return result;
}

Sites Rows::sites(const Readings& readings) const {
  const Eigen::Matrix3Xd tx = mean(readings.tx_at.transpose()).transpose();
  const Eigen::Matrix3Xd rx = mean(readings.rx_at.transpose()).transpose();
  Ways ways;
  Eigen::Matrix3Xd tx_stretch(3, size()), rx_stretch(3, size());
  for (Index i = 0; i < size(); ++i) {
    const Index a = example(i), b = order_[static_cast<std::size_t>(first_[static_cast<std::size_t>(i) + 1] - 1)];
    const double share = (count_[i] + 1) / (3 * count_[i]) / mean_of_three;  // of its way, if evenly along a line
    tx_stretch.col(i) = share * (readings.tx_at.col(b) - readings.tx_at.col(a));
    rx_stretch.col(i) = share * (readings.rx_at.col(b) - readings.rx_at.col(a));
    const std::size_t link = static_cast<std::size_t>(a);
    const bool goes_on = i > 0 && readings.tx[link] == readings.tx[static_cast<std::size_t>(example(i - 1))] &&
                         readings.rx[link] == readings.rx[static_cast<std::size_t>(example(i - 1))];
    if (goes_on)
      ways.add(readings.tx[link], readings.rx[link], (tx.col(i) - tx.col(i - 1)).norm(),
               (rx.col(i) - rx.col(i - 1)).norm());
  }
  Sites sites{rx, tx, rx_stretch, tx_stretch, {}, count_};
  for (Index i = 0; i < size(); ++i) {
    const auto link = static_cast<std::size_t>(example(i));
    const bool anchored_at_tx = ways.anchor_of(readings.tx[link], readings.rx[link]) == readings.tx[link];
    if (!anchored_at_tx) {
      sites.place.col(i) = tx.col(i);
      sites.anchor.col(i) = rx.col(i);
      sites.place_stretch.col(i) = tx_stretch.col(i);
      sites.anchor_stretch.col(i) = rx_stretch.col(i);
    }
    sites.radio.push_back(anchored_at_tx ? readings.tx[link] : readings.rx[link]);
  }
  return sites;
}

Readings Rows::middles(const Readings& readings) const {
  Readings result;
  result.tx_at.resize(3, size());
  result.rx_at.resize(3, size());
  for (Index i = 0; i < size(); ++i) {
    const auto k = static_cast<std::size_t>(middle(i));
    result.tx.push_back(readings.tx[k]);
    result.rx.push_back(readings.rx[k]);
    result.tx_at.col(i) = readings.tx_at.col(middle(i));
    result.rx_at.col(i) = readings.rx_at.col(middle(i));
    if (!readings.t.empty()) result.t.push_back(readings.t[k]);
    if (!readings.rx_yaw.empty()) result.rx_yaw.push_back(readings.rx_yaw[k]);
    if (!readings.tx_yaw.empty()) result.tx_yaw.push_back(readings.tx_yaw[k]);
    if (!readings.level.empty()) result.level.push_back(readings.level[k]);
  }
  return result;
}

double Sites::within() const {
  if (size() == 0) return 0;
  return mean_of_three *
         (place_stretch.colwise().squaredNorm() + anchor_stretch.colwise().squaredNorm()).cwiseSqrt().mean();
}

Sites Sites::of(const std::vector<Index>& rows) const {
  Sites result{place(Eigen::all, rows),
               anchor(Eigen::all, rows),
               place_stretch(Eigen::all, rows),
               anchor_stretch(Eigen::all, rows),
               {},
               count(rows)};
  for (const Index i : rows) result.radio.push_back(radio[static_cast<std::size_t>(i)]);
  return result;
}

Sites Sites::with(const Sites& more) const {
  Sites result = *this;
  for (Eigen::Matrix3Xd Sites::*columns :
       {&Sites::place, &Sites::anchor, &Sites::place_stretch, &Sites::anchor_stretch}) {
    (result.*columns).conservativeResize(3, size() + more.size());
    (result.*columns).rightCols(more.size()) = more.*columns;
  }
  result.count.conservativeResize(size() + more.size());
  result.count.tail(more.size()) = more.count;
  result.radio.insert(result.radio.end(), more.radio.begin(), more.radio.end());
  return result;
}

RowLimits limits_for(const Readings& readings) {
  constexpr Index few = 4000, many = 10000;
  RowLimits limits;
  for (const double share : {0.0, 0.25, 0.5, 1.0, 2.0, 4.0}) {
    limits = {};
    limits.time *= share;
    limits.way *= share;
    if (Rows(readings, limits).size() <= (share < 1 ? few : many)) break;
  }
  return limits;
}

}  // namespace muster::noise
