#include "diagnosis/radio/laws/law_doubts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "diagnosis/calibration/distributions.hpp"
#include "diagnosis/radio/laws/scatter_by_level.hpp"
#include "diagnosis/radio/laws/testable_readings.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// The distance [m] by which links would have to be moved to change which walls they cross, up to which those readings
// lie that a law gains from; 0 if it gains elsewhere in proportion. Where places are told less exactly than that, a
// link may pass a wall on the other side, and the loss of the wall resembles a draw that few readings have.
double beside_walls(const LawSources& s, const VectorXd& residual, const LawTest& law) {
  const double all = law.won.sum();
  for (const double metres : thresholds::places_off) {
    const VectorXd change = s.model.changes_nearby(metres)(s.used);
    double clear = 0, won = 0;
    for (Index i = 0, tested = 0; i < residual.size(); ++i) {
      if (!std::isfinite(residual[i])) continue;
      if (change[i] <= thresholds::grazing_change) clear += 1, won += law.won[tested];
      ++tested;
    }
    const double share = clear / static_cast<double>(law.won.size());
    if (share >= thresholds::least_clear && won < thresholds::in_proportion * share * all) return metres;
  }
  return 0;
}

// Pairs of successive readings of a link that both need a law, and how many there would be in another order of each
// link's.
struct Successive {
  int pairs = 0;
  double by_chance = 0;

  bool in_runs() const { return pairs > 0 && poisson_tail(by_chance, pairs) < thresholds::pairs_alpha; }
};

Successive successive(const LawSources& s, const VectorXd& residual, const LawTest& law) {
  VectorXd won = VectorXd::Constant(residual.size(), std::nan(""));
  for (Index i = 0, tested = 0; i < residual.size(); ++i) {
    if (std::isfinite(residual[i])) won[i] = law.won[tested++];
  }
  struct Link {
    bool last_needs = false;
    double readings = 0, needing = 0;
  };
  const LinkReadings& r = s.readings;
  std::map<std::pair<int, int>, Link> links;
  Successive result;
  for (const Index i : in_order_of_time(r)) {
    if (!std::isfinite(won[i])) continue;
    const auto k = static_cast<std::size_t>(i);
    Link& link = links[{r.tx[k], r.rx[k]}];
    const bool needs = won[i] > thresholds::needs_law;
    result.pairs += needs && link.last_needs;
    link.last_needs = needs;
    link.readings += 1;
    link.needing += needs;
  }
  for (const auto& [ends, link] : links) result.by_chance += link.needing * (link.needing - 1) / link.readings;
  return result;
}

// What is to be said where readings scatter otherwise at other levels: a receiver does that, and no law of fading; else
// empty.
std::string of_receiver(const LawSources& s, const VectorXd& residual, const KrigedReadings& field,
                        const Diagnosis& found) {
  VectorXd level(field.size());
  for (Index i = 0, kriged = 0; i < residual.size(); ++i) {
    if (std::isfinite(residual[i])) level[kriged++] = found.mean[s.used[static_cast<std::size_t>(i)]];
  }
  const ScatterByLevel scatter = scatter_by_level(field.close_readings(), level);
  if (scatter.log_p > std::log(thresholds::scatter_alpha)) return "";
  return fmt::format(
      "single readings scatter by {:.1f} dB where levels are low and by {:.1f} dB where they are high: a receiver "
      "does that, by its noise or as it compresses, and no law of fading, so that none is named",
      scatter.weak, scatter.strong);
}

}  // namespace

std::vector<bool> unsure(const LawSources& s, const VectorXd& residual) {
  const VectorXd change = s.model.changes_nearby(*std::rbegin(thresholds::places_off))(s.used);
  std::vector<bool> result;
  for (Index i = 0; i < residual.size(); ++i) {
    if (std::isfinite(residual[i])) result.push_back(change[i] > thresholds::grazing_change);
  }
  return result;
}

std::string doubt_of(const LawSources& s, const VectorXd& residual, const KrigedReadings& field, const Diagnosis& found,
                     const LawTest& law) {
  if (replaces(s, law.cause)) return of_receiver(s, residual, field, found);
  if (const double near = beside_walls(s, residual, law); near > 0)
    return fmt::format(
        "single readings scatter as by {} only where a move of {:.1f} m changes which walls their link crosses: walls "
        "or places may be so far off, and it is not named",
        law.cause, near);
  if (const Successive off = successive(s, residual, law); off.in_runs())
    return fmt::format(
        "readings that are off as by {} follow each other: {} pairs of successive ones, {:.0f} by chance; what lasts "
        "is none of single readings, and it is not named",
        law.cause, off.pairs, off.by_chance);
  return "";
}

}  // namespace muster::diagnosis
