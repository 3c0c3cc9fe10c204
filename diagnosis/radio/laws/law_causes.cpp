#include "diagnosis/radio/laws/law_causes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnosis/inference/state/null_tail.hpp"
#include "diagnosis/radio/laws/blockage_test.hpp"
#include "diagnosis/radio/laws/fading_tests.hpp"
#include "diagnosis/radio/laws/shadowing_test.hpp"
#include "diagnosis/radio/links/drawn_term.hpp"
#include "diagnosis/radio/thresholds.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

const Cause* cause_called(const LawSources& s, const std::string& id) {
  const auto found = std::find_if(s.causes.begin(), s.causes.end(), [&](const Cause& c) { return c.id == id; });
  return found == s.causes.end() ? nullptr : &*found;
}

CauseEstimate named(const LawSources& s, const Cause& cause, const LawTest& test) {
  CauseEstimate out;
  out.id = cause.id;
  out.label = "all";
  out.title = cause.meaning().title;
  out.tell_apart = cause.meaning().tell_apart;
  out.covariates = {"reading"};
  for (const LawValue& v : test.values) {
    const auto* const end = cause.plugin->params + cause.plugin->param_count;
    const auto* const p =
        std::find_if(cause.plugin->params, end, [&](const muster_param& q) { return q.name == v.name; });
    if (p == end) continue;
    out.values.push_back({v.name, p->unit, std::clamp(v.value, p->min, p->max),
                          (v.upper95 - v.lower95) / (2 * thresholds::normal95), v.lower95, v.upper95, p->min, p->max});
  }
  out.evidence = test.evidence;
  out.log_p = test.log_p;
  out.lambda = test.gain;
  out.effect = VectorXd::Zero(s.state.rows().size());
  return out;
}

bool beyond_chance(const LawTest& test, double share) { return test.evidence > 0 && test.log_p < std::log(share); }

// True if a stage of the world already clips there.
bool clips_at(const LawSources& s, const std::string& plugin, const std::string& parameter, double level, double step) {
  for (const auto& instance : s.model.simulation().instances()) {
    if (instance->declared().plugin != plugin) continue;
    const int at = instance->find_param(parameter);
    if (at >= 0 &&
        std::abs(instance->params()[static_cast<std::size_t>(at)] - level) <= std::max(step, thresholds::same_clip))
      return true;
  }
  return false;
}

void add_pile(const LawSources& s, const std::string& id, const Clip& clip, double step, Diagnosis& found) {
  const Cause* const cause = cause_called(s, id);
  if (!cause || clips_at(s, id, "level", clip.level, step)) return;
  const double half = std::max(step, 0.02) / 2;
  const LawTest test{
      id, {{"level", clip.level, clip.level - half, clip.level + half}}, -2 * clip.log_p, -clip.log_p, clip.log_p};
  found.causes.push_back(named(s, *cause, test));
  if (id == "effect.rssi_floor") found.causes.back().words["silent"] = "false";
}

// Fisher's combination of two independent tests.
double of_both(double log_p, double other) { return log_p + other + std::log1p(-log_p - other); }

// Tests for readings missing at low levels only. True if the cause is named.
bool add_silence(const LawSources& s, const MissingData& missing, Diagnosis& found) {
  const double step = found.receiver.step;
  const Cause* const cause = cause_called(s, "effect.rssi_floor");
  const double least = std::log(s.state.options().further_alpha / static_cast<double>(s.state.entries().size()));
  const double independent = missing.censored ? 1 : thresholds::joint_loss;  // neighbours are lost jointly
  const double gain = independent * missing.evidence;
  LawTest test{"effect.rssi_floor", {}, gain, gain / 2, inference::log_tail(gain, 1)};
  if (missing.cut_off && !missing.censored)
    test.log_p = of_both(test.log_p, independent * std::log(missing.none_below));
  if (!cause || !(missing.censored || missing.cut_off) || test.log_p > least) return false;
  if (clips_at(s, test.cause, "level", missing.floor, step) ||
      clips_at(s, "radio.receiver", "sensitivity", missing.floor, step))
    return false;
  const double half = std::max(step, 0.02);
  test.values = {{"level", missing.floor, missing.floor - half, missing.floor + half}};
  found.causes.push_back(named(s, *cause, test));
  found.causes.back().words["silent"] = "true";
  return true;
}

// Measured less expected, for each reading of the search; NaN for a censored reading or near a clip.
VectorXd residual_of(const LawSources& s, const Diagnosis& found) {
  const noise::Rows& rows = s.state.rows();
  VectorXd left(static_cast<Index>(s.used.size()));
  for (Index i = 0; i < left.size(); ++i) {
    const Index row = s.used[static_cast<std::size_t>(i)];
    left[i] = s.data.rssi[static_cast<std::size_t>(row)] - found.mean[row];
  }
  const VectorXd filled = left.array().isNaN().select(0, left);
  const VectorXd shift = found.seen.after - rows.mean(filled);
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

ReadingDistribution stated_law(const LinkModel& model) {
  ReadingDistribution law;
  law.rician_k = model.value_of("radio.fading", "fading", 1) != 0 ? model.value_of("radio.fading", "rician_k", 60) : 60;
  law.rician_k = model.value_of("effect.fading_law", "rician_k", law.rician_k);
  law.outliers = model.value_of("effect.outliers", "share", 0);
  law.half_width = model.value_of("effect.outliers", "half_width", law.half_width);
  law.channel_sd = model.value_of("effect.channel_mixture", "sd", 0);
  law.channels = static_cast<int>(model.value_of("effect.channel_mixture", "channels", 3));
  return law;
}

// True if fading differs between readings: they are half a wavelength apart, or per_reading is on.
bool fades_apart(const LawSources& s) {
  if (s.model.value_of("radio.fading", "per_reading", 0) != 0 || s.model.has_plugin("effect.fading_law")) return true;
  const double half = 299792458 / s.model.value_of("radio.fading", "frequency", 2.44e9) / 2;
  const LinkReadings& r = s.readings;
  std::vector<double> ways;
  for (Index i = 1; i < r.size(); ++i) {
    const auto row = s.state.rows().row_of()[static_cast<std::size_t>(i)];
    const Index first = s.state.rows().example(row);
    if (first != i)
      ways.push_back((r.rx_at.col(i) - r.rx_at.col(first)).norm() + (r.tx_at.col(i) - r.tx_at.col(first)).norm());
  }
  if (ways.empty()) return false;
  std::nth_element(ways.begin(), ways.begin() + static_cast<std::ptrdiff_t>(ways.size() / 2), ways.end());
  return ways[ways.size() / 2] > half;
}

// Reason why single readings are not testable; empty if they are.
std::string why_not(const LawSources& s, const VectorXd& residual) {
  if (!s.data.has_places()) return "not testable: the data have no places";
  if (!s.model.has_plugin("radio.fading")) return "not testable: the world has no radio.fading that states a law";
  if (!fades_apart(s)) return "not testable: readings lie closer than the half wavelength over which fading changes";
  if (residual.array().isFinite().count() < thresholds::fewest_law_readings)
    return "not testable: fewer than 300 readings that are no bounds";
  return "";
}

// Tests the fading law. Returns the law of readings: the stated one, or the one named here.
ReadingDistribution add_scatter(const LawSources& s, KrigedReadings& field, Diagnosis& found) {
  const auto [tests, likeliest] = law_tests(field, found.receiver.step, stated_law(s.model), s.state.fit.covariance);
  const auto best =
      std::find_if(tests.begin(), tests.end(), [&](const LawTest& t) { return cause_called(s, t.cause); });
  if (best == tests.end() || !beyond_chance(*best, thresholds::law_alpha)) return likeliest;
  found.causes.push_back(named(s, *cause_called(s, best->cause), *best));
  for (const LawTest& other : tests) {
    const double gap = best->evidence - other.evidence;
    if (&other != &*best && gap < thresholds::open_law_nats)
      found.causes.back().alternatives.push_back({other.cause, "all", {}, gap, 2 * gap});
  }
  return best->law;
}

// True if rows of a draw of the world's own shadowing yield the same fit as the data.
bool world_draws_alike(const LawSources& s) {
  const VectorXd drawn = s.model.drawn(), expected = s.model.expected();
  const VectorXd apart = (drawn - expected)(s.used);
  if (!apart.allFinite()) return false;
  const noise::StatedField own = stated_by(fitted_to(s.state, s.state.rows().mean(apart)), s.state.within());
  const noise::StatedField fitted = stated_by(s.state.fit.covariance, s.state.within());
  return std::abs(std::log(own.shadowing / fitted.shadowing)) < std::log(thresholds::alike_shadowing) &&
         std::abs(std::log(own.decorrelation / fitted.decorrelation)) < std::log(thresholds::alike_decorrelation);
}

void add_field(const LawSources& s, KrigedReadings& field, const ReadingDistribution& law, Diagnosis& found) {
  const Cause* const cause = cause_called(s, "effect.shadowing_correlation");
  if (!cause) return;
  const noise::StatedField said = drawn_field(s.model);
  if (said.shadowing <= 0) {
    found.not_tested.push_back(cause->id + ": not testable: the world states no shadowing");
    return;
  }
  found.searched.push_back(cause->id);
  const LawTest test = field_test(field, found.receiver.step, law, said, s.state);
  // The field needs two tests to agree (shadowing_test.hpp).
  if (beyond_chance(test, thresholds::field_alpha) && !world_draws_alike(s))
    found.causes.push_back(named(s, *cause, test));
}

// Each of the two laws can imitate the other: the weaker one is kept only if it is beyond doubt.
void leave_the_stronger(Diagnosis& found) {
  const auto weaker =
      std::min_element(found.causes.end() - 2, found.causes.end(),
                       [](const CauseEstimate& a, const CauseEstimate& b) { return a.lambda < b.lambda; });
  if (weaker->lambda < thresholds::second_law_lambda) found.causes.erase(weaker);
}

// Readings whose link passes within 5 mm of a wall's end are excluded from these tests. The link may pass on the
// other side, an error of a whole wall. Three of those among 20,000 readings resemble outliers.
VectorXd without_grazing(const LawSources& s, const VectorXd& residual, Diagnosis& found) {
  const VectorXd unsure = s.model.changes_aside(thresholds::grazing)(s.used);
  const auto grazes = unsure.array() > thresholds::grazing_change;
  if (const Index count = grazes.count())
    found.notes.push_back(fmt::format(
        "{} of {} readings pass within {:.0f} mm of where a wall ends: how single readings scatter is asked without "
        "them",
        count, residual.size(), 1000 * thresholds::grazing));
  return grazes.select(std::nan(""), residual);
}

// Runs the tests on single readings in turn.
void add_laws_of_readings(const LawSources& s, const VectorXd& all, Diagnosis& found) {
  const std::string why = why_not(s, all);
  for (const char* id : {"effect.fading_law", "effect.outliers", "effect.channel_mixture"}) {
    if (!cause_called(s, id)) continue;
    why.empty() ? found.searched.push_back(id) : found.not_tested.push_back(std::string(id) + ": " + why);
  }
  if (!why.empty()) {
    if (cause_called(s, "effect.shadowing_correlation"))
      found.not_tested.push_back("effect.shadowing_correlation: " + why);
    return;
  }
  const std::vector<noise::Family> likely = s.state.likely_families(s.state.fit.covariance.family);
  const bool as_drawn = std::any_of(likely.begin(), likely.end(), noise::is_stated);
  KrigedReadings field(s.readings, without_grazing(s, all, found), as_drawn ? s.state.field().sites().stated : nullptr);
  const std::size_t before = found.causes.size();
  const ReadingDistribution law = add_scatter(s, field, found);
  add_field(s, field, law, found);
  if (found.causes.size() == before + 2) leave_the_stronger(found);
}

// True if every effect found changes in time: it may be the blockage itself.
bool all_changes_in_time(const Diagnosis& found) {
  const auto in_time = [](const auto& one) { return one.changes_in_time(); };
  return std::all_of(found.causes.begin(), found.causes.end(), in_time) &&
         std::all_of(found.unexplained.begin(), found.unexplained.end(), in_time);
}

// True if blockage is named.
bool add_people(const LawSources& s, const VectorXd& residual, Diagnosis& found) {
  const Cause* const cause = cause_called(s, "effect.people");
  if (!cause) return false;
  if (s.data.t.empty()) {
    found.not_tested.push_back(cause->id + ": not testable: the data have no t");
    return false;
  }
  if (s.model.has_plugin(cause->id)) {
    found.searched.push_back(cause->id);
    return false;
  }
  const Blockage passages = blockage_test(s.state, s.readings, residual.array().isFinite());
  if (passages.links == 0) {
    found.not_tested.push_back(cause->id + ": not testable: no link has 40 rows of readings that are no bounds");
    return false;
  }
  found.searched.push_back(cause->id);
  if (passages.radio < 0 || !beyond_chance(passages.test, thresholds::law_alpha) ||
      (passages.test.log_p > thresholds::people_in_company && !all_changes_in_time(found)))
    return false;
  CauseEstimate out = named(s, *cause, passages.test);
  out.row_parameter = "radio";
  out.row = s.model.radio_name(passages.radio);
  out.words["other"] = s.model.radio_name(passages.other);
  out.label = "radio/" + out.row + " radio/" + out.words["other"];
  found.causes.push_back(std::move(out));
  return true;
}

// Excludes the blocked link: its readings follow another law.
VectorXd without_link(const LawSources& s, const CauseEstimate& people, VectorXd residual) {
  const LinkReadings& r = s.readings;
  for (Index i = 0; i < residual.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (s.model.link_of(r.tx[k], r.rx[k]) == std::set{people.row, people.words.at("other")}) residual[i] = std::nan("");
  }
  return residual;
}

}  // namespace

void add_clips(const LawSources& s, Diagnosis& found) {
  const double step = found.receiver.step;
  if (cause_called(s, "effect.rssi_saturation")) found.searched.push_back("effect.rssi_saturation");
  if (cause_called(s, "effect.rssi_floor")) found.searched.push_back("effect.rssi_floor");
  if (found.receiver.top) add_pile(s, "effect.rssi_saturation", *found.receiver.top, step, found);
  if (found.receiver.bottom) add_pile(s, "effect.rssi_floor", *found.receiver.bottom, step, found);
  if (!found.receiver.bottom) add_silence(s, s.fit.missing, found);
}

bool add_silence_beside(const LawSources& s, const VectorXd& mean, Diagnosis& found) {
  const auto floor = [](const CauseEstimate& c) { return c.id == "effect.rssi_floor"; };
  if (s.fit.missing.count == 0 || found.receiver.bottom || !found.named() ||
      std::any_of(found.causes.begin(), found.causes.end(), floor))
    return false;
  const VectorXd& rssi = s.fit.readings.rssi;
  const Eigen::Array<bool, Eigen::Dynamic, 1> heard = !rssi.array().isNaN();
  const double squares = heard.select((rssi - mean).array().square(), 0).sum();
  return add_silence(s, missing_data(rssi, mean, std::sqrt(squares / static_cast<double>(heard.count()))), found);
}

void add_laws(const LawSources& s, Diagnosis& found) {
  const VectorXd residual = residual_of(s, found);
  add_laws_of_readings(s, add_people(s, residual, found) ? without_link(s, found.causes.back(), residual) : residual,
                       found);
}

}  // namespace muster::diagnosis
