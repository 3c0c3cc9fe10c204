#include "diagnosis/radio/laws/law_causes.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "diagnosis/radio/laws/blockage_test.hpp"
#include "diagnosis/radio/laws/scatter_by_level.hpp"
#include "diagnosis/radio/laws/shadowing_test.hpp"
#include "diagnosis/radio/laws/standing_links_test.hpp"
#include "diagnosis/radio/links/drawn_term.hpp"
#include "diagnosis/radio/thresholds.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

Index finite(const VectorXd& values) { return values.array().isFinite().count(); }

bool beyond_chance(const LawTest& test, double share) { return test.evidence > 0 && test.log_p < std::log(share); }

// Measured less expected, for each reading of the search; NaN for a censored reading or near a clip.
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
  if (!s.state.problem().bounds.any()) return result;
  const double sd = std::sqrt(s.state.fit.covariance.field_variance() + s.state.fit.covariance.reading_variance());
  const auto near = [&](const std::optional<Clip>& clip, double side, double mean) {
    return clip && side * (clip->level - mean) < thresholds::near_clip * sd;
  };
  for (Index i = 0; i < result.size(); ++i) {
    const double mean = found.mean[s.used[static_cast<std::size_t>(i)]];
    const bool lost = s.fit.missing.censored && mean - s.fit.missing.floor < thresholds::near_clip * sd;
    if (lost || near(found.receiver.top, 1, mean) || near(found.receiver.bottom, -1, mean)) result[i] = std::nan("");
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

// Readings of which each is drawn anew: of those of a link that lie closer than its law needs, the first.
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

// True where nearly all readings of a link are of one place, as those of a standing network: what is drawn by place is
// the same in all of them.
bool repeat_places(const LinkReadings& r) {
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
  return static_cast<double>(repeated) > thresholds::repeated_share * static_cast<double>(r.size());
}

// Reason why single readings are not testable; empty if they are.
std::string why_not(const LawSources& s, const VectorXd& residual) {
  if (!s.data.has_places()) return "not testable: the data have no places";
  if (s.readings.twin_variance > thresholds::twins_differ * s.state.fit.covariance.reading_variance())
    return "not testable: the two directions of a link share a part of their scatter";
  if (finite(residual) < thresholds::fewest_law_readings)
    return "not testable: fewer than 300 readings that are no bounds and farther apart than the way over which fading "
           "changes";
  return "";
}

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

// True for a law that is drawn instead of the stated one, not beside it.
bool replaces(const LawSources& s, const std::string& cause) {
  const auto laws = laws_of_causes(s);
  return std::any_of(laws.begin(), laws.end(), [&](const auto& law) { return law->id() == cause && law->replaces(); });
}

// Of each reading that is tested, if walls or places that are as far off as they may be change which walls it crosses.
std::vector<bool> unsure(const LawSources& s, const VectorXd& residual) {
  const VectorXd change = s.model.changes_nearby(*std::rbegin(thresholds::places_off))(s.used);
  std::vector<bool> result;
  for (Index i = 0; i < residual.size(); ++i) {
    if (std::isfinite(residual[i])) result.push_back(change[i] > thresholds::grazing_change);
  }
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

// Tests the fading law. Returns the law of readings: the stated one, or the one named here.
ReadingDistribution add_scatter(const LawSources& s, const ReadingDistribution& stated, const VectorXd& residual,
                                KrigedReadings& field, Diagnosis& found) {
  const auto [tests, likeliest] =
      law_tests(field, found.receiver.step, laws_of_causes(s), stated, s.state.fit.covariance, unsure(s, residual));
  const auto best = tests.begin();
  if (likeliest.noise > 0)
    found.notes.push_back("single readings scatter as normal noise does, of which the world states none");
  if (best == tests.end() || !beyond_chance(*best, thresholds::law_alpha)) return likeliest;
  if (!stated.base.law && replaces(s, best->cause)) return best->law;  // it contradicts nothing
  if (const std::string why = replaces(s, best->cause) ? of_receiver(s, residual, field, found) : ""; !why.empty()) {
    found.notes.push_back(why);
    return likeliest;
  }
  const double near = replaces(s, best->cause) ? 0 : beside_walls(s, residual, *best);
  if (near > 0) {
    found.notes.push_back(
        fmt::format("single readings scatter as by {} only where a move of {:.1f} m changes which walls their link "
                    "crosses: walls or "
                    "places may be so far off, and it is not named",
                    best->cause, near));
    return likeliest;
  }
  add_named(s, causes_that(s, [&](const Cause& c) { return c.id == best->cause; }), *best, found);
  for (const LawTest& other : tests) {
    const double gap = best->evidence - other.evidence;
    if (&other != &*best && gap < thresholds::open_law_nats)
      found.causes.back().alternatives.push_back({other.cause, "all", {}, gap, 2 * gap});
  }
  return best->law;
}

// log shadowing and log decorrelation distance of a fitted field.
Eigen::Vector2d shape_of(const LawSources& s, const noise::Covariance& covariance) {
  const noise::StatedField field = stated_by(covariance, s.state.within());
  return {std::log(field.shadowing), std::log(field.decorrelation)};
}

// True if the fitted field is one of those that rows of the world's own draws yield: Hotelling's T^2 of one more draw.
bool world_draws_alike(const LawSources& s, const Diagnosis& found) {
  constexpr int n = thresholds::field_draws;
  Eigen::Matrix2Xd shapes(2, n);
  for (int k = 0; k < n; ++k) {
    const WorldDraw draw = s.draws.draw(static_cast<uint64_t>(k), found.parameters, {});
    const VectorXd error = (draw.drawn - draw.expected)(s.used);
    if (!error.allFinite()) return false;
    shapes.col(k) = shape_of(s, fitted_to(s.state, s.state.rows().mean(error)));
  }
  const Eigen::Vector2d mean = shapes.rowwise().mean(), away = shape_of(s, s.state.fit.covariance) - mean;
  const Eigen::Matrix2Xd apart = shapes.colwise() - mean;
  const Eigen::Matrix2d spread = apart * apart.transpose() / (n - 1) + 1e-4 * Eigen::Matrix2d::Identity();
  const double t2 = away.dot(spread.inverse() * away) * n / (n + 1), f = t2 * (n - 2) / (2 * (n - 1));
  return std::pow(1 + 2 * f / (n - 2), -0.5 * (n - 2)) > thresholds::alike_field;  // tail of F with 2 and n - 2
}

// Causes that draw a field.
std::vector<const Cause*> fields_of(const LawSources& s) {
  return causes_that(s, [](const Cause& c) { return c.meaning().kind == MUSTER_LAW && c.plugin->draw; });
}

void add_tested(const std::vector<const Cause*>& causes, const std::string& why_not, Diagnosis& found) {
  for (const Cause* cause : causes)
    why_not.empty() ? found.searched.push_back(cause->id) : found.not_tested.push_back(cause->id + ": " + why_not);
}

void add_field(const LawSources& s, KrigedReadings& field, const ReadingDistribution& law, Diagnosis& found) {
  const std::vector<const Cause*> causes = fields_of(s);
  if (causes.empty()) return;
  const noise::StatedField said = drawn_field(s.model);
  add_tested(causes, said.shadowing > 0 ? "" : "not testable: the world states no shadowing", found);
  if (said.shadowing <= 0) return;
  LawTest test = field_test(field, found.receiver.step, law, said, s.state);
  const muster_draw& draw = *causes.front()->plugin->draw;
  test.values[0].name = draw.scale;
  test.values[1].name = draw.distance;
  // The field needs two tests to agree (shadowing_test.hpp).
  if (beyond_chance(test, thresholds::field_alpha) && !world_draws_alike(s, found)) add_named(s, causes, test, found);
}

// Each of the two laws can imitate the other: the weaker one is kept only if it is beyond doubt.
void leave_the_stronger(Diagnosis& found) {
  const auto weaker =
      std::min_element(found.causes.end() - 2, found.causes.end(),
                       [](const CauseEstimate& a, const CauseEstimate& b) { return a.lambda < b.lambda; });
  if (weaker->lambda < thresholds::second_law_lambda) found.causes.erase(weaker);
}

// Readings whose link, moved by 5 mm, crosses other walls are excluded from these tests. The link may pass on the
// other side, an error of a whole wall. Three of those among 20,000 readings resemble outliers.
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

// Twins count once, by their mean: they share what scatters.
VectorXd without_second_twins(const LinkReadings& readings, const noise::Rows& rows, VectorXd residual) {
  for (Index i = 0; i < residual.size(); ++i) {
    if (rows.is_second_twin(i)) continue;
    const Index other = readings.twin.empty() ? -1 : readings.twin[static_cast<std::size_t>(i)];
    if (other < 0) continue;
    residual[i] = (residual[i] + residual[other]) / 2;
    residual[other] = std::nan("");
  }
  return residual;
}

// Readings and the field about them, as the world states it where that fits.
KrigedReadings kriged(const LawSources& s, const VectorXd& residual) {
  const noise::Family fitted = s.state.fit.covariance.family;
  const std::vector<noise::Family> likely = s.state.likely_families(fitted);
  const bool as_drawn = std::any_of(likely.begin(), likely.end(), noise::is_stated);
  return {s.readings, residual, as_drawn ? s.state.field().sites().stated : nullptr, fitted};
}

const std::string shared = "not testable: readings of one place share a part of their scatter, such as multipath";

// Runs the tests on single readings in turn. Where the world states no law, normal noise and every law that could
// replace another are the null: what adds outliers must be likelier.
// `why`: they are not testable; empty if they are.
void add_laws_of_readings(const LawSources& s, const VectorXd& all, std::string why, Diagnosis& found) {
  ReadingDistribution stated = stated_law(s.model);
  VectorXd anew = stated.base.law ? drawn_anew(s, stated.base, all) : all;
  std::string of_base = stated.base.law ? "" : "not testable: no plugin of the world states a law of readings";
  if (stated.base.law && finite(anew) < thresholds::fewest_law_readings && repeat_places(s.readings)) {
    of_base = why_not(s, anew);  // one draw a link belongs to the field; what single readings do beside it is testable
    stated.base = {};
    anew = all;
  }
  std::vector<std::string> notes;
  std::optional<KrigedReadings> field;
  VectorXd residual;
  if (why.empty()) why = why_not(s, anew);
  if (why.empty()) {
    residual = without_grazing(s, anew, notes);
    field = kriged(s, residual);
    if (static_cast<Index>(field->judged().size()) < thresholds::fewest_law_readings)
      why = shared + ", and fewer than 300 repeat another one";
  }
  const std::string of_stated = !why.empty() || of_base.empty() ? why : of_base;
  for (const bool replacing : {false, true})
    add_tested(causes_that(s,
                           [&](const Cause& c) {
                             return c.meaning().kind == MUSTER_LAW && c.plugin->law && replaces(s, c.id) == replacing;
                           }),
               replacing ? of_stated : why, found);
  const std::string of_field =
      of_stated.empty() && noise::fixed_share(s.state.fit.covariance.family) > 0 ? shared : of_stated;
  if (!of_field.empty()) add_tested(fields_of(s), of_field, found);
  if (!why.empty()) return;
  found.notes.insert(found.notes.end(), notes.begin(), notes.end());
  const std::size_t before = found.causes.size();
  const ReadingDistribution law = add_scatter(s, stated, residual, *field, found);
  if (!of_field.empty()) return;
  add_field(s, *field, law, found);
  if (found.causes.size() == before + 2) leave_the_stronger(found);
}

// True if every effect found changes in time: it may be the blockage itself.
bool all_changes_in_time(const Diagnosis& found) {
  const auto in_time = [](const auto& one) { return one.changes_in_time(); };
  return std::all_of(found.causes.begin(), found.causes.end(), in_time) &&
         std::all_of(found.unexplained.begin(), found.unexplained.end(), in_time);
}

// What people who cross links leave to the tests of single readings.
struct Crossed {
  std::set<std::string> link;  // ends of the one that is blocked now and then; none if no one is
  bool all = false;            // they may cross any link
};

// What the world states of people.
std::optional<Crossed> stated_crossings(const LinkModel& model) {
  std::optional<Crossed> result;
  for (const auto& instance : model.simulation().instances()) {
    const muster_burst* const burst = instance->plugin().burst;
    if (!burst) continue;
    if (!result) result.emplace();
    const auto& given = instance->declared().attributes;
    result->all |= std::none_of(given.begin(), given.end(),
                                [&](const XmlAttribute& a) { return a.name == burst->one || a.name == burst->other; });
  }
  return result;
}

CauseEstimate& add_crossings(const LawSources& s, const std::vector<const Cause*>& causes, LawTest test,
                             Diagnosis& found) {
  const muster_burst& burst = *causes.front()->plugin->burst;
  const std::array names{burst.loss, burst.share, burst.duration};
  for (std::size_t k = 0; k < names.size(); ++k) test.values[k].name = names[k];
  return add_named(s, causes, test, found);
}

// Names the blocked link, or people who walk about in a standing network.
Crossed add_blockage(const LawSources& s, const VectorXd& residual, Diagnosis& found) {
  const std::vector<const Cause*> causes =
      causes_that(s, [](const Cause& c) { return c.meaning().kind == MUSTER_LAW && c.plugin->burst; });
  if (causes.empty()) return {};
  const std::optional<Crossed> stated = stated_crossings(s.model);
  if (s.data.t.empty() || stated) {
    add_tested(causes, s.data.t.empty() ? "not testable: the data have no t" : "", found);
    return stated && stated->all ? *stated : Crossed();
  }
  const WalkersTest walkers = walkers_test(s.readings, residual);
  if (!walkers.test.values.empty() && walkers.test.values.front().value > thresholds::least_walker_loss &&
      beyond_chance(walkers.test, thresholds::law_alpha)) {
    add_tested(causes, "", found);
    add_crossings(s, causes, walkers.test, found);
    return {{}, true};
  }
  const Blockage passages = blockage_test(s.state, s.readings, residual.array().isFinite());
  add_tested(causes, passages.links ? "" : "not testable: no link has 40 rows of readings that are no bounds", found);
  if (passages.radio < 0 || !beyond_chance(passages.test, thresholds::law_alpha) ||
      (passages.test.log_p > thresholds::blockage_in_company && !all_changes_in_time(found)))
    return {};
  const muster_burst& burst = *causes.front()->plugin->burst;
  CauseEstimate& out = add_crossings(s, causes, passages.test, found);
  out.row_parameter = burst.one;
  out.row = s.model.radio_name(passages.radio);
  const std::string other = out.words[burst.other] = s.model.radio_name(passages.other);
  out.label = "radio/" + out.row + " radio/" + other;
  for (inference::Alternative& alike : out.alternatives) alike.label = out.label;
  return {{out.row, other}};
}

// Excludes the blocked link, if there is one: its readings follow another law.
VectorXd without_link(const LawSources& s, const std::set<std::string>& ends, VectorXd residual) {
  const LinkReadings& r = s.readings;
  for (Index i = 0; i < residual.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (s.model.link_of(r.tx[k], r.rx[k]) == ends) residual[i] = std::nan("");
  }
  return residual;
}

}  // namespace

void add_laws(const LawSources& s, Diagnosis& found) {
  const VectorXd residual = residual_of(s, found);
  const Crossed crossed = add_blockage(s, residual, found);
  add_laws_of_readings(s, without_second_twins(s.readings, s.state.rows(), without_link(s, crossed.link, residual)),
                       crossed.all ? "not testable: people who cross the links change readings, too" : "", found);
}

}  // namespace muster::diagnosis
