#include "diagnosis/pipeline/diagnoser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <tuple>

#include "diagnosis/pipeline/cause_estimate.hpp"
#include "diagnosis/pipeline/cause_files.hpp"
#include "diagnosis/pipeline/exchanged_identity.hpp"
#include "diagnosis/pipeline/first_cause.hpp"
#include "diagnosis/pipeline/joint_refit.hpp"
#include "diagnosis/pipeline/own_world.hpp"
#include "diagnosis/pipeline/relative_to_given.hpp"
#include "diagnosis/pipeline/row_summary.hpp"
#include "diagnosis/pipeline/setup.hpp"
#include "diagnosis/pipeline/time_or_place.hpp"
#include "diagnosis/pipeline/unstated_field.hpp"
#include "diagnosis/planning/measurement_plans.hpp"
#include "diagnosis/planning/second_station.hpp"
#include "diagnosis/radio/causes/applicability.hpp"
#include "diagnosis/radio/laws/clip_causes.hpp"
#include "diagnosis/radio/laws/law_causes.hpp"
#include "diagnosis/radio/links/measurement_geometry.hpp"
#include "diagnosis/radio/links/moving_end.hpp"
#include "diagnosis/radio/links/stated_clip.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Sets the world to these parameters during its lifetime, without inserted causes before and after.
class AtBase {
 public:
  AtBase(DiagnosisSetup& setup, const VectorXd& values) : run_(*setup.run), moved_(setup.model) {
    run_.clear();
    for (std::size_t j = 0; j < setup.base.paths.size(); ++j)
      moved_.set(setup.base.paths[j], values[static_cast<Index>(j)]);
  }
  ~AtBase() { run_.clear(); }
  AtBase(const AtBase&) = delete;
  AtBase& operator=(const AtBase&) = delete;

 private:
  CauseModel& run_;
  ParameterGuard moved_;
};

// True for a law of what lasts for a while.
bool is_burst(const CauseEstimate& c, const std::vector<Cause>& causes) {
  return std::any_of(causes.begin(), causes.end(),
                     [&](const Cause& cause) { return cause.id == c.id && cause.plugin->burst; });
}

// What was heard of readings that are lost the oftener the weaker they are is a biased sample of all. The floor below
// which they are lost is seen by just that.
void doubt_where_lost(const MissingData& missing, const std::vector<Cause>& causes, Diagnosis& out) {
  const double all = static_cast<double>(out.readings + missing.count),
               share = static_cast<double>(missing.count) / std::max(all, 1.0);
  if (missing.censored || !missing.rises() || share < thresholds::biased_share) return;
  const auto is_floor = [&](const CauseEstimate& c) {
    return std::any_of(causes.begin(), causes.end(), [&](const Cause& cause) {
      return cause.id == c.id && clips(*cause.plugin, MUSTER_BELOW, true);
    });
  };
  for (CauseEstimate& c : out.causes) {
    if (c.doubt.empty() && !is_floor(c))
      c.doubt = fmt::format(
          "{:.0f} % of the readings are lost, and more where less is expected: those that were heard "
          "are a biased sample",
          100 * share);
  }
}

}  // namespace

void in_order(Diagnosis& out) {
  // Where nothing else was found in the given world, nothing was left out there, and all are compared by what they
  // explain.
  const bool by_explained = std::any_of(out.causes.begin(), out.causes.end(),
                                        [](const CauseEstimate& c) { return c.corrected_first && !c.held_out; });
  // Where each radio has one place, a place that is left out takes all with it that would tell of its radio.
  const auto gain = [&](const CauseEstimate& c) {
    if (by_explained) return 0.0;
    double result = c.held_out ? c.held_out->gain : 0;
    for (const inference::Elsewhere& e : c.elsewhere) {
      if (out.time_unit > 0) result = std::max(result, e.held_out.gain);
    }
    return result;
  };
  std::stable_sort(out.causes.begin(), out.causes.end(), [&](const CauseEstimate& a, const CauseEstimate& b) {
    return std::tuple(a.status, !a.doubt.empty(), -gain(a), -a.lambda) <
           std::tuple(b.status, !b.doubt.empty(), -gain(b), -b.lambda);
  });
  std::sort(out.searched.begin(), out.searched.end());
}

Diagnosis interrupted(Diagnosis found) {
  found.interrupted = true;
  found.notes.emplace_back(
      "interrupted: these are the findings so far. More may be wrong, and not every explanation was tried");
  return found;
}

Diagnoser::Diagnoser(const std::filesystem::path& world, const std::filesystem::path& file,
                     const Library::SearchPath& plugins, const std::shared_ptr<TableCache>& tables,
                     const inference::Watch& watch, const Earlier& earlier, const std::string& without_law)
    : watch_(watch),
      setup_(world, file, plugins, tables, earlier),
      moved_(setup_.model),
      causes_(setup_.causes),
      world_(world),
      plugins_(plugins) {
  std::erase_if(causes_, [&](const Cause& cause) { return cause.id == without_law; });
}

Diagnosis Diagnoser::run(const Diagnosis* given, bool by_itself) {
  inference::Options options = setup_.options;
  options.watch = watch_;
  inference::Search search(setup_.problem, options);
  const inference::Result result = search.run();
  setup_.run->clear();
  Diagnosis out = summed_up(result, setup_.sought, search.state());
  if (given) begin_as_given(*given, by_itself, {setup_, search.state(), measured(search.state())}, out);
  doubt_where_lost(setup_.fitted.missing, setup_.causes, out);
  watch_.at("working out what to measure next");
  if (!watch_.stop())
    add_advice(search, out, setup_.sought, {world_, plugins_, setup_.model, setup_.data}, setup_.base,
               setup_.layout->limits());
  for (const auto* more : {&setup_.sought.not_tested, &setup_.observed.untested})
    out.not_tested.insert(out.not_tested.end(), more->begin(), more->end());
  const LinkReadings& readings = setup_.layout->readings();
  if (const MovingEnds moving = moving_ends(readings);
      !(readings.rx_yaw.empty() && readings.tx_yaw.empty()) && moving.known_headings() < 1)
    out.not_tested.push_back(fmt::format(
        "heading: of {:.0f} % of the readings the data give only that of the radio that moves less{}",
        std::ceil(100 * (1 - moving.known_headings())), moving.headings_known() ? "; the others are looked at" : ""));
  return watch_.stop() ? interrupted(std::move(out)) : out;
}

std::optional<CauseEstimate> Diagnoser::exchange(const CauseEstimate& instead_of, const Diagnosis& found) {
  return exchange_instead_of(instead_of, setup_, found);
}

OwnWorldVerdict Diagnoser::in_own_worlds(const Diagnosis& found) {
  watch_.at("checking the map and the log for mistakes");
  return judged_in_own_worlds(setup_, found);
}

Diagnosis Diagnoser::summed_up(const inference::Result& result, const CauseSearch& causes,
                               const inference::ModelState& state) {
  Diagnosis out;
  out.notes = setup_.notes;
  out.added_radios = added_radios();
  if (const MissingData& m = setup_.fitted.missing; !m.censored && m.rises())
    out.notes.push_back(fmt::format(
        "more readings are missing where less is expected ({:.0f} % at {:.0f} dBm, {:.0f} % at {:.0f} dBm): what was "
        "heard are the stronger ones, so weak levels look too high and the exponent too low",
        100 * m.bins.front().missing / m.bins.front().rows, m.bins.front().level,
        100 * m.bins.back().missing / m.bins.back().rows, m.bins.back().level));
  const std::size_t bounds = setup_.fitted.readings.censored.size(), missing = setup_.fitted.missing.count;
  if (bounds > 0 && bounds < missing)
    out.notes.push_back(
        fmt::format("{} of {} missing readings were lost otherwise than below the floor, amid others far above it or "
                    "in a silence of "
                    "all links: they say nothing of the level there",
                    missing - bounds, missing));
  if (result.aside > 0)
    out.notes.push_back(
        fmt::format("{} readings, each five standard errors or more from what all others let expect, were set aside "
                    "while structure "
                    "was sought: every wall and every thing would have been drawn to them",
                    result.aside));
  for (const std::string& blind : setup_.fitted.not_identifiable) out.notes.push_back("not identifiable: " + blind);
  out.residual_sd = setup_.fitted.residual_sd;
  out.noise = result.noise.covariance;
  out.time_unit = state.time_unit();
  out.unstated_field = unstated_field(setup_, state, out.noise);
  if (result.stays)
    out.stays =
        Stays{static_cast<int>(result.stays->stays), std::sqrt(result.stays->between), std::sqrt(result.stays->within)};
  out.held_out = result.held_out;
  out.unseen = result.unseen;
  out.elsewhere = result.elsewhere;
  out.used = setup_.used.rows;
  out.readings = setup_.used.rows.size();
  out.levels = state.measured() + setup_.base.offset()(setup_.used.rows);
  out.rows = state.rows().size();
  out.row_limits = setup_.layout->limits();
  const VectorXd coefficients = result.base_coefficients.cwiseMax(setup_.base.lower).cwiseMin(setup_.base.upper);
  for (std::size_t j = 0; j < setup_.base.paths.size(); ++j)
    out.parameters[setup_.base.paths[j]] = coefficients[static_cast<Index>(j)];
  std::vector<std::vector<Eigen::Vector2d>> places;  // of each cause
  for (std::size_t k = 0; k < result.findings.size(); ++k) {
    const inference::Finding& f = result.findings[k];
    const auto cause = std::find_if(causes.found.begin(), causes.found.end(),
                                    [&](const CauseCandidate& c) { return c.candidate.id == f.id; });
    if (f.status == inference::Status::unexplained || cause == causes.found.end()) {
      out.unexplained.push_back(
          {f.id.substr(f.id.rfind('~') + 1), f.evidence, f.gain, f.held_out, f.elsewhere, f.alternatives, f.reach});
      std::erase_if(out.unexplained.back().alternatives,
                    [](const inference::Alternative& r) { return r.id[0] == '~'; });
      continue;
    }
    const auto [finding, candidate] = simplest(f, *cause, causes, state, coefficients);
    out.causes.push_back(cause_estimate(finding, *candidate));
    out.causes.back().sought_as = f.id;
    out.causes.back().words.merge(names_of_instances(candidate->shape->cause, setup_.model.simulation()));
    out.causes.back().doubt = doubt_by_place(*candidate, f.alternatives, causes.found);
    out.causes.back().effect = effect_of(state, candidate->candidate, finding);
    places.push_back(places_of(*candidate->shape, finding));
    give_files(*candidate->shape, setup_.data, out.causes.back());
  }
  setup_.run->clear();
  for (const CauseCandidate& c : causes.found) out.searched.push_back(c.candidate.id);
  out.receiver = setup_.receiver;
  out.seen = row_summary(state, *setup_.layout, setup_.observed.columns, setup_.model);
  for (std::size_t k = 0; k < places.size(); ++k)
    out.causes[k].one_station = seen_from_one_station(out.seen, out.causes[k].effect, places[k]);
  const inference::WhitenedModel alone = state.whitened_model(state.base());
  out.fitted = setup_.base.mean + setup_.base.slopes * (alone.coefficients(state.base().cols()) - setup_.base.values);
  out.checks = result.checks;
  add_what_scatters(state, out);
  doubt_by_maps(causes, out);
  in_order(out);
  out.stairs = result.stairs;
  out.world_values = world_values(state, setup_.base.paths, coefficients, setup_.model);
  for (WorldValue& v : out.world_values) {
    v.value = out.parameters.at(v.path);
    v.identifiable = std::none_of(setup_.fitted.parameters.begin(), setup_.fitted.parameters.end(),
                                  [&](const FitParameter& p) { return p.path == v.path && !p.identifiable; });
  }
  doubt_at_bounds(out);
  return out;
}

// Of the places as they are told: fitted jointly with the world.
void Diagnoser::doubt_by_maps(const CauseSearch& causes, Diagnosis& out) const {
  for (CauseEstimate& c : out.causes) {
    const auto sought = std::find_if(causes.found.begin(), causes.found.end(),
                                     [&](const CauseCandidate& one) { return one.candidate.id == c.id; });
    if (c.doubt.empty() && sought != causes.found.end()) c.doubt = doubt_by_map(*sought->shape, c, setup_.model);
  }
}

std::vector<AddedRadio> Diagnoser::added_radios() const {
  const MeasurementGeometry geometry = measurement_geometry(setup_.model, setup_.data);
  std::vector<AddedRadio> result;
  for (const std::string& radio : setup_.model.added_radios()) {
    const auto at = setup_.model.first_end(radio);
    if (at) result.push_back({radio, at->x, at->y, at->z, !geometry.moves[static_cast<std::size_t>(at->radio)]});
  }
  return result;
}

// Doubts all causes if a parameter of the channel's own law is at its physical bound. The law then does not fit, and
// causes may only absorb its misfit. A material without loss, or a cause, may well be at a bound.
void Diagnoser::doubt_at_bounds(Diagnosis& out) const {
  const auto& instances = setup_.model.simulation().instances();
  std::string ends;
  for (std::size_t j = 0; j < out.world_values.size(); ++j) {
    WorldValue& v = out.world_values[j];
    const double lower = setup_.base.lower[static_cast<Index>(j)], upper = setup_.base.upper[static_cast<Index>(j)];
    v.at_bound = std::min(v.value - lower, upper - v.value) <= thresholds::at_bound * (upper - lower);
    const bool of_law = std::any_of(instances.begin(), instances.end(), [&](const auto& i) {
      return !i->plugin().cause && v.path.rfind(i->name() + '/', 0) == 0;
    });
    if (v.at_bound && of_law) ends += (ends.empty() ? "" : ", ") + v.path;
  }
  if (ends.empty()) return;
  const std::string doubt =
      at_its_bound + ends + ", so that the world cannot follow these readings and no name is sure";
  out.notes.push_back(doubt);
  for (CauseEstimate& c : out.causes) c.doubt = doubt;
}

// Replaces a strength by a simpler cause if it is compatible with no effect of its row: a wall of zero loss is an
// absent wall. The simpler cause is evaluated at the base parameters fitted beside the findings.
std::pair<inference::Finding, const CauseCandidate*> Diagnoser::simplest(const inference::Finding& f,
                                                                         const CauseCandidate& cause,
                                                                         const CauseSearch& causes,
                                                                         const inference::ModelState& state,
                                                                         const VectorXd& base) {
  if (cause.shape->columns() != 1 || cause.shape->linear.empty() || cause.candidate.refinement.any())
    return {f, &cause};
  const VectorXd own = state.columns_of(cause.candidate, f.theta);
  const AtBase at(setup_, base);
  for (const CauseCandidate& other : causes.found) {
    if (!other.candidate.design.whole || other.candidate.refinement.any()) continue;
    VectorXd theta = other.candidate.design.grid[0];
    for (std::size_t row = 0; row < other.shape->rows.size(); ++row) {  // also rows outside the grid
      theta[0] = static_cast<double>(row);
      if (f.label.empty() || other.shape->row_label(theta) != f.label) continue;
      const VectorXd none = state.columns_of(other.candidate, theta);
      const double product = own.dot(none), strength = product / own.squaredNorm();
      if (product * product < thresholds::no_effect_alike * own.squaredNorm() * none.squaredNorm() ||
          std::abs(f.coefficients[0] - strength) > thresholds::normal95 * std::sqrt(f.uncertainty(0, 0)))
        continue;
      inference::Finding simple = f;
      simple.id = other.candidate.id;
      simple.theta = theta;
      simple.thetas = {theta};
      simple.coefficients = f.coefficients / strength;
      simple.uncertainty = f.uncertainty / (strength * strength);
      std::erase_if(simple.alternatives, [&](const inference::Alternative& r) { return r.id == simple.id; });
      return {simple, &other};
    }
  }
  return {f, &cause};
}

void Diagnoser::add_what_scatters(const inference::ModelState& state, Diagnosis& out) {
  const LawSources sources{setup_.model,     setup_.draws,  setup_.data, causes_, state, setup_.layout->readings(),
                           setup_.used.rows, setup_.fitted, setup_.end};
  watch_.at("testing the laws of fading and outliers");
  if (watch_.stop()) {
    extend(state, out);
    return in_order(out);
  }
  add_clips(sources, out);
  const VectorXd mean = extend(state, out);
  if (add_silence_beside(sources, mean, out) || add_truncation(sources, out)) extend(state, out);
  const std::size_t before = out.causes.size();
  add_laws(sources, out);
  if (out.causes.size() > before) extend(state, out);  // a fading law changes the mean
  for (CauseEstimate& c : out.causes) {
    if (c.doubt.empty()) c.doubt = doubt_at_own_bound(c);
    if (c.doubt.empty()) c.doubt = doubt_by_imitator(c, out.checks, causes_);
    if (c.doubt.empty() && out.stays && is_burst(c, causes_))
      c.doubt = "what differs from stay to stay has no name yet, and may be all that it explains";
  }
  in_order(out);
  if (std::string_view(out.verdict()) == "adequate") out.other_scatter = other_scatter(setup_, state);
}

VectorXd Diagnoser::measured(const inference::ModelState& state) const {
  const VectorXd offset = setup_.base.offset()(setup_.used.rows);
  return state.y() + state.rows().mean(offset);
}

// Expected level of every reading in the extended world, dBm.
VectorXd Diagnoser::extend(const inference::ModelState& state, Diagnosis& out) {
  out.mean = VectorXd::Constant(setup_.base.mean.size(), std::nan(""));
  VectorXd mean = refit_jointly({setup_.model, moved_, causes_, setup_.file, state, setup_.used.rows, measured(state)},
                                setup_.base.lower, setup_.base.upper, setup_.base.paths, out);
  out.mean(setup_.used.rows) = mean(setup_.used.rows);
  return mean;
}

}  // namespace muster::diagnosis
