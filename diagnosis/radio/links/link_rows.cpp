#include "diagnosis/radio/links/link_rows.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "diagnosis/data/median.hpp"
#include "diagnosis/radio/links/link_site.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using noise::Index;

Index twin_of(const LinkReadings& readings, Index reading) {
  return readings.twin.empty() ? -1 : readings.twin[static_cast<std::size_t>(reading)];
}

// Of twins the one that the radio of the lower number sent.
std::vector<Index> by_link_and_time(const LinkReadings& readings, double row_time) {
  std::vector<Index> order;
  for (Index i = 0; i < readings.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (twin_of(readings, i) < 0 || readings.tx[k] < readings.rx[k]) order.push_back(i);
  }
  const bool timed = !readings.t.empty(), several = !readings.setting.empty() && (!timed || row_time > 0);
  const auto key = [&](Index i) {
    const auto k = static_cast<std::size_t>(i);
    const double t = timed ? readings.t[k] : 0.0;
    return std::tuple(readings.tx[k], readings.rx[k], several && timed ? std::floor(t / row_time) : 0.0,
                      several ? readings.setting[k] : 0, t);
  };
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return key(a) < key(b); });
  return order;
}

bool ends_row(const LinkReadings& r, const LinkRowLimits& limits, Index first, Index next) {
  const auto a = static_cast<std::size_t>(first), b = static_cast<std::size_t>(next);
  if (r.tx[a] != r.tx[b] || r.rx[a] != r.rx[b]) return true;
  if ((twin_of(r, first) < 0) != (twin_of(r, next) < 0)) return true;
  if (!r.setting.empty() && r.setting[a] != r.setting[b]) return true;
  if (!r.t.empty() && r.t[b] - r.t[a] >= limits.time) return true;
  for (const std::vector<double>* yaw : {&r.rx_yaw, &r.tx_yaw}) {
    if (!yaw->empty() && std::abs(std::remainder((*yaw)[b] - (*yaw)[a], 2 * M_PI)) > limits.turn) return true;
  }
  if (!r.level.empty() && std::abs(r.level[b] - r.level[a]) > limits.level) return true;
  return (r.rx_at.col(next) - r.rx_at.col(first)).norm() > limits.way ||
         (r.tx_at.col(next) - r.tx_at.col(first)).norm() > limits.way;
}

// Path lengths of the radios of each pair. Both directions share their shadowing, so they share one anchor: the radio
// that moved less. A tie in a lone direction goes to the end that moves less over all links.
class WaysOfPairs {
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
    bool up = false, down = false;  // true if the lower transmits, and the other
  };
  std::map<std::pair<int, int>, Pair> of_;
  double by_tx_ = 0, by_rx_ = 0;  // m, of all
};

// Usual limits, unless each reading is a row or rows are already longer.
LinkRowLimits never_shorter(const LinkRowLimits& rows) {
  const LinkRowLimits usual;
  return rows.way < 0 || rows.way > usual.way ? rows : usual;
}

}  // namespace

noise::Rows link_rows(const LinkReadings& readings, const LinkRowLimits& limits) {
  std::vector<Index> order = by_link_and_time(readings, limits.time), first;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool full = k > 0 && readings.t.empty() && static_cast<Index>(k) - first.back() >= limits.untimed;
    if (k == 0 || full || ends_row(readings, limits, order[static_cast<std::size_t>(first.back())], order[k]))
      first.push_back(static_cast<Index>(k));
  }
  first.push_back(static_cast<Index>(order.size()));
  return {std::move(order), std::move(first), readings.twin};
}

noise::Sites link_sites(const noise::Rows& rows, const LinkReadings& readings) {
  const Eigen::Matrix3Xd tx = rows.by_stream(rows.mean(readings.tx_at.transpose())).transpose();
  const Eigen::Matrix3Xd rx = rows.by_stream(rows.mean(readings.rx_at.transpose())).transpose();
  WaysOfPairs ways;
  Eigen::Matrix3Xd tx_stretch(3, rows.size()), rx_stretch(3, rows.size());
  for (Index i = 0; i < rows.size(); ++i) {
    const Index a = rows.example(i), b = rows.last(i);
    const double share =
        (rows.count()[i] + 1) / (3 * rows.count()[i]) / noise::mean_of_three;  // of its path, if evenly along a line
    tx_stretch.col(i) = share * (readings.tx_at.col(b) - readings.tx_at.col(a));
    rx_stretch.col(i) = share * (readings.rx_at.col(b) - readings.rx_at.col(a));
    const std::size_t link = static_cast<std::size_t>(a);
    const bool goes_on = i > 0 && readings.tx[link] == readings.tx[static_cast<std::size_t>(rows.example(i - 1))] &&
                         readings.rx[link] == readings.rx[static_cast<std::size_t>(rows.example(i - 1))];
    if (goes_on)
      ways.add(readings.tx[link], readings.rx[link], (tx.col(i) - tx.col(i - 1)).norm(),
               (rx.col(i) - rx.col(i - 1)).norm());
  }
  noise::Sites sites{rx, tx, rx_stretch, tx_stretch, {}, rows.count()};
  for (Index i = 0; i < rows.size(); ++i) {
    const auto link = static_cast<std::size_t>(rows.example(i));
    const bool anchored_at_tx = ways.anchor_of(readings.tx[link], readings.rx[link]) == readings.tx[link];
    if (!anchored_at_tx) {
      sites.place.col(i) = tx.col(i);
      sites.anchor.col(i) = rx.col(i);
      sites.place_stretch.col(i) = tx_stretch.col(i);
      sites.anchor_stretch.col(i) = rx_stretch.col(i);
    }
    sites.stream.push_back(anchored_at_tx);
    sites.group.push_back(anchored_at_tx ? readings.tx[link] : readings.rx[link]);
    if (rows.means() < rows.size()) sites.alone.push_back(rows.is_difference(i) ? readings.twin_variance : 0);
  }
  return sites;
}

LinkReadings middles(const noise::Rows& rows, const LinkReadings& readings) {
  LinkReadings result;
  result.tx_at.resize(3, rows.size());
  result.rx_at.resize(3, rows.size());
  for (Index i = 0; i < rows.size(); ++i) {
    const auto k = static_cast<std::size_t>(rows.middle(i));
    result.tx.push_back(readings.tx[k]);
    result.rx.push_back(readings.rx[k]);
    result.tx_at.col(i) = readings.tx_at.col(rows.middle(i));
    result.rx_at.col(i) = readings.rx_at.col(rows.middle(i));
    if (!readings.t.empty()) result.t.push_back(readings.t[k]);
    if (!readings.rx_yaw.empty()) result.rx_yaw.push_back(readings.rx_yaw[k]);
    if (!readings.tx_yaw.empty()) result.tx_yaw.push_back(readings.tx_yaw[k]);
    if (!readings.level.empty()) result.level.push_back(readings.level[k]);
    if (!readings.setting.empty()) result.setting.push_back(readings.setting[k]);
  }
  return result;
}

LinkRowLimits limits_for(const LinkReadings& readings) {
  LinkRowLimits limits;
  for (const double share : {0.0, 0.25, 0.5, 1.0, 2.0, 4.0}) {
    limits = {};
    limits.time *= share;
    limits.way *= share;
    limits.untimed = std::max<Index>(1, std::lround(thresholds::untimed_row * share));
    if (link_rows(readings, limits).size() <= (share < 1 ? thresholds::short_rows : thresholds::usual_rows)) break;
  }
  return limits;
}

std::vector<int> radios_of(const noise::Rows& rows, const noise::Sites& sites, const LinkReadings& readings) {
  const bool one = std::all_of(sites.group.begin(), sites.group.end(), [&](int r) { return r == sites.group.front(); });
  if (!one) return inference::numbered(sites.group);
  std::vector<int> others;
  for (Index i = 0; i < rows.size(); ++i) {
    const auto reading = static_cast<std::size_t>(rows.example(i));
    others.push_back(readings.tx[reading] == sites.group.front() ? readings.rx[reading] : readings.tx[reading]);
  }
  return inference::numbered(others);
}

noise::Sites LinkLayout::sites(const noise::Rows& rows) const {
  noise::Sites result = link_sites(rows, readings_);
  result.stated = drawn_;
  return result;
}

noise::Rows LinkLayout::long_rows() const { return link_rows(readings_, never_shorter(limits_)); }

std::vector<double> LinkLayout::times(const noise::Rows& rows) const {
  std::vector<double> result;
  for (Index row = 0; row < rows.size() && !readings_.t.empty(); ++row)
    result.push_back(readings_.t[static_cast<std::size_t>(rows.example(row))]);
  return result;
}

std::vector<int> LinkLayout::parts_of_time(const noise::Rows& rows) const {
  if (readings_.t.empty()) return {};
  const std::vector<double> times = this->times(rows);
  const auto time = [&](Index row) { return times[static_cast<std::size_t>(row)]; };
  std::vector<Index> order(static_cast<std::size_t>(rows.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return time(a) < time(b); });
  std::vector<int> result(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    result[static_cast<std::size_t>(order[k])] = static_cast<int>(k * thresholds::parts_of_time / order.size());
  return result;
}

namespace {

// The number of each row whose readings have one, from 0; -1 of others, and of differences.
std::vector<int> of_whole_rows(const noise::Rows& rows, const std::vector<int>& of_reading) {
  constexpr int none = -1;
  std::map<int, int> number;
  std::vector<int> result(static_cast<std::size_t>(rows.size()), none);
  for (Index row = 0; row < rows.means(); ++row)
    result[static_cast<std::size_t>(row)] = of_reading[static_cast<std::size_t>(rows.example(row))];
  for (const Index reading : rows.in_order()) {
    int& of_row = result[static_cast<std::size_t>(rows.row_of()[static_cast<std::size_t>(reading)])];
    if (of_row != of_reading[static_cast<std::size_t>(reading)]) of_row = none;
  }
  for (int& of_row : result)
    if (of_row != none) of_row = number.try_emplace(of_row, static_cast<int>(number.size())).first->second;
  return result;
}

}  // namespace

std::vector<int> LinkLayout::stays(const noise::Rows& rows) const {
  if (readings_.t.empty()) return {};
  std::map<LinkSite, std::vector<std::pair<double, Index>>> at;  // times and readings
  for (const Index reading : rows.in_order())
    at[site_of(readings_, reading)].emplace_back(readings_.t[static_cast<std::size_t>(reading)], reading);
  std::vector<double> steps;
  for (auto& [site, visits] : at) {
    std::sort(visits.begin(), visits.end());
    for (std::size_t k = 1; k < visits.size(); ++k) {
      const double step = visits[k].first - visits[k - 1].first;
      if (step > 0) steps.push_back(step);  // a clock of whole seconds gives several readings one time
    }
  }
  const double pause = steps.empty() ? 0 : thresholds::pause_between_stays * median(std::move(steps));
  std::vector<int> of_reading(readings_.t.size());
  int stay = -1;
  for (const auto& [site, visits] : at) {
    for (std::size_t k = 0; k < visits.size(); ++k) {
      if (k == 0 || visits[k].first - visits[k - 1].first > pause) ++stay;
      of_reading[static_cast<std::size_t>(visits[k].second)] = stay;
    }
  }
  return of_whole_rows(rows, of_reading);
}

std::vector<inference::Grouping> LinkLayout::groupings(const noise::Rows& rows, const noise::Sites& sites) const {
  std::vector<inference::Grouping> result{{"radios", radios_of(rows, sites, readings_)}};
  if (run_.empty()) return result;
  result.push_back({"runs", {}});
  for (Index i = 0; i < rows.size(); ++i)
    result.back().of_row.push_back(run_[static_cast<std::size_t>(rows.example(i))]);
  return result;
}

}  // namespace muster::diagnosis
