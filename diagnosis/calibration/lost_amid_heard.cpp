#include "diagnosis/calibration/lost_amid_heard.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;

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

}  // namespace

std::vector<Index> lost_amid_heard(const Readings& readings, const std::vector<LinkPlace>& links,
                                   const Eigen::VectorXd& mean, double sigma) {
  std::map<std::pair<int, int>, std::vector<Index>> of_link;
  for (Index i = 0; i < readings.rssi.size(); ++i) {
    const LinkPlace& link = links[static_cast<std::size_t>(i)];
    of_link[{link.radio_a, link.radio_b}].push_back(i);
  }
  std::vector<Index> result;
  for (const auto& [link, rows] : of_link) {
    for (std::size_t at = 0; at < rows.size(); ++at) {
      const Index row = rows[at];
      if (!std::isnan(readings.rssi[row])) continue;
      const std::vector<Index> near = nearest(at, rows, links);
      if (near.size() < thresholds::neighbours_of_a_loss) continue;
      double error = 0, heard = 0;
      for (const Index other : near) {
        if (std::isnan(readings.rssi[other])) continue;
        error += readings.rssi[other] - mean[other];
        heard += 1;
      }
      const bool others_heard = heard >= static_cast<double>(near.size()) - 1;
      if (others_heard && mean[row] + error / heard - readings.floor_of(row) > thresholds::far_above_floor * sigma)
        result.push_back(row);
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace muster::diagnosis
