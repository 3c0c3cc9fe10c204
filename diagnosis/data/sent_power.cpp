#include "diagnosis/data/sent_power.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "diagnosis/data/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Distance [m] within which hardly any reading is lost. Beyond it those of a low power that are heard are the stronger
// ones, which hides how levels rise with the power.
double lossless_reach(const PoweredReadings& readings) {
  std::vector<std::pair<double, bool>> lost;  // by distance
  for (std::size_t i = 0; i < readings.level.size(); ++i) {
    if (std::isfinite(readings.power[i]) && readings.distance[i] > 0)
      lost.emplace_back(readings.distance[i], std::isnan(readings.level[i]));
  }
  std::sort(lost.begin(), lost.end());
  double reach = 0, count = 0, missing = 0;
  for (std::size_t i = 0; i < lost.size(); ++i) {
    count += 1, missing += lost[i].second;
    const bool goes_on = i + 1 < lost.size() && lost[i + 1].first == lost[i].first;  // at the same distance
    if (!goes_on && missing <= thresholds::lost_of_powers * count) reach = lost[i].first;
  }
  return reach;
}

// Heard readings of known power, with the mean of each link taken out.
struct WithinLinks {
  std::vector<double> powers;  // that were set, rising
  VectorXd level;              // dBm
  MatrixXd design;             // the logarithm of distance, then one column for each power but the lowest
};

std::optional<WithinLinks> within_links(const PoweredReadings& readings, double reach) {
  WithinLinks result;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < readings.level.size(); ++i) {
    if (!std::isfinite(readings.level[i]) || !std::isfinite(readings.power[i]) || !(readings.distance[i] > 0) ||
        readings.distance[i] > reach)
      continue;
    rows.push_back(i);
    result.powers.push_back(readings.power[i]);
  }
  std::sort(result.powers.begin(), result.powers.end());
  result.powers.erase(std::unique(result.powers.begin(), result.powers.end()), result.powers.end());
  if (result.powers.size() < 2 || result.powers.size() > thresholds::most_powers) return {};
  const auto n = static_cast<Index>(rows.size());
  result.level.resize(n);
  result.design = MatrixXd::Zero(n, static_cast<Index>(result.powers.size()));
  std::map<std::size_t, std::vector<Index>> links;
  for (Index k = 0; k < n; ++k) {
    const std::size_t i = rows[static_cast<std::size_t>(k)];
    result.level[k] = readings.level[i];
    result.design(k, 0) = std::log10(readings.distance[i]);
    const auto at =
        std::lower_bound(result.powers.begin(), result.powers.end(), readings.power[i]) - result.powers.begin();
    if (at > 0) result.design(k, at) = 1;
    links[readings.link[i]].push_back(k);
  }
  for (const auto& [link, of_link] : links) {
    const double mean = result.level(of_link).mean();
    const Eigen::RowVectorXd means = result.design(of_link, Eigen::all).colwise().mean();
    for (const Index k : of_link) {
      result.level[k] -= mean;
      result.design.row(k) -= means;
    }
  }
  return result;
}

// dB for each dB of power; nothing where levels do not rise with it as those of one radio.
std::optional<double> rise(const WithinLinks& w) {
  const auto powers = static_cast<Index>(w.powers.size());
  const double span = w.powers.back() - w.powers.front();
  if (span < thresholds::least_span_of_powers || w.level.size() < thresholds::readings_a_power * powers) return {};
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(w.design);
  const bool has_distance = w.design.col(0).cwiseAbs().maxCoeff() > 0;
  if (qr.rank() < powers - (has_distance ? 0 : 1)) return {};
  const VectorXd found = qr.solve(w.level);
  VectorXd level = VectorXd::Zero(powers), set(powers);
  level.tail(powers - 1) = found.tail(powers - 1);
  for (Index k = 0; k < powers; ++k) set[k] = w.powers[static_cast<std::size_t>(k)];
  level.array() -= level.mean();
  set.array() -= set.mean();
  const double off = (level - set).norm() / std::sqrt(static_cast<double>(powers));
  if (off > thresholds::off_the_power * span) return {};
  return level.dot(set) / set.squaredNorm();
}

}  // namespace

std::optional<SentPower> followed_power(const PoweredReadings& readings) {
  // Losses by chance hide nothing: those within the reach are asked only where all together do not follow the power.
  for (const double reach : {std::numeric_limits<double>::infinity(), lossless_reach(readings)}) {
    const auto w = within_links(readings, reach);
    const auto slope = w ? rise(*w) : std::nullopt;
    if (!slope) continue;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const double power : readings.power) {
      if (std::isfinite(power)) least = std::min(least, power), most = std::max(most, power);
    }
    return SentPower{*slope, (least + most) / 2};
  }
  return {};
}

}  // namespace muster::diagnosis
