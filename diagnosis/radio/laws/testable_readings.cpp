#include "diagnosis/radio/laws/testable_readings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "diagnosis/radio/links/stated_clip.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {

using Eigen::Index;
using Eigen::VectorXd;

Index tested(const VectorXd& residual) { return residual.array().isFinite().count(); }

namespace {

// Expected level of a reading, and the standard deviation of what may lie beside it, dB.
struct ExpectedLevels {
  VectorXd mean, sd;
};

// Where a place is measured again and again, its readings tell the level there, of which the model knows the mean only.
ExpectedLevels expected_levels(const LawSources& s, const Diagnosis& found) {
  const noise::Covariance& fit = s.state.fit.covariance;
  const LinkReadings& r = s.readings;
  const auto n = static_cast<Index>(s.used.size());
  ExpectedLevels result{VectorXd(found.mean(s.used)),
                        VectorXd::Constant(n, std::sqrt(fit.field_variance() + fit.reading_variance()))};
  std::map<std::vector<long>, std::vector<Index>> of_place;  // by link and places
  for (Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    std::vector<long> place{r.tx[k], r.rx[k]};
    for (const Eigen::Matrix3Xd* ends : {&r.tx_at, &r.rx_at}) {
      for (const double at : ends->col(i)) place.push_back(std::lround(at / thresholds::repeats_within));
    }
    of_place[place].push_back(i);
  }
  for (const auto& [place, readings] : of_place) {
    if (readings.size() < thresholds::repeats_that_tell) continue;
    std::vector<double> off;
    for (const Index i : readings)
      off.push_back(s.data.rssi[static_cast<std::size_t>(s.used[static_cast<std::size_t>(i)])] - result.mean[i]);
    if (std::any_of(off.begin(), off.end(), [](double v) { return std::isnan(v); })) continue;
    std::nth_element(off.begin(), off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2), off.end());
    for (const Index i : readings) {
      result.mean[i] += off[off.size() / 2];
      result.sd[i] = std::sqrt(fit.reading_variance());
    }
  }
  return result;
}

// Level as received below which readings are lost, dBm; minus infinity where none is known, or weaker ones are heard.
double floor_of(const LawSources& s) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Readings& readings = s.fit.readings;
  if (s.fit.missing.censored) return readings.floor;
  const VectorXd received = readings.received(readings.rssi);
  const double weakest = received.array().isNaN().select(infinity, received).minCoeff();
  const double known = (s.end ? s.end : silent_below(s.model.simulation(), weakest)).value_or(-infinity);
  return weakest < known - thresholds::reaches_a_floor ? -infinity : known;
}

// Expected level as received, dBm, below which more readings are lost than amid the strongest, for no floor that is
// known, such as one that sets in over some decibels: those heard are not as single readings scatter.
double biased_below(const MissingData& missing) {
  if (missing.censored || !missing.rises()) return -std::numeric_limits<double>::infinity();
  const auto share = [](const MissingData::Bin& bin) { return bin.missing / bin.rows; };
  std::size_t k = missing.bins.size() - 1;
  while (share(missing.bins[k - 1]) < share(missing.bins.back()) + thresholds::biased_bin) --k;  // the first is above
  return (missing.bins[k - 1].level + missing.bins[k].level) / 2;
}

}  // namespace

VectorXd residual_of(const LawSources& s, const Diagnosis& found) {
  const noise::Rows& rows = s.state.rows();
  VectorXd left(static_cast<Index>(s.used.size()));
  for (Index i = 0; i < left.size(); ++i) {
    const Index row = s.used[static_cast<std::size_t>(i)];
    left[i] = s.data.rssi[static_cast<std::size_t>(row)] - found.mean[row];
  }
  const VectorXd filled = left.array().isNaN().select(0, left);
  const VectorXd shift = s.state.left_by(s.state.design()) - rows.mean(filled);
  VectorXd result = left + rows.at_readings(shift);
  const double floor = floor_of(s), biased = biased_below(s.fit.missing);
  if (!s.state.problem().bounds.any() && std::isinf(floor) && std::isinf(biased)) return result;
  const ExpectedLevels expected = expected_levels(s, found);
  for (Index i = 0; i < result.size(); ++i) {
    const double reach = thresholds::near_clip * expected.sd[i], mean = expected.mean[i];
    const auto near = [&](const std::optional<Clip>& clip, double side) {
      return clip && side * (clip->level - mean) < reach;
    };
    const auto referred = [&](double level) {
      return s.fit.readings.referred_to(level, s.used[static_cast<std::size_t>(i)]);
    };
    const bool may_be_lost = mean - referred(floor) < reach || mean < referred(biased);
    if (may_be_lost || near(found.receiver.top, 1) || near(found.receiver.bottom, -1)) result[i] = std::nan("");
  }
  return result;
}

std::vector<Index> in_order_of_time(const LinkReadings& r) {
  std::vector<Index> order(static_cast<std::size_t>(r.size()));
  std::iota(order.begin(), order.end(), 0);
  const auto time = [&](Index i) { return r.t.empty() ? 0.0 : r.t[static_cast<std::size_t>(i)]; };
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return time(a) < time(b); });
  return order;
}

VectorXd drawn_anew(const LawSources& s, const LawPart& law, VectorXd residual) {
  const double apart = law.law->apart(law.params);
  if (apart == 0) return residual;
  const LinkReadings& r = s.readings;
  std::map<std::pair<int, int>, Index> last;  // by link
  for (const Index i : in_order_of_time(r)) {
    if (!std::isfinite(residual[i])) continue;
    const auto k = static_cast<std::size_t>(i);
    const auto [at, first] = last.try_emplace({r.tx[k], r.rx[k]}, i);
    if (first) continue;
    const double way =
        (r.rx_at.col(i) - r.rx_at.col(at->second)).norm() + (r.tx_at.col(i) - r.tx_at.col(at->second)).norm();
    if (way > apart)
      at->second = i;
    else
      residual[i] = std::nan("");
  }
  return residual;
}

Index repeated(const LinkReadings& r) {
  std::map<std::pair<int, int>, Index> last;  // by link
  Index repeated = 0;
  for (Index i = 0; i < r.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const auto [at, first] = last.try_emplace({r.tx[k], r.rx[k]}, i);
    const Index before = std::exchange(at->second, i);
    repeated +=
        !first && (r.rx_at.col(i) - r.rx_at.col(before)).norm() + (r.tx_at.col(i) - r.tx_at.col(before)).norm() <
                      thresholds::repeats_within;
  }
  return repeated;
}

bool repeat_places(const LinkReadings& r) {
  return static_cast<double>(repeated(r)) > thresholds::repeated_share * static_cast<double>(r.size());
}

std::string why_not(const LawSources& s, const VectorXd& residual) {
  if (!s.data.has_places()) return "not testable: the data have no places";
  if (tested(residual) < thresholds::fewest_law_readings)
    return "not testable: fewer than 300 readings that are no bounds and farther apart than the way over which fading "
           "changes";
  return "";
}

VectorXd without_grazing(const LawSources& s, const VectorXd& residual, std::vector<std::string>& notes) {
  const VectorXd unsure = s.model.changes_nearby(thresholds::grazing)(s.used);
  const auto grazes = unsure.array() > thresholds::grazing_change;
  if (const Index count = grazes.count())
    notes.push_back(fmt::format(
        "{} of {} readings would cross other walls if they were {:.0f} mm off: how single readings scatter is asked "
        "without them",
        count, residual.size(), 1000 * thresholds::grazing));
  return grazes.select(std::nan(""), residual);
}

VectorXd without_second_twins(const LinkReadings& readings, const noise::Rows& rows, VectorXd residual) {
  for (Index i = 0; i < residual.size(); ++i) {
    if (rows.is_second_twin(i) && std::isfinite(residual[readings.twin[static_cast<std::size_t>(i)]]))
      residual[i] = std::nan("");
  }
  return residual;
}

VectorXd means_of_twins(const LinkReadings& readings, const noise::Rows& rows, VectorXd residual) {
  for (Index i = 0; i < residual.size(); ++i) {
    if (!rows.is_second_twin(i)) continue;
    const Index first = readings.twin[static_cast<std::size_t>(i)];
    residual[first] = (residual[first] + residual[i]) / 2;
    residual[i] = std::nan("");
  }
  return residual;
}

VectorXd without_link(const LawSources& s, const std::set<std::string>& ends, VectorXd residual) {
  const LinkReadings& r = s.readings;
  for (Index i = 0; i < residual.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (s.model.link_of(r.tx[k], r.rx[k]) == ends) residual[i] = std::nan("");
  }
  return residual;
}

}  // namespace muster::diagnosis
