#include "diagnosis/pipeline/link_observations.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Censoring of a reading: below or above a clip, or a value.
noise::Known known_of(double rssi, const ReceiverChecks& receiver) {
  const auto lies_in = [&](const std::optional<Clip>& clip) { return clip && rssi == clip->level; };
  if (std::isnan(rssi) || lies_in(receiver.bottom)) return noise::Known::below;
  return lies_in(receiver.top) ? noise::Known::above : noise::Known::value;
}

}  // namespace

LinkReadings observed_readings(const Dataset& data, const LinkModel& model, const std::vector<Index>& used,
                               const VectorXd& expected) {
  LinkReadings r;
  const auto n = static_cast<Index>(used.size());
  r.tx_at.resize(3, n);
  r.rx_at.resize(3, n);
  for (Index i = 0; i < n; ++i) {
    const auto row = static_cast<std::size_t>(used[static_cast<std::size_t>(i)]);
    const auto& [tx, rx] = model.ends()[row];
    r.tx.push_back(tx.radio);
    r.rx.push_back(rx.radio);
    r.tx_at.col(i) << tx.x, tx.y, tx.z;
    r.rx_at.col(i) << rx.x, rx.y, rx.z;
    if (!data.t.empty()) r.t.push_back(data.t[row]);
    if (!data.rx_yaw.empty()) r.rx_yaw.push_back(rx.yaw);
    if (!data.tx_yaw.empty()) r.tx_yaw.push_back(tx.yaw);
    r.level.push_back(expected[used[static_cast<std::size_t>(i)]]);
  }
  return r;
}

ObservedLevels observed_levels(const Dataset& data, const ReceiverChecks& receiver, const Readings& fitted,
                               const std::vector<Index>& used) {
  ObservedLevels out;
  out.measured.resize(static_cast<Index>(used.size()));
  out.bounds.half_code = receiver.step / 2;
  const bool clips = receiver.top || receiver.bottom || !fitted.censored.empty();
  for (std::size_t i = 0; i < used.size(); ++i) {
    const double rssi = data.rssi[static_cast<std::size_t>(used[i])];
    out.measured[static_cast<Index>(i)] = std::isnan(rssi) ? fitted.floor_of(used[i]) - out.bounds.half_code : rssi;
    if (clips) out.bounds.known.push_back(known_of(rssi, receiver));
  }
  return out;
}

ObservedColumns observed_columns(const Dataset& data, const std::vector<Index>& used) {
  ObservedColumns out;
  for (const Covariate& column : data.covariates) {
    const std::string name = column.name.substr(0, column.name.find('['));
    if (!column.no_cause.empty()) {
      out.untested.push_back(name + ": " + column.no_cause);
      continue;
    }
    const bool is_run = name == "run";
    const std::size_t settings = is_run ? used.size() / 2 : thresholds::most_settings;
    inference::Factor factor{name, {}};
    if (column.values.empty()) {
      for (const Index row : used)
        factor.level.push_back(static_cast<int>(column.factor.level[static_cast<std::size_t>(row)]));
    } else {
      const VectorXd values =
          Eigen::Map<const VectorXd>(column.values.data(), static_cast<Index>(column.values.size()))(used);
      if (!values.allFinite()) {
        out.untested.push_back(column.name + ": it has empty cells");
        continue;
      }
      std::map<double, int> different;
      for (Index i = 0; i < values.size() && different.size() <= settings; ++i) different[values[i]];
      if (different.size() > settings) {
        out.columns.covariates.push_back({name, values});
        continue;
      }
      if (different.size() < 2) continue;
      int next = 0;
      for (auto& [value, level] : different) level = next++;
      for (const double v : values) factor.level.push_back(different.at(v));
    }
    if (is_run) out.run = factor.level;
    out.columns.factors.push_back(std::move(factor));
  }
  return out;
}

std::vector<int> settings_of(const ObservedColumns& observed) {
  std::vector<int> settings;
  for (const inference::Factor& factor : observed.columns.factors) {
    if (factor.name == "run") continue;
    const int levels = *std::max_element(factor.level.begin(), factor.level.end()) + 1;
    if (levels > static_cast<int>(thresholds::most_settings)) continue;
    settings.resize(factor.level.size());
    std::map<std::pair<int, int>, int> number;  // numbered anew with each factor, or many make numbers that overflow
    for (std::size_t i = 0; i < settings.size(); ++i) {
      const auto next = static_cast<int>(number.size());
      settings[i] = number.try_emplace({settings[i], factor.level[i]}, next).first->second;
    }
  }
  return settings;
}

}  // namespace muster::diagnosis
