#include "diagnosis/calibration/lost_amid_heard.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// The nearest rows of the link by the way of both ends, of those that stand next to it in the log.
std::vector<Index> nearest(std::size_t at, const std::vector<Index>& of_link, const std::vector<LinkPlace>& links) {
  constexpr std::size_t reach = 32;  // rows of the link
  const auto way = [&](Index other) {
    const LinkPlace &a = links[static_cast<std::size_t>(of_link[at])], &b = links[static_cast<std::size_t>(other)];
    return (a.a - b.a).norm() + (a.b - b.b).norm();
  };
  std::vector<std::tuple<double, std::size_t, Index>> near;  // way, rows between, row
  for (std::size_t k = at - std::min(at, reach); k < std::min(at + reach + 1, of_link.size()); ++k) {
    if (k != at && way(of_link[k]) < thresholds::beside_a_loss)
      near.emplace_back(way(of_link[k]), k < at ? at - k : k - at, of_link[k]);
  }
  std::sort(near.begin(), near.end());
  std::vector<Index> result;
  for (std::size_t k = 0; k < std::min(near.size(), thresholds::neighbours_of_a_loss); ++k)
    result.push_back(std::get<2>(near[k]));
  return result;
}

// What the neighbours of a row are above what is expected of them, dB, on average over those that are heard.
struct Neighbours {
  double error = 0, heard = 0;

  void add(Index row, const Readings& readings, const VectorXd& mean) {
    if (std::isnan(readings.rssi[row])) return;
    error += readings.rssi[row] - mean[row];
    heard += 1;
  }
};

class Losses {
 public:
  Losses(const Readings& readings, const std::vector<LinkPlace>& links, const std::vector<double>& t,
         const VectorXd& mean, double sigma)
      : readings_(readings),
        links_(links),
        mean_(mean),
        reach_(thresholds::far_above_floor * sigma),
        has_times_(!t.empty()),
        order_(links.size()) {
    std::iota(order_.begin(), order_.end(), Index{0});
    if (!t.empty())
      std::stable_sort(order_.begin(), order_.end(), [&](Index a, Index b) {
        return t[static_cast<std::size_t>(a)] < t[static_cast<std::size_t>(b)];
      });
    for (const Index row : order_) of_link_[link_of(row)].push_back(row);
  }

  std::vector<Index> of_single_readings() const {
    std::vector<Index> result;
    for (const auto& [link, rows] : of_link_) {
      for (std::size_t at = 0; at < rows.size(); ++at) {
        if (!is_lost(rows[at])) continue;
        const std::vector<Index> near = nearest(at, rows, links_);
        if (near.size() < thresholds::neighbours_of_a_loss) continue;
        Neighbours of;
        for (const Index other : near) of.add(other, readings_, mean_);
        if (of.heard >= static_cast<double>(near.size()) - 1 && is_far_above(rows[at], of)) result.push_back(rows[at]);
      }
    }
    return result;
  }

  // Stretches of time in which all links are silent.
  std::vector<Index> of_silences() const {
    std::vector<Index> result;
    if (!has_times_) return result;
    for (auto first = order_.begin(); first != order_.end();) {
      first = std::find_if(first, order_.end(), [&](Index row) { return is_lost(row); });
      const auto last = std::find_if(first, order_.end(), [&](Index row) { return !is_lost(row); });
      if (first != last && is_silence({first, last}) && no_other_beside(first, last))
        result.insert(result.end(), first, last);
      first = last;
    }
    return result;
  }

 private:
  using Link = std::pair<int, int>;

  Link link_of(Index row) const {
    const LinkPlace& link = links_[static_cast<std::size_t>(row)];
    return {link.radio_a, link.radio_b};
  }
  bool is_lost(Index row) const { return std::isnan(readings_.rssi[row]); }
  bool is_far_above(Index row, const Neighbours& of) const {
    return of.heard > 0 && mean_[row] + of.error / of.heard - readings_.floor_of(row) > reach_;
  }

  using Place = std::vector<Index>::const_iterator;

  // True if each link is lost that has one of as many rows before and after.
  bool no_other_beside(Place first, Place last) const {
    std::set<Link> lost;
    for (Place at = first; at != last; ++at) lost.insert(link_of(*at));
    const auto knows = [&](Index row) { return lost.count(link_of(row)) > 0; };
    const std::ptrdiff_t as_many = last - first;
    return std::all_of(first - std::min(as_many, first - order_.begin()), first, knows) &&
           std::all_of(last, last + std::min(as_many, order_.end() - last), knows);
  }

  // True if two links or more would be heard there, by what they are before and after.
  bool is_silence(const std::vector<Index>& lost) const {
    constexpr std::ptrdiff_t beside = 3;  // readings on either side
    std::map<Link, std::vector<Index>> of_each;
    for (const Index row : lost) of_each[link_of(row)].push_back(row);
    if (of_each.size() < 2) return false;
    std::size_t heard = 0, heard_links = 0;
    for (const auto& [link, rows] : of_each) {
      const std::vector<Index>& all = of_link_.at(link);
      const auto from = std::find(all.begin(), all.end(), rows.front()),
                 to = std::find(from, all.end(), rows.back()) + 1;
      Neighbours of;
      for (auto at = from - std::min(beside, from - all.begin()); at != from; ++at) of.add(*at, readings_, mean_);
      for (auto at = to; at != to + std::min(beside, all.end() - to); ++at) of.add(*at, readings_, mean_);
      const auto far = static_cast<std::size_t>(
          std::count_if(rows.begin(), rows.end(), [&](Index row) { return is_far_above(row, of); }));
      heard += far;
      heard_links += far > 0;
    }
    return heard_links > 1 && heard >= thresholds::fewest_of_a_silence;
  }

  const Readings& readings_;
  const std::vector<LinkPlace>& links_;
  const VectorXd& mean_;
  double reach_;
  bool has_times_;
  std::vector<Index> order_;  // rows in order of time
  std::map<Link, std::vector<Index>> of_link_;
};

}  // namespace

std::vector<Index> lost_amid_heard(const Readings& readings, const std::vector<LinkPlace>& links,
                                   const std::vector<double>& t, const VectorXd& mean, double sigma) {
  const Losses losses(readings, links, t, mean, sigma);
  std::vector<Index> result = losses.of_single_readings();
  const std::vector<Index> silent = losses.of_silences();
  result.insert(result.end(), silent.begin(), silent.end());
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace muster::diagnosis
