#include "diagnosis/inference/select/site_levels.hpp"

#include <optional>
#include <set>

#include "diagnosis/inference/score/marginal_p_value.hpp"
#include "diagnosis/inference/select/f_test.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

// Numbers fitted for a candidate: its strengths, and where it is.
Index numbers_of(const Candidate& c) { return c.design.width + (c.refinement.step.array() != 0).count(); }

struct SiteLevels {
  Index sites = 0;
  Index differing = 0;  // sites whose streams were measured together and differ by the columns
};

// Levels that a network has to fit: one a site, and, where the columns differ between a site's streams, one more of
// each site whose streams were measured together (rows of half differences, which share no field). None where the
// columns vary within a site.
std::optional<SiteLevels> levels_of(const ModelState& state, const Eigen::MatrixXd& columns) {
  const noise::Sites& sites = state.field().sites();
  const double small = 1e-6 * columns.cwiseAbs().maxCoeff();
  SiteLevels levels;
  std::set<noise::SiteKey> differing;
  bool differs = false;
  for (const std::vector<Index>& rows : state.field().recurring().sites()) {
    const Index first = rows.front();
    if (sites.is_alone(first)) {
      differing.insert(noise::site_key(sites, first));
      differs = differs || columns.row(first).cwiseAbs().maxCoeff() > small;
      continue;
    }
    ++levels.sites;
    for (const Index row : rows)
      if ((columns.row(row) - columns.row(first)).cwiseAbs().maxCoeff() > small) return {};
  }
  if (differs) levels.differing = static_cast<Index>(differing.size());
  return levels;
}

// One row a site: the mean over its rows.
Eigen::MatrixXd mean_of_sites(const ModelState& state, const Eigen::MatrixXd& columns, Index sites) {
  Eigen::MatrixXd result(sites, columns.cols());
  Index site = 0;
  for (const std::vector<Index>& rows : state.field().recurring().sites()) {
    if (!state.field().sites().is_alone(rows.front())) result.row(site++) = columns(rows, Eigen::all).colwise().mean();
  }
  return result;
}

}  // namespace

bool is_standing(const ModelState& state) { return state.field().recurring().share() >= thresholds::standing_share; }

bool fits_each_site(const ModelState& state, const ScoredCandidate& lead) {
  if (!is_standing(state)) return false;
  const std::optional<SiteLevels> levels = levels_of(state, lead.columns);
  if (!levels) return false;
  Index left = levels->sites + levels->differing - state.base().cols() - numbers_of(lead.candidate());
  for (const Term& term : state.terms) left -= numbers_of(*term.candidate);
  return left < numbers_of(lead.candidate());
}

bool is_chance_of_sites(const ModelState& state, const Candidate& candidate, const Eigen::MatrixXd& columns,
                        const Eigen::MatrixXd& design) {
  if (!is_standing(state)) return false;
  const std::optional<SiteLevels> levels = levels_of(state, columns);
  if (!levels || levels->differing > 0 || levels->sites - design.cols() > thresholds::few_levels) return false;
  const auto mean = [&](const Eigen::MatrixXd& rows) { return mean_of_sites(state, rows, levels->sites); };
  return log_p_of_f_test(mean(design), mean(columns), mean(state.y())) + log_tests(state, candidate) >
         state.threshold();
}

}  // namespace muster::inference
