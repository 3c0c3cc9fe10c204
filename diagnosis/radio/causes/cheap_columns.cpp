#include "diagnosis/radio/causes/cheap_columns.hpp"

#include <cmath>
#include <map>

#include "diagnosis/inference/noise/basis.hpp"
#include "diagnosis/radio/causes/local_columns.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {

using Eigen::Index;
using Eigen::VectorXd;

CauseSearch with_swaps_by_the_map(CauseSearch causes, const LinkSearchWorld& at, const Fit& fitted, CauseModel& run) {
  if (fitted.simulated_sd <= 0 || fitted.residual_sd < thresholds::much_more * fitted.simulated_sd) return causes;
  run.clear();
  ParameterGuard declared(at.model);
  for (const FitParameter& p : fitted.parameters) declared.set(p.path, p.start);
  const auto by_map = std::make_shared<CauseModel>(at.model, at.world, at.data, at.plugins);
  for (CauseCandidate& cause : causes.found) {
    inference::CandidateDesign& design = cause.candidate.design;
    if (cause.shape->cause.meaning().kind != MUSTER_INSTRUMENT || design.width != 1) continue;
    const auto columns = at_readings_of(cause, {by_map, at.used}).design.columns;
    const auto kept = std::make_shared<std::map<double, VectorXd>>();  // by row
    noise::Sheet atoms(at.rows.size(), static_cast<Index>(design.grid.size()));
    for (std::size_t k = 0; k < design.grid.size(); ++k) {
      const VectorXd& column = (*kept)[design.grid[k][0]] = columns(design.grid[k]);
      atoms.col(static_cast<Index>(k)) = at.rows.mean(column).cast<float>();
    }
    design.columns = [kept](const VectorXd& theta) { return kept->at(theta[0]); };
    design.atoms = std::make_shared<const noise::Sheet>(std::move(atoms));
  }
  by_map->clear();
  return causes;
}

std::shared_ptr<SimulatedReadings> sketched_readings(const LinkSearchWorld& at) {
  if (at.layout->size() < thresholds::worth_sketching * at.rows.size() || holds_a_table_reader(at.model))
    return nullptr;
  return std::make_shared<SimulatedReadings>(middles(at.rows, at.layout->readings()), at.model.radio_names(), at.world,
                                             at.plugins, at.base, at.model.libraries());
}

CauseSearch with_sketches(CauseSearch causes, const std::shared_ptr<SimulatedReadings>& sketched,
                          const noise::Rows& rows) {
  if (!sketched) return causes;
  for (CauseCandidate& c : causes.found) {
    if (c.candidate.refinement.any() && !c.shape->cause.file())
      c.candidate.design.sketch = [at_middles = sketched->at(c).design.columns, rows](const VectorXd& theta) {
        return rows.by_twins(at_middles(theta));
      };
  }
  return causes;
}

CauseSearch with_columns_near(CauseSearch causes, const LinkSearchWorld& at) {
  if (at.layout->size() < thresholds::worth_localising || holds_a_table_reader(at.model)) return causes;
  const Simulate simulate = [radios = at.model.radio_names(), world = at.world, plugins = at.plugins, base = at.base,
                             libraries = at.model.libraries()](const LinkReadings& readings) {
    return std::make_shared<SimulatedReadings>(readings, radios, world, plugins, base, libraries);
  };
  for (CauseCandidate& c : causes.found) {
    if (!c.candidate.refinement.proposed || c.shape->cause.file()) continue;
    c.candidate.design.near = [layout = at.layout, cause = c, simulate](const std::vector<VectorXd>& thetas) {
      return columns_near(thetas, cause, layout->readings(), simulate);
    };
  }
  return causes;
}

}  // namespace muster::diagnosis
