#include "diagnosis/inference/noise/over_time.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/inference/thresholds.hpp"

namespace muster::noise {
namespace {

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::vector<double> time_units(const RecurringSites& recurring, const Sites& sites, const std::vector<double>& times) {
  if (times.empty() || recurring.share() < inference::thresholds::standing_share) return {};
  std::vector<double> steps, spans, counts;
  for (const std::vector<Index>& rows : recurring.sites()) {
    if (sites.is_alone(rows.front())) continue;
    std::vector<double> moments;
    for (const Index row : rows) {
      if (recurring.of(rows.front(), row) == Relation::stream) moments.push_back(times[at(row)]);
    }
    std::sort(moments.begin(), moments.end());
    moments.erase(std::unique(moments.begin(), moments.end()), moments.end());
    for (std::size_t k = 1; k < moments.size(); ++k) steps.push_back(moments[k] - moments[k - 1]);
    spans.push_back(moments.back() - moments.front());
    counts.push_back(static_cast<double>(moments.size()));
  }
  if (steps.empty() || median_of(counts) < inference::thresholds::fewest_moments) return {};
  const double count = median_of(counts), usual = median_of(steps), mean = median_of(spans) / count;
  const auto unit = [&](double step) {
    return step * std::sqrt(count / 2) / std::exp(inference::thresholds::prior_log_decorrelation);
  };
  constexpr double alike = 2;
  if (std::max(usual, mean) < alike * std::min(usual, mean)) return {unit(mean)};
  return {unit(mean), unit(usual)};
}

Sites over_time(Sites sites, const std::vector<double>& times, double unit) {
  if (times.empty()) return sites;
  const RecurringSites recurring(sites);
  sites.series.resize(times.size());
  int series = 0;
  for (const std::vector<Index>& rows : recurring.sites()) {
    for (const Index row : rows) sites.series[at(row)] = series;
    ++series;
  }
  const double first = *std::min_element(times.begin(), times.end());
  for (const double t : times) sites.moment.push_back((t - first) / unit);
  return sites;
}

std::optional<Sites> moments_of(const Sites& sites) {
  if (!sites.over_time()) return {};
  const Eigen::Matrix3Xd nowhere = Eigen::Matrix3Xd::Zero(3, sites.size());
  Sites result{nowhere, nowhere, nowhere, nowhere, sites.series, sites.count};
  result.place.row(0) = Eigen::Map<const Eigen::RowVectorXd>(sites.moment.data(), sites.size());
  result.stream = sites.stream;
  result.alone = sites.alone;
  return result;
}

}  // namespace muster::noise
