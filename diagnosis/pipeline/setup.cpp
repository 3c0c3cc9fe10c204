#include "diagnosis/pipeline/setup.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/calibration/data_doubts.hpp"
#include "diagnosis/inference/assess/search.hpp"
#include "diagnosis/inference/thresholds.hpp"
#include "diagnosis/radio/causes/cheap_columns.hpp"
#include "diagnosis/radio/causes/link_cause_domain.hpp"
#include "diagnosis/radio/laws/law_sources.hpp"
#include "diagnosis/radio/links/drawn_term.hpp"
#include "diagnosis/radio/links/geometry_checks.hpp"
#include "diagnosis/radio/links/stated_clip.hpp"
#include "diagnosis/radio/links/twin_readings.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Fixes places and times of causes already in the world. Strengths are fitted, except of random laws, which do not
// affect means.
FitOptions hold_causes(const LinkModel& model) {
  FitOptions options;
  for (const auto& instance : model.simulation().instances()) {
    const muster_plugin& plugin = instance->plugin();
    if (!plugin.cause) continue;
    for (uint32_t k = 0; k < plugin.param_count; ++k) {
      const muster_param& p = plugin.params[k];
      if (p.kind == MUSTER_REAL && (p.flags & MUSTER_FREE) &&
          (!(p.flags & MUSTER_LINEAR) || plugin.cause->kind == MUSTER_LAW))
        options.fix.push_back(instance->name() + '/' + p.name);
    }
  }
  return options;
}

std::vector<std::string> joined(std::initializer_list<std::vector<std::string>> lists) {
  std::vector<std::string> result;
  for (const auto& list : lists) result.insert(result.end(), list.begin(), list.end());
  return result;
}

// Twins among what was measured as a value: bounds have no difference.
LinkReadings with_twins(LinkReadings readings, const ObservedLevels& levels, double step) {
  VectorXd residual =
      levels.measured - Eigen::Map<const VectorXd>(readings.level.data(), static_cast<Index>(readings.level.size()));
  for (std::size_t i = 0; i < levels.bounds.known.size(); ++i) {
    if (levels.bounds.known[i] != noise::Known::value) residual[static_cast<Index>(i)] = std::nan("");
  }
  find_twins(readings, residual, step);
  return readings;
}

LinkLayout layout_of(LinkReadings readings, const ObservedColumns& observed, bool places_known,
                     const LinkModel& model) {
  readings.setting = settings_of(observed);
  LinkRowLimits limits = limits_for(readings);
  if (!places_known) limits.way = -1;  // equal distances are not one place: each reading is a row
  return {std::move(readings), limits, observed.run, places_known, places_known ? drawn_correlation(model) : nullptr};
}

// Levels as they were received, before they were referred to one power.
VectorXd received_in(const Dataset& data) {
  VectorXd levels = Eigen::Map<const VectorXd>(data.rssi.data(), static_cast<Index>(data.rssi.size()));
  if (!data.referred.empty()) levels += Eigen::Map<const VectorXd>(data.referred.data(), levels.size());
  return levels;
}

CauseSearch candidates_of(const DiagnosisSetup& at, const LinkSearchWorld& world) {
  CauseSearch found = cause_candidates(at.causes, LinkCauseDomain(at.model, at.data, at.used.rows, at.rows),
                                       {at.run, at.used.rows}, at.base.slopes(at.used.rows, Eigen::all), at.rows);
  found = with_swaps_by_the_map(std::move(found), world, at.fitted, *at.run);
  return with_columns_near(with_sketches(std::move(found), at.sketched, at.rows), world);
}

// True if twins share their scatter in both or in neither: in the data, and in a run of the world with these errors.
bool has_twins_like(const LinkReadings& data, const VectorXd& errors) {
  LinkReadings run = data;
  find_twins(run, errors);
  return run.twin.empty() == data.twin.empty();
}

// Errors of the readings in runs of the world itself. A reading that a run loses has none. No runs, if one fade is of
// both directions there and not in the data, or the other way round: their scatter tells nothing of that in the data.
std::function<Eigen::MatrixXd(const noise::StatedField&, Index)> errors_in_draws(const DiagnosisSetup& at) {
  if (drawn_field(at.model).shadowing <= 0) return {};
  return [&at](const noise::StatedField& field, Index draws) {
    Eigen::MatrixXd errors(static_cast<Index>(at.used.rows.size()), draws);
    for (Index k = 0; k < draws; ++k) {
      const WorldDraw draw = at.draws.draw(static_cast<uint64_t>(k), {}, field);
      const VectorXd error = (draw.drawn - draw.expected)(at.used.rows);
      errors.col(k) = error.array().isFinite().select(error, 0);
      if (k == 0 && !has_twins_like(at.layout->readings(), error)) return Eigen::MatrixXd(errors.rows(), 0);
    }
    return errors;
  };
}

// A table that tells of readings that are missing keeps them as bounds instead. Readings that are all stronger than
// what the world's receiver can hear end nowhere, and those of a better receiver end elsewhere.
std::optional<double> end_of(const DiagnosisSetup& at, const Earlier& earlier) {
  if (at.fitted.missing.count > 0) return {};
  const std::optional<double> level = earlier.end ? earlier.end : silent_below(at.model.simulation(), {});
  const double weakest = at.fitted.readings.received(at.fitted.readings.rssi).minCoeff();
  return level && std::abs(weakest - *level) <= thresholds::reaches_a_floor ? level : std::nullopt;
}

// Readings are as exact as their steps allow, not more: their places and the plan are not. Where the world draws a
// field, means over rows and nearest neighbours stand for it, which are less exact.
double log_least_variance(double step, const LinkModel& model) {
  const double usual = noise::Prior().log_least_variance;
  if (drawn_field(model).shadowing > 0 ||
      std::sqrt(base_variance(stated_law(model))) > thresholds::least_stated_scatter)
    return usual;
  return std::clamp(std::log(std::max(step * step / 12, 1e-30)), thresholds::log_exact_variance, usual);
}

inference::Options options_for(double step, const LinkModel& model) {
  inference::Options options;
  options.prior.log_least_variance = log_least_variance(step, model);
  noise::Prior longer = options.prior;
  longer.decorrelation_spread = thresholds::outdoor_decorrelation_spread;
  longer.log_longest =
      std::log(thresholds::longest_decorrelation_share * scale_of(model) * thresholds::extent_of_a_building);
  if (longer.log_longest > options.prior.log_longest) options.longer = longer;
  return options;
}

inference::Problem problem_of(const DiagnosisSetup& at) {
  ObservedLevels levels = observed_levels(at.data, at.receiver, at.fitted.readings, at.used.rows);
  inference::Problem problem;
  problem.layout = at.layout;
  problem.measured = levels.measured - at.base.offset()(at.used.rows);
  problem.bounds = std::move(levels.bounds);
  if (at.end) {
    const VectorXd referred = at.fitted.readings.referred.size() ? VectorXd(at.fitted.readings.referred(at.used.rows))
                                                                 : VectorXd::Zero(problem.measured.size());
    problem.bounds.end = (*at.end - at.receiver.step / 2) - (at.base.offset()(at.used.rows) + referred).array();
  }
  problem.base = at.base.slopes(at.used.rows, Eigen::all);
  for (const CauseCandidate& c : at.sought.found) problem.candidates.push_back(c.candidate);
  problem.smooths = link_smooths(at.layout->readings(), at.observed.columns, at.data.has_places());
  problem.stated = drawn_field(at.model);
  problem.drawn = errors_in_draws(at);
  return problem;
}

}  // namespace

DiagnosisSetup::DiagnosisSetup(const std::filesystem::path& world, const std::filesystem::path& table,
                               const Library::SearchPath& plugins, const std::shared_ptr<TableCache>& tables,
                               const Earlier& earlier)
    : file(table),
      data(read_dataset(tables->read(table))),
      receiver(receiver_checks(data)),
      model(world, table, plugins, tables),
      draws(world, table, plugins, tables, receiver.step,
            unstated_floors(model.simulation(), earlier.end ? earlier.end : weakest_of_some(received_in(data)))),
      causes(causes_on(plugins)),
      notes_of_places(data.has_places() ? check_places(model, data) : std::vector<std::string>{}),
      fitted(fit(model, data, hold_causes(model))),
      end(end_of(*this, earlier)),
      base(sensitivities(model, fitted.parameters)),
      used(used_rows(model, data, earlier.expected.size() > 0 ? earlier.expected : fitted.mean, fitted.rows_used())),
      notes(joined({data.notes, notes_on_radios(model, data), doubts_of(model, data), notes_of_places, used.notes})),
      run(std::make_shared<CauseModel>(model, world, table, plugins)),
      observed(observed_columns(data, used.rows)),
      layout(std::make_shared<const LinkLayout>(
          layout_of(with_twins(observed_readings(data, model, used.rows, base.mean),
                               observed_levels(data, receiver, fitted.readings, used.rows), receiver.step),
                    observed, data.has_places(), model))),
      rows(layout->rows()),
      sketched(sketched_readings({world, table, plugins, model, base, used.rows, layout, rows})),
      sought(candidates_of(*this, {world, table, plugins, model, base, used.rows, layout, rows})),
      problem(problem_of(*this)),
      options(options_for(receiver.step, model)) {}

}  // namespace muster::diagnosis
