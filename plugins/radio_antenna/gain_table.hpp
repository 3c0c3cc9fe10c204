// A measured antenna: gains on a grid of azimuths and elevations over the whole sphere, linear in dB between them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <muster/plugin.hpp>
#include <muster/printed.hpp>
#include <string>
#include <vector>

#include "direction.hpp"

namespace muster {

// A row of the file; azimuth to the left and elevation upward in the antenna's own frame.
struct MeasuredGain {
  static constexpr const char* columns = "azimuth[rad] elevation[rad] gain[dBi] .";
  double azimuth, elevation, gain;
};

class GainTable {
 public:
  GainTable() = default;

  // Rows in any order. Throws BadInput where they are no grid over the sphere, or radiate more power than they receive.
  explicit GainTable(Rows<const MeasuredGain> rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (std::abs(rows[i].azimuth) > half_turn + slack || std::abs(rows[i].elevation) > half_turn / 2 + slack)
        throw refused("row " + std::to_string(i + 1) + " is " + place(rows[i].azimuth, rows[i].elevation) +
                      "; expected radians, an azimuth within -pi and pi and an elevation within -pi/2 and pi/2" +
                      in_degrees(rows));
      azimuths_.push_back(rows[i].azimuth), elevations_.push_back(rows[i].elevation);
    }
    for (auto* each : {&azimuths_, &elevations_}) {
      std::sort(each->begin(), each->end());
      each->erase(std::unique(each->begin(), each->end()), each->end());
    }
    fill(rows);
    if (elevations_.front() > -half_turn / 2 + slack || elevations_.back() < half_turn / 2 - slack)
      throw refused("it ends at the elevations " + printed(elevations_.front()) + " and " +
                    printed(elevations_.back()) + "; expected gains from -pi/2 to pi/2");
    const double mean =
        10 * std::log10(mean_over_sphere([&](const Direction& d) { return std::pow(10, gain(d) / 10); }));
    if (mean > calibration)
      throw refused("it radiates more than it is fed: its mean gain over all directions is " + printed(mean) +
                    " dBi; expected at most 0, or 0.5 for errors of calibration");
  }

  bool empty() const { return gains_.empty(); }
  double highest() const { return *std::max_element(gains_.begin(), gains_.end()); }

  // In dBi.
  double gain(const Direction& d) const {
    const auto [left, right, across] = around(azimuth(d));
    const auto [below, above, up] = between(elevation(d));
    return (1 - up) * ((1 - across) * at(left, below) + across * at(right, below)) +
           up * ((1 - across) * at(left, above) + across * at(right, above));
  }

 private:
  // Where all are within half a turn in degrees.
  static std::string in_degrees(Rows<const MeasuredGain> rows) {
    for (const MeasuredGain& row : rows)
      if (std::abs(row.azimuth) > 360 || std::abs(row.elevation) > 90) return "";
    return "; are these degrees? a degree is 0.017453293 rad";
  }

  static constexpr double slack = 1e-3;       // rad, of pi written with three digits or more
  static constexpr double calibration = 0.5;  // dB

  // Two neighbours and the weight of the second.
  struct Between {
    std::size_t first, second;
    double share;
  };

  static BadInput refused(const std::string& why) { return BadInput("attribute \"file\": " + why); }
  static std::string place(double azimuth, double elevation) {
    return "azimuth " + printed(azimuth) + ", elevation " + printed(elevation);
  }

  void fill(Rows<const MeasuredGain> rows) {
    if (rows.empty()) throw refused("it has no rows; expected a gain at each of some azimuths and elevations");
    gains_.assign(azimuths_.size() * elevations_.size(), null());
    const auto index = [](const std::vector<double>& sorted, double value) {
      return static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
    };
    for (const MeasuredGain& row : rows) {
      double& gain = gains_[index(elevations_, row.elevation) * azimuths_.size() + index(azimuths_, row.azimuth)];
      if (!is_null(gain)) throw refused("it has two gains at " + place(row.azimuth, row.elevation));
      gain = row.gain;
    }
    for (std::size_t i = 0; i < gains_.size(); ++i) {
      if (is_null(gains_[i]))
        throw refused("it has no gain at " + place(azimuths_[i % azimuths_.size()], elevations_[i / azimuths_.size()]) +
                      "; expected one at each of its azimuths and elevations");
    }
  }

  double at(std::size_t azimuth, std::size_t elevation) const { return gains_[elevation * azimuths_.size() + azimuth]; }

  // Wraps from the last azimuth to the first.
  Between around(double azimuth) const {
    const auto next = std::upper_bound(azimuths_.begin(), azimuths_.end(), azimuth);
    const bool inside = next != azimuths_.begin() && next != azimuths_.end();
    const auto second = inside ? static_cast<std::size_t>(next - azimuths_.begin()) : 0;
    const std::size_t first = inside ? second - 1 : azimuths_.size() - 1;
    const double turn = inside ? 0 : 2 * half_turn, width = azimuths_[second] - azimuths_[first] + turn;
    const double past = azimuth - azimuths_[first] + (azimuth < azimuths_[first] ? turn : 0);
    return {first, second, width > 0 ? past / width : 0};
  }

  Between between(double elevation) const {
    const auto next = std::upper_bound(elevations_.begin(), elevations_.end(), elevation);
    if (next == elevations_.begin()) return {0, 0, 0};
    const auto second = static_cast<std::size_t>(next - elevations_.begin());
    if (second == elevations_.size()) return {second - 1, second - 1, 0};
    return {second - 1, second,
            (elevation - elevations_[second - 1]) / (elevations_[second] - elevations_[second - 1])};
  }

  std::vector<double> azimuths_, elevations_, gains_;  // ascending; gains by elevation, then azimuth
};

}  // namespace muster
