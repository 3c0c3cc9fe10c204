#include "diagnosis/radio/laws/law_doubts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "diagnosis/calibration/distributions.hpp"
#include "diagnosis/inference/noise/over_time.hpp"
#include "diagnosis/radio/laws/scatter_by_level.hpp"
#include "diagnosis/radio/laws/testable_readings.hpp"
#include "diagnosis/radio/links/link_site.hpp"
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

// Successive readings of a link that both need a law, and are off alike: closer than a quarter of the readings that
// need it are to another one of their link.
struct Successive {
  int pairs = 0, alike = 0;
  double by_chance = 0;  // pairs in another order of each link's readings
  double needing = 0;    // readings

  // What lasts makes more pairs than chance: several times as many where it is rare, and nearly all alike, unless the
  // field follows it in part. A level that is a little off makes more of them, too, where a law no longer fits so well,
  // but not many more, and none more alike than a quarter of them. One patch of the field beside many readings that are
  // off one by one makes no runs of these.
  bool in_runs() const {
    const bool many =
        pairs > thresholds::pairs_of_runs * by_chance && pairs - by_chance > thresholds::pairs_of_need * needing;
    return pairs > 0 && poisson_tail(by_chance, pairs) < thresholds::pairs_alpha &&
           (many || alike > thresholds::lasting * thresholds::alike_share * pairs);
  }
};

// The difference [dB] below which this share of the readings of a link is from those half as many readings on.
double alike_below(const std::vector<double>& off) {
  std::vector<double> apart;
  for (std::size_t i = 0; i < off.size(); ++i)
    apart.push_back(std::abs(off[i] - off[(i + off.size() / 2) % off.size()]));
  const auto at =
      apart.begin() + static_cast<std::ptrdiff_t>(thresholds::alike_share * static_cast<double>(off.size()));
  std::nth_element(apart.begin(), at, apart.end());
  return *at;
}

Successive successive(const LawSources& s, const VectorXd& residual, const LawTest& law) {
  struct Link {
    std::vector<double> off;    // dB, of those that need the law
    std::vector<double> steps;  // dB, between successive ones
    bool last_needs = false;
    double readings = 0;
  };
  VectorXd won = VectorXd::Constant(residual.size(), std::nan(""));
  for (Index i = 0, tested = 0; i < residual.size(); ++i) {
    if (std::isfinite(residual[i])) won[i] = law.won[tested++];
  }
  const LinkReadings& r = s.readings;
  std::map<std::pair<int, int>, Link> links;
  for (const Index i : in_order_of_time(r)) {
    if (!std::isfinite(won[i])) continue;
    const auto k = static_cast<std::size_t>(i);
    Link& link = links[{r.tx[k], r.rx[k]}];
    const bool needs = won[i] > thresholds::needs_law;
    if (needs && link.last_needs) link.steps.push_back(std::abs(residual[i] - link.off.back()));
    if (needs) link.off.push_back(residual[i]);
    link.last_needs = needs;
    link.readings += 1;
  }
  Successive result;
  for (const auto& [ends, link] : links) {
    if (link.off.empty()) continue;
    const auto needing = static_cast<double>(link.off.size());
    const double alike = alike_below(link.off);
    result.needing += needing;
    result.by_chance += needing * (needing - 1) / link.readings;
    result.pairs += static_cast<int>(link.steps.size());
    result.alike += static_cast<int>(
        std::count_if(link.steps.begin(), link.steps.end(), [=](double step) { return step < alike; }));
  }
  return result;
}

struct LinkInNeed {
  std::pair<int, int> ends{};
  double readings = 0;
  int need = 0;  // of these, a law

  void add(const LinkInNeed& other) {
    readings += other.readings;
    need += other.need;
  }
};

// Links at one place each if they stand there for a while, those first of which the most readings need a law.
std::vector<LinkInNeed> links_in_need(const LawSources& s, const VectorXd& residual, const LawTest& law) {
  std::map<LinkSite, LinkInNeed> at_places;
  for (Index i = 0, tested = 0; i < residual.size(); ++i) {
    if (!std::isfinite(residual[i])) continue;
    const auto k = static_cast<std::size_t>(i);
    const std::pair ends(s.readings.tx[k], s.readings.rx[k]);
    at_places.try_emplace(site_of(s.readings, i), LinkInNeed{ends})
        .first->second.add({ends, 1, law.won[tested++] > thresholds::needs_law});
  }
  std::map<std::pair<int, int>, LinkInNeed> links;
  LinkInNeed all;
  std::vector<LinkInNeed> result;
  for (const auto& [site, link] : at_places) {
    links.try_emplace(link.ends, LinkInNeed{link.ends}).first->second.add(link);
    all.add(link);
    result.push_back(link);
  }
  if (all.readings < inference::thresholds::readings_a_stay * static_cast<double>(result.size())) {
    result.clear();
    for (const auto& [ends, link] : links) result.push_back(link);
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const LinkInNeed& a, const LinkInNeed& b) { return a.need > b.need; });
  return result;
}

ScatterByLevel scatter_of(const LawSources& s, const VectorXd& residual, const KrigedReadings& field,
                          const Diagnosis& found) {
  VectorXd level(field.size());
  for (Index i = 0, kriged = 0; i < residual.size(); ++i) {
    if (std::isfinite(residual[i])) level[kriged++] = found.mean[s.used[static_cast<std::size_t>(i)]];
  }
  return scatter_by_level(field.close_readings(), level);
}

// The likeliest of what is not found, where chance yields it with less than that probability; null if there is none.
const inference::Check* nearest_left(const Diagnosis& found, double alpha) {
  const auto is_told = [&](const std::string& id) {
    return std::any_of(found.causes.begin(), found.causes.end(), [&](const auto& c) { return c.id == id; }) ||
           std::any_of(found.unexplained.begin(), found.unexplained.end(),
                       [&](const Unexplained& u) { return "~" + u.covariate == id; });
  };
  const inference::Check* least = nullptr;
  for (const inference::Check& check : found.checks) {
    if (check.log_p < (least ? least->log_p : std::log(alpha)) && !is_told(check.id)) least = &check;
  }
  return least;
}

std::string comes_near(const inference::Check& check) {
  return fmt::format("{} comes near (p = {:.1g})", check.id.substr(check.id.find_first_of(".~") + 1),
                     std::exp(check.log_p));
}

// So many ways or places of links.
std::string places_of(std::size_t count, const std::set<std::string>& links) {
  constexpr std::size_t most = 3;  // names of a sentence
  const std::string names =
      links.size() > most ? fmt::format("{} links", links.size()) : fmt::format("{}", fmt::join(links, ", "));
  return count == links.size() ? names : fmt::format("{} ways or places of {}", count, names);
}

// True if each link has one place, and no noise over time could be fitted: without times, or at a few moments.
bool may_wander(const LawSources& s) {
  if (s.state.time_unit() > 0 || noise::fixed_share(s.state.fit.covariance.family) == 0) return false;
  std::set<LinkSite> sites;
  std::set<std::pair<int, int>> links;
  for (Index i = 0; i < s.readings.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    sites.insert(site_of(s.readings, i));
    links.emplace(s.readings.tx[k], s.readings.rx[k]);
  }
  const auto& recurring = s.state.field().recurring();
  return sites.size() == links.size() &&
         noise::time_units(recurring, s.state.field().sites(), s.state.problem().layout->times(s.state.rows())).empty();
}

// The distance [m] over which the field forgets, where the world's fades are of places and the field holds them:
// readings of several ways past a place have its fade in common. 0 elsewhere.
double fades_in_field(const LawSources& s) {
  const LawPart stated = stated_law(s.model).base;
  const double apart = stated.law ? stated.law->apart(stated.params) : 0;
  const double distance = noise::stated_by(s.state.fit.covariance, s.state.within()).decorrelation;
  return s.state.time_unit() == 0 && distance < thresholds::fades_in_field * apart ? distance : 0;
}

// m, the longest side of the ground that an end of a link covers.
double longest_ground(const LinkReadings& r) {
  struct Box {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  };
  std::map<std::pair<int, int>, std::array<Box, 2>> links;
  for (Index i = 0; i < r.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    auto& [tx, rx] = links[{r.tx[k], r.rx[k]}];
    tx = {tx.low.cwiseMin(r.tx_at.col(i)), tx.high.cwiseMax(r.tx_at.col(i))};
    rx = {rx.low.cwiseMin(r.rx_at.col(i)), rx.high.cwiseMax(r.rx_at.col(i))};
  }
  double longest = 0;
  for (const auto& [ends, boxes] : links) {
    for (const Box& box : boxes) longest = std::max(longest, (box.high - box.low).maxCoeff());
  }
  return longest;
}

std::string in_words(const ScatterByLevel& scatter) {
  return fmt::format("single readings scatter by {:.1f} dB where levels are low and by {:.1f} dB where they are high",
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
  if (std::string doubt = doubt_beside_unexplained(found, law); !doubt.empty()) return doubt;
  if (replaces(s, law.cause)) {
    if (may_wander(s))
      return "single readings of links that stand scatter as by " + law.cause +
             ", and so do levels that wander between readings: without their times, or at a few moments alone, these "
             "are not told apart, and it is not named";
    if (const double distance = fades_in_field(s); distance > 0)
      return fmt::format(
          "levels are alike within {:.2f} m, as fades of places are: what single readings scatter by beside them tells "
          "nothing of these, and no other fading is named",
          distance);
    const ScatterByLevel scatter = scatter_of(s, residual, field, found);
    return scatter.log_p > std::log(thresholds::scatter_alpha)
               ? ""
               : in_words(scatter) +
                     ": a receiver does that, by its noise or as it compresses, and no law of fading, so that none is "
                     "named";
  }
  if (const noise::StatedField field_of_rows = noise::stated_by(s.state.fit.covariance, s.state.within());
      s.state.time_unit() == 0 && field_of_rows.decorrelation < thresholds::longest_fade &&
      field_of_rows.shadowing > thresholds::least_fade)
    return fmt::format(
        "levels are alike within {:.2f} m alone, as fades of places are, which are deep and rare: readings that are "
        "off as by {} may be these, and it is not named",
        field_of_rows.decorrelation, law.cause);
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

std::string doubt_of_extent(const LinkReadings& readings, const noise::StatedField& fitted,
                            const noise::StatedField& said) {
  const double ground = longest_ground(readings);
  if (fitted.decorrelation < thresholds::field_of_the_ground * ground ||
      fitted.decorrelation < thresholds::much_longer_field * said.decorrelation)
    return "";
  return fmt::format(
      "levels are off alike over {:.2g} m of the {:.2g} m that a link covers: a plan in a wrong scale, another law of "
      "distance or a map that is off as a whole does that, too, and another shadowing is not named",
      fitted.decorrelation, ground);
}

std::string doubt_beside_unexplained(const Diagnosis& found, const LawTest& law) {
  double most = 0;
  for (const Unexplained& each : found.unexplained) most = std::max(most, each.lambda);
  if (law.gain >= thresholds::law_beside_unexplained * most) return "";
  return fmt::format(
      "single readings scatter as by {} (lambda {:.0f}) beside what is not explained (lambda {:.0f}): where that "
      "changes at once a smooth leaves a part of it, and the law is not named",
      law.cause, law.gain, most);
}

std::string doubt_by_level(const LawSources& s, const VectorXd& residual, const KrigedReadings& field,
                           const Diagnosis& found) {
  const ScatterByLevel scatter = scatter_of(s, residual, field, found);
  return scatter.log_p > std::log(thresholds::doubtful_scatter_alpha)
             ? ""
             : in_words(scatter) + fmt::format(" (p = {:.1g}), as behind a receiver that compresses or has noise",
                                               std::exp(scatter.log_p));
}

std::string doubt_by_link(const LawSources& s, const VectorXd& residual, const LawTest& law) {
  const std::vector<LinkInNeed> links = links_in_need(s, residual, law);
  LinkInNeed all;
  for (const LinkInNeed& link : links) all.add(link);
  if (all.need == 0) return "";  // each reading needs the law a little
  const auto count = static_cast<double>(links.size());
  LinkInNeed first;  // the links so far, together
  std::set<std::string> names;
  for (std::size_t k = 0; k < links.size(); ++k) {
    const auto many = static_cast<double>(k + 1);
    if (many > thresholds::few_links * count) break;
    first.add(links[k]);
    names.insert(fmt::format("{}", fmt::join(s.model.link_of(links[k].ends.first, links[k].ends.second), "-")));
    if (first.need < thresholds::most_of_few_links * all.need) continue;
    const double by_chance = all.need * first.readings / all.readings;
    // As many others of the links might have been the first.
    const double choices = std::lgamma(count + 1) - std::lgamma(many + 1) - std::lgamma(count - many + 1);
    if (std::log(poisson_tail(by_chance, first.need)) + choices < std::log(thresholds::pairs_alpha))
      return fmt::format(
          "{} of {} readings that are off are of {}, where chance has {:.0f}: something happens there, and not to all "
          "readings",
          first.need, all.need, places_of(k + 1, names), by_chance);
  }
  return "";
}

std::string doubt_of_scatter(const Diagnosis& found) {
  const inference::Check* const left = nearest_left(found, thresholds::scattered_alpha);
  return left ? "what is not found scatters readings, too, and " + comes_near(*left) : "";
}

std::string doubt_of_field(const Diagnosis& found, const CauseEstimate& field) {
  if (const inference::Check* const left = nearest_left(found, thresholds::absorbed_alpha))
    return "what is not found makes a field wide, too, and " + comes_near(*left);
  if (field.evidence < thresholds::plain_field)
    return "a law of distance that is a little other than the world's, or a thing that is not found, would do as well";
  return "";
}

}  // namespace muster::diagnosis
