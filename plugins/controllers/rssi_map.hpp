// A table of rssi over places, and what a way costs where it is weak.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <muster/plugin.hpp>
#include <utility>
#include <vector>

#include "roadmap/obstacles.hpp"

namespace muster {

struct RssiPlace {
  double x, y, rssi;  // [m], [dBm]; null where nothing was received
};

class RssiMap {
 public:
  RssiMap() = default;
  template <class Places>
  explicit RssiMap(const Places& places) : places_(places.begin(), places.end()) {
    for (std::size_t i = 0; i < places_.size(); ++i) cells_[cell_of(places_[i].x, places_[i].y)].push_back(i);
  }

  bool any_received() const {
    return std::any_of(places_.begin(), places_.end(), [](const RssiPlace& p) { return !is_null(p.rssi); });
  }

  // Of the place of the table that is nearest.
  double at(const roadmap::Point& p) const {
    const Cell middle = cell_of(p.x, p.y);
    double best = std::numeric_limits<double>::infinity(), rssi = null();
    // In ring n no place is nearer than n - 1 edges of a cell.
    for (double ring = 0; (ring - 1) * edge < best; ++ring) {
      if (4 * ring * ring > static_cast<double>(cells_.size())) return of_all(p);  // fewer than the rings have by now
      for (double x = -ring; x <= ring; ++x) {
        const double stride = std::abs(x) == ring || ring == 0 ? 1 : 2 * ring;
        for (double y = -ring; y <= ring; y += stride) {
          const auto found = cells_.find({middle.first + x, middle.second + y});
          if (found == cells_.end()) continue;
          for (const std::size_t i : found->second) {
            const double away = std::hypot(places_[i].x - p.x, places_[i].y - p.y);
            if (away < best) best = away, rssi = places_[i].rssi;
          }
        }
      }
    }
    return rssi;
  }

  // Length of a straight piece, each metre of it counted 1 + weight for each dB below the threshold; where nothing is
  // received, as for `silent` dB below.
  double cost(const roadmap::Point& a, const roadmap::Point& b, double threshold, double weight) const {
    constexpr double between = 0.25, silent = 40;  // [m], [dB]
    const double length = distance(a, b);
    const auto parts = static_cast<std::size_t>(std::max(1.0, std::ceil(length / between)));
    double sum = 0;
    for (std::size_t i = 0; i < parts; ++i) {
      // From the middle of one part to the next, in the order of coordinates: the same both ways, bit for bit.
      const bool turned = std::pair{b.x, b.y} < std::pair{a.x, a.y};
      const roadmap::Point &p = turned ? b : a, &q = turned ? a : b;
      const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(parts);
      const double rssi = at({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
      sum += 1 + weight * (is_null(rssi) ? silent : std::clamp(threshold - rssi, 0.0, silent));
    }
    return length * sum / static_cast<double>(parts);
  }

 private:
  using Cell = std::pair<double, double>;
  static constexpr double edge = 1;  // [m] of a cell of places
  static Cell cell_of(double x, double y) { return {std::floor(x / edge), std::floor(y / edge)}; }

  // The same place as ring by ring, also of those equally far: the one of the inner ring, then by the order of cells.
  double of_all(const roadmap::Point& p) const {
    const Cell middle = cell_of(p.x, p.y);
    double best = std::numeric_limits<double>::infinity(), inner = best, rssi = null();
    for (const auto& [cell, inside] : cells_) {
      const double ring = std::max(std::abs(cell.first - middle.first), std::abs(cell.second - middle.second));
      if ((ring - 1) * edge >= best) continue;
      for (const std::size_t i : inside) {
        const double away = std::hypot(places_[i].x - p.x, places_[i].y - p.y);
        if (away < best || (away == best && ring < inner)) best = away, inner = ring, rssi = places_[i].rssi;
      }
    }
    return rssi;
  }

  std::vector<RssiPlace> places_;
  std::map<Cell, std::vector<std::size_t>> cells_;
};

}  // namespace muster
