#include "diagnosis/pipeline/setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "diagnosis/inference/assess/search.hpp"
#include "diagnosis/radio/causes/link_cause_domain.hpp"
#include "diagnosis/radio/causes/local_columns.hpp"
#include "diagnosis/radio/laws/shadowing_test.hpp"
#include "diagnosis/radio/links/geometry_checks.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Causes that the world holds already keep their places and times; how strong they are is fitted, but for laws of what
// is random, which means say nothing of.
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

std::string attribute_of(const InstanceDeclaration& instance, const std::string& name) {
  for (const XmlAttribute& a : instance.attributes) {
    if (a.name == name) return a.value;
  }
  return "";
}

}  // namespace

// Nobody knows when people came, so that their bursts would look like whatever changes in time. A radio that is heard
// on its crossed link alone keeps it.
void DiagnosisSetup::leave_out_crossed_links() {
  for (const auto& instance : model.simulation().instances()) {
    const InstanceDeclaration& declared = instance->declared();
    const std::string one = attribute_of(declared, "radio"), other = attribute_of(declared, "other");
    if (declared.plugin != "effect.people" || one.empty() || other.empty()) continue;
    std::vector<Index> left;
    std::size_t of_one = 0, of_other = 0;  // of what is left
    for (const Index row : used) {
      const auto& [tx, rx] = model.ends()[static_cast<std::size_t>(row)];
      const std::set<std::string> ends = model.link_of(tx.radio, rx.radio);
      if (ends == std::set{one, other}) continue;
      of_one += ends.count(one);
      of_other += ends.count(other);
      left.push_back(row);
    }
    if (std::min(of_one, of_other) < (used.size() - left.size()) / 2) continue;
    data.notes.push_back(
        fmt::format("people cross the link {} {} of the world: its {} readings are left out of the search", one, other,
                    used.size() - left.size()));
    used = std::move(left);
  }
}

DiagnosisSetup::DiagnosisSetup(const std::filesystem::path& world, const std::filesystem::path& table,
                               const Library::SearchPath& plugins)
    : file(table), data(read_dataset(table)), model(world, table, plugins), causes(causes_on(plugins)) {
  instrument = receiver_checks(data);
  note_radios(model, data);
  if (data.has_places()) check_places(model, data);
  fitted = fit(model, data, hold_causes(model));
  base = sensitivities(model, fitted.parameters);
  for (const std::size_t row : fitted.rows_used()) used.push_back(static_cast<Index>(row));
  leave_out_crossed_links();
  if (static_cast<Index>(used.size()) < inference::fewest_readings)
    throw invalid({data.table.file()}, fmt::format("the table has {} readings to search; expected at least {}",
                                                   used.size(), inference::fewest_readings));
  run = std::make_shared<CauseModel>(model, world, table, plugins);
  LinkReadings readings = readings_of_search();
  problem.base = base.slopes(used, Eigen::all);
  problem.measured -= base.offset()(used);
  problem.stated = stated_field(model);
  LinkRowLimits limits = limits_for(readings);
  if (!data.has_places()) limits.way = -1;  // readings at like distances are not at one place: each is a row
  std::vector<int> runs = add_columns();
  problem.smooths = link_smooths(readings, link_columns, data.has_places());
  layout = std::make_shared<const LinkLayout>(std::move(readings), limits, std::move(runs), data.has_places());
  problem.layout = layout;
  const noise::Rows rows = layout->rows();
  sought = cause_candidates(causes, LinkCauseDomain(model, data, used, rows), {run, used}, problem.base, rows);
  take_swaps_by_the_map(rows, world, plugins);
  let_sketch(rows, world, plugins);
  let_ask_near(world, plugins);
  for (const CauseCandidate& c : sought.found) problem.candidates.push_back(c.candidate);
}

// Parameters that were fitted while two radios bear each other's name are bent by that, and what a swap would change is
// wrong with them: where the fit leaves much more than the world's own draws, it is told by the declared ones.
void DiagnosisSetup::take_swaps_by_the_map(const noise::Rows& rows, const std::filesystem::path& world,
                                           const Library::SearchPath& plugins) {
  constexpr double much_more = 1.5;
  if (fitted.simulated_sd <= 0 || fitted.residual_sd < much_more * fitted.simulated_sd) return;
  const auto set_all = [&](double FitParameter::*value) {
    for (const FitParameter& p : fitted.parameters) {
      if (std::isfinite(p.*value)) model.set(p.path, p.*value);
    }
  };
  run->clear();
  set_all(&FitParameter::start);
  const auto declared = std::make_shared<CauseModel>(model, world, file, plugins);
  for (CauseCandidate& cause : sought.found) {
    inference::Candidate& c = cause.candidate;
    if (cause.shape->cause.meaning().kind != MUSTER_INSTRUMENT || c.design.width != 1) continue;
    const auto columns = at_readings_of(cause, {declared, used}).design.columns;
    const auto kept = std::make_shared<std::map<double, VectorXd>>();  // by the row that it is about
    noise::Sheet atoms(rows.size(), static_cast<Index>(c.design.grid.size()));
    for (std::size_t k = 0; k < c.design.grid.size(); ++k) {
      const VectorXd& column = (*kept)[c.design.grid[k][0]] = columns(c.design.grid[k]);
      atoms.col(static_cast<Index>(k)) = rows.mean(column).cast<float>();
    }
    c.design.columns = [kept](const VectorXd& theta) { return kept->at(theta[0]); };
    c.design.atoms = std::make_shared<const noise::Sheet>(std::move(atoms));
  }
  declared->clear();
  set_all(&FitParameter::value);
}

// Where rows have many readings, a search over many places, times or shapes asks one of each.
void DiagnosisSetup::let_sketch(const noise::Rows& rows, const std::filesystem::path& world,
                                const Library::SearchPath& plugins) {
  constexpr Index worth = 2;  // readings a row
  if (layout->size() < worth * rows.size() || holds_a_table_reader(model)) return;
  sketched =
      std::make_unique<SimulatedReadings>(middles(rows, layout->readings()), model.radio_names(), world, plugins, base);
  for (CauseCandidate& c : sought.found) {
    if (c.candidate.refinement.any() && !c.shape->cause.file())
      c.candidate.design.sketch = sketched->at(c).design.columns;
  }
}

// Where a wall or a thing stands is drawn some thousand times about one place, which few of many readings concern.
void DiagnosisSetup::let_ask_near(const std::filesystem::path& world, const Library::SearchPath& plugins) {
  constexpr Index worth = 4000;  // readings
  if (layout->size() < worth || holds_a_table_reader(model)) return;
  const Simulate simulate = [this, world, plugins](const LinkReadings& readings) {
    return std::make_shared<SimulatedReadings>(readings, model.radio_names(), world, plugins, base);
  };
  for (CauseCandidate& c : sought.found) {
    if (!c.candidate.refinement.proposed || c.shape->cause.file()) continue;
    c.candidate.design.near = [this, cause = c, simulate](const VectorXd& theta) {
      return columns_near(theta, cause, layout->readings(), simulate);
    };
  }
}

LinkReadings DiagnosisSetup::readings_of_search() {
  LinkReadings r;
  const auto n = static_cast<Index>(used.size());
  r.tx_at.resize(3, n);
  r.rx_at.resize(3, n);
  problem.measured.resize(n);
  const bool clips = instrument.top || instrument.bottom || !fitted.readings.censored.empty();
  problem.bounds.half_code = instrument.step / 2;
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
    r.level.push_back(base.mean[used[static_cast<std::size_t>(i)]]);
    const double rssi = data.rssi[row];
    problem.measured[i] = std::isnan(rssi) ? fitted.readings.floor + problem.bounds.half_code : rssi;
    if (clips) problem.bounds.known.push_back(known_of(rssi));
  }
  return r;
}

// What a reading says of the level, by the pile that it lies in.
noise::Known DiagnosisSetup::known_of(double rssi) const {
  const auto lies_in = [&](const std::optional<Clip>& clip) { return clip && rssi == clip->level; };
  if (std::isnan(rssi) || lies_in(instrument.bottom)) return noise::Known::below;
  return lies_in(instrument.top) ? noise::Known::above : noise::Known::value;
}

// A number of few values is a setting, that of a run a name: each value stands for itself.
std::vector<int> DiagnosisSetup::add_columns() {
  std::vector<int> runs;
  for (const Covariate& column : data.covariates) {
    const std::string name = column.name.substr(0, column.name.find('['));
    const bool is_run = name == "run";
    const std::size_t settings = is_run ? used.size() : 8;
    inference::Factor factor{name, {}};
    if (column.values.empty()) {
      for (const Index row : used)
        factor.level.push_back(static_cast<int>(column.factor.level[static_cast<std::size_t>(row)]));
    } else {
      const VectorXd values =
          Eigen::Map<const VectorXd>(column.values.data(), static_cast<Index>(column.values.size()))(used);
      if (!values.allFinite()) {
        untested.push_back(column.name + ": it has empty cells");
        continue;
      }
      std::set<double> different;
      for (Index i = 0; i < values.size() && different.size() <= settings; ++i) different.insert(values[i]);
      if (different.size() > settings) {
        link_columns.covariates.push_back({name, values});
        continue;
      }
      if (different.size() < 2) continue;
      for (const double v : values)
        factor.level.push_back(static_cast<int>(std::distance(different.begin(), different.find(v))));
    }
    if (is_run) runs = factor.level;
    link_columns.factors.push_back(std::move(factor));
  }
  return runs;
}

}  // namespace muster::diagnosis
