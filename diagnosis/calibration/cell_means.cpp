#include "diagnosis/calibration/cell_means.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace muster::diagnosis {
namespace {

// Mean of dBm, or dBm of the mean power, alike for measured and simulated readings.
class Averaged {
 public:
  void add(double dbm, Average average) { sum_ += average == Average::dB ? dbm : std::pow(10, dbm / 10); }
  double of(int count, Average average) const {
    const double mean = sum_ / count;
    return average == Average::dB ? mean : 10 * std::log10(mean);
  }

 private:
  double sum_ = 0;
};

struct Sums {
  Averaged measured, simulated;
  int count = 0;
};

// Extent of each radio's places, m.
std::map<int, double> reach(const LinkModel& model, const Fit& fit) {
  struct Span {
    double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
  };
  std::map<int, Span> spans;
  for (const auto i : fit.readings.heard) {
    for (const End& end : model.ends()[static_cast<std::size_t>(i)]) {
      Span& s = spans[end.radio];
      s.x0 = std::min(s.x0, end.x), s.x1 = std::max(s.x1, end.x);
      s.y0 = std::min(s.y0, end.y), s.y1 = std::max(s.y1, end.y);
    }
  }
  std::map<int, double> result;
  for (const auto& [radio, s] : spans) result[radio] = std::hypot(s.x1 - s.x0, s.y1 - s.y0);
  return result;
}

double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (at - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

// Limits of a histogram of cell means, with figures of these data.
std::vector<std::string> limits(const CellErrors& e, const Fit& fit, double per_cell) {
  std::vector<std::string> words;
  words.push_back(
      fmt::format("where: an error that covers a room and one that is scattered give the same bars; see the residual "
                  "map and the looks by "
                  "distance, bearing, time, wall and robot"));
  words.push_back(
      fmt::format("what is noise: cells hold {:.0f} readings on average, so means of independent errors would scatter "
                  "by {:.2f} dB already; "
                  "they scatter by {:.2f} dB",
                  per_cell, e.expected_sd, e.sd));
  words.push_back("a cause that the fit has absorbed: the fitted parameters bend until the mean error is near zero");
  words.push_back(fmt::format("the spread of single readings ({:.2f} dB): averaging has removed fading and its law",
                              fit.residual_sd));
  words.push_back(
      fmt::format("what was never heard ({} readings) and the {} cells with too few", fit.missing.count, e.few));
  words.push_back("neighbouring cells are not independent samples: their number says nothing on how sure the bars are");
  return words;
}

}  // namespace

std::vector<CellMap> cell_maps(const LinkModel& model, const Fit& fit, const Eigen::VectorXd& simulated,
                               const CellOptions& options) {
  const auto far = reach(model, fit);
  std::map<int, std::map<std::pair<long, long>, Sums>> cells;
  std::map<int, std::pair<double, double>> first;
  for (const auto i : fit.readings.heard) {
    if (std::isnan(simulated[i])) continue;
    const auto& ends = model.ends()[static_cast<std::size_t>(i)];
    const bool tx_stays = far.at(ends[0].radio) <= far.at(ends[1].radio);
    const End &stays = ends[tx_stays ? 0 : 1], &roams = ends[tx_stays ? 1 : 0];
    first.try_emplace(stays.radio, stays.x, stays.y);
    Sums& cell = cells[stays.radio][{std::lround(std::floor(roams.x / options.size)),
                                     std::lround(std::floor(roams.y / options.size))}];
    cell.measured.add(fit.readings.rssi[i], options.average);
    cell.simulated.add(simulated[i], options.average);
    ++cell.count;
  }
  std::vector<CellMap> maps;
  for (const auto& [radio, by_place] : cells) {
    CellMap map{model.radio_name(radio), first[radio].first, first[radio].second, {}};
    for (const auto& [place, sums] : by_place) {
      map.cells.push_back({(static_cast<double>(place.first) + 0.5) * options.size,
                           (static_cast<double>(place.second) + 0.5) * options.size,
                           sums.measured.of(sums.count, options.average),
                           sums.simulated.of(sums.count, options.average), sums.count});
    }
    maps.push_back(std::move(map));
  }
  return maps;
}

CellErrors cell_errors(const std::vector<CellMap>& maps, const Fit& fit, const CellOptions& options) {
  CellErrors result;
  double readings = 0, inverse = 0;
  for (const CellMap& map : maps) {
    for (const Cell& cell : map.cells) {
      if (cell.count < options.least) {
        ++result.few;
        continue;
      }
      result.errors.push_back(cell.measured - cell.simulated);
      readings += cell.count;
      inverse += 1.0 / cell.count;
    }
  }
  if (result.errors.empty()) return result;
  const double n = static_cast<double>(result.errors.size());
  for (const double e : result.errors) result.mean += e / n;
  for (const double e : result.errors) result.sd += std::pow(e - result.mean, 2);
  result.sd = std::sqrt(result.sd / std::max(n - 1, 1.0));
  std::vector<double> sorted = result.errors;
  std::sort(sorted.begin(), sorted.end());
  for (const double share : {0.05, 0.25, 0.5, 0.75, 0.95})
    result.quantiles.emplace_back(share, quantile(sorted, share));
  result.expected_sd = fit.residual_sd * std::sqrt(inverse / n);
  result.cannot_show = limits(result, fit, readings / n);
  return result;
}

}  // namespace muster::diagnosis
