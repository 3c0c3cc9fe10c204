#include "diagnosis/data/sent_power.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "diagnosis/data/thresholds.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const Covariate* power_of(const Dataset& data) {
  const auto found = std::find_if(data.covariates.begin(), data.covariates.end(),
                                  [](const Covariate& c) { return c.name == "power[dBm]" && !c.values.empty(); });
  return found == data.covariates.end() ? nullptr : &*found;
}

// m; NaN where a height is unknown, which is left out of them all.
std::vector<double> distances_of(const Dataset& data) {
  if (!data.has_places()) return data.table->reals(data.table->require("distance", "m"));
  std::vector<double> result;
  for (std::size_t i = 0; i < data.rows(); ++i) {
    const Point &a = data.tx_at[i], &b = data.rx_at[i];
    const double up = std::isnan(a[2] - b[2]) ? 0 : a[2] - b[2];
    result.push_back(std::hypot(a[0] - b[0], a[1] - b[1], up));
  }
  return result;
}

// Heard readings of known power, with the mean of each link taken out.
struct WithinLinks {
  std::vector<double> powers;  // that were set, rising
  VectorXd level;              // dBm
  MatrixXd design;             // the logarithm of distance, then one column for each power but the lowest
};

std::optional<WithinLinks> within_links(const Dataset& data, const std::vector<double>& power) {
  const std::vector<double> distance = distances_of(data);
  WithinLinks result;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < data.rows(); ++i) {
    if (!std::isfinite(data.rssi[i]) || !std::isfinite(power[i]) || !(distance[i] > 0)) continue;
    rows.push_back(i);
    result.powers.push_back(power[i]);
  }
  std::sort(result.powers.begin(), result.powers.end());
  result.powers.erase(std::unique(result.powers.begin(), result.powers.end()), result.powers.end());
  if (result.powers.size() < 2 || result.powers.size() > thresholds::most_powers) return {};
  const auto n = static_cast<Index>(rows.size());
  result.level.resize(n);
  result.design = MatrixXd::Zero(n, static_cast<Index>(result.powers.size()));
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Index>> links;
  for (Index k = 0; k < n; ++k) {
    const std::size_t i = rows[static_cast<std::size_t>(k)];
    result.level[k] = data.rssi[i];
    result.design(k, 0) = std::log10(distance[i]);
    const auto at = std::lower_bound(result.powers.begin(), result.powers.end(), power[i]) - result.powers.begin();
    if (at > 0) result.design(k, at) = 1;
    links[{data.tx.level[i], data.rx.level[i]}].push_back(k);
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

void refer_to_one_power(Dataset& data) {
  const Covariate* power = data.reading == "rssi" ? power_of(data) : nullptr;
  if (!power) return;
  const auto w = within_links(data, power->values);
  const auto slope = w ? rise(*w) : std::nullopt;
  if (!slope) return;
  const double middle = (w->powers.front() + w->powers.back()) / 2;
  for (std::size_t i = 0; i < data.rows(); ++i) {
    if (std::isfinite(power->values[i])) data.rssi[i] -= power->values[i] - middle;
  }
  data.notes.push_back("levels rise by " + print_real(std::round(100 * *slope) / 100) + " dB for each dB of " +
                       quote(power->name) + ": they are what was received, and are referred to a power of " +
                       print_real(middle) + " dBm, the middle of those set");
}

}  // namespace muster::diagnosis
