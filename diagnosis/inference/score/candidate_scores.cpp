#include "diagnosis/inference/score/candidate_scores.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnosis/inference/score/refine.hpp"
#include "diagnosis/inference/score/sparse_columns.hpp"
#include "diagnosis/inference/state/null_tail.hpp"

namespace muster::inference {
namespace {

enum class Columns { exact = 1, sketched };

// What refinement climbs.
class Height {
 public:
  Height(const Bench& bench, const Stand& stand, const Candidate& candidate, Columns columns)
      : bench_(bench),
        stand_(stand),
        candidate_(candidate),
        sketched_(columns == Columns::sketched && candidate.sketch),
        thin_(bench, stand) {}

  Thin& thin() { return thin_; }

  // The fall of the deviance, and twice what is believed of the place. Where nothing can stand it is below all else:
  // what counts as it is loses wherever it does not win.
  double operator()(const Eigen::VectorXd& theta) {
    const double admitted = candidate_.admitted ? candidate_.admitted(theta) : 1;
    if (admitted <= 0) return lowest;
    return explained(theta, admitted) + (candidate_.belief ? 2 * candidate_.belief(theta) : 0);
  }

 private:
  static constexpr double lowest = -1e9;

  double explained(const Eigen::VectorXd& theta, double admitted) {
    const Eigen::MatrixXd columns =
        sketched_ ? bench_.sketch_of(candidate_, theta) : bench_.columns_of(candidate_, theta);
    if (candidate_.width > 1 || candidate_.sign == 0) return admitted * stand_.gain(columns);
    const auto [along, length] = measured(columns);
    if (length < 1e-6 || along * candidate_.sign <= 0) return 0;
    return admitted * (candidate_.whole ? 2 * along - length : along * along / length);
  }

  // Product with the residual and squared length of what the design leaves of a column.
  std::pair<double, double> measured(const Eigen::VectorXd& column) {
    if (thin_.take(column)) return {thin_.along(), thin_.length()};
    const Eigen::VectorXd left = stand_.at.basis.rest(stand_.whitener(column));
    return {left.dot(stand_.at.residual), left.squaredNorm()};
  }

  const Bench& bench_;
  const Stand& stand_;
  const Candidate& candidate_;
  bool sketched_;
  Thin thin_;
};

bool far_from(const Candidate& candidate, const Eigen::VectorXd& theta, const std::vector<Eigen::VectorXd>& others) {
  return std::all_of(others.begin(), others.end(), [&](const Eigen::VectorXd& other) {
    for (Index k = 0; k < theta.size(); ++k) {
      const double step = candidate.step[k];
      if (step == 0 ? theta[k] != other[k] : std::abs(theta[k] - other[k]) >= 4 * std::abs(step)) return true;
    }
    return false;
  });
}

// The atoms with the largest gains that lie apart, beside those that are there.
void add_starts(const Candidate& c, const Eigen::VectorXd& gains, int count, std::vector<Eigen::VectorXd>& starts) {
  std::vector<Index> order(static_cast<std::size_t>(gains.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return gains[a] > gains[b]; });
  const std::size_t enough = starts.size() + static_cast<std::size_t>(count);
  for (std::size_t k = 0; k < std::min<std::size_t>(order.size(), 160) && starts.size() < enough; ++k) {
    const Eigen::VectorXd& theta = c.grid[static_cast<std::size_t>(order[k])];
    if (far_from(c, theta, starts)) starts.push_back(theta);
  }
}

// The same total variance with less of it in the field. Whitened, a shadow is little more than its edges, and a place
// that is off by more than their width gains nothing; in white noise what it covers counts.
Stand with_less_field(const Bench& bench, const Stand& stand, double share) {
  noise::Covariance c = stand.whitener.covariance();
  const double moved = (1 - share) * c.field_variance() * bench.rows().count().mean();
  c.theta[2] = std::log(c.reading_variance() + moved);
  c.theta[0] += std::log(share);
  return bench.stand(stand.design, c);
}

Eigen::VectorXd gains_of(const Entry& entry, const Stand& stand) {
  return gains(*entry.candidate, unit_atoms(entry, stand), stand.at.residual);
}

// One reading a row may have led away from a narrow top that was proposed.
Top best_of(const std::vector<Eigen::VectorXd>& starts, Top reached, Height exact) {
  reached.second = exact(reached.first);
  for (const Eigen::VectorXd& start : starts) {
    const double there = exact(start);
    if (there > reached.second) reached = {start, there};
  }
  return reached;
}

// From many starts.
Top raced_to(const Bench& bench, const Stand& stand, const Lead& lead) {
  const Candidate& c = lead.candidate();
  Height height(bench, stand, c, Columns::sketched);
  const auto value = [&](const Eigen::VectorXd& theta) { return height(theta); };
  std::vector<Eigen::VectorXd> starts;
  if (c.proposed) {
    constexpr std::size_t likely = 5;  // the first ones proposed
    for (Eigen::VectorXd& theta : bench.proposals(c, height.thin())) {
      if (static_cast<int>(starts.size()) < c.starts && far_from(c, theta, starts)) starts.push_back(std::move(theta));
    }
    starts.push_back(lead.theta);  // as well, however near: the grid may have met a narrow top
    const Top top = raced(c, starts, {value, value, value});
    starts.resize(std::min(starts.size(), likely));
    return best_of(starts, top, Height(bench, stand, c, Columns::exact));
  }
  starts.push_back(lead.theta);
  if (c.pieces.empty()) {  // no shadow: what is off by a little still gains
    const Eigen::VectorXd all = lead.all.size() > 0 ? lead.all : gains_of(*lead.entry, stand);
    add_starts(c, all, c.starts - 1, starts);
    return raced(c, starts, {value, value, value});
  }
  const Stand soft = with_less_field(bench, stand, 0.05), half = with_less_field(bench, stand, 0.4);
  if (lead.all.size() > 0) add_starts(c, lead.all, c.starts / 2, starts);
  add_starts(c, gains_of(*lead.entry, soft), c.starts, starts);
  Height on_soft(bench, soft, c, Columns::sketched), on_half(bench, half, c, Columns::sketched);
  return raced(c, starts, {std::ref(on_soft), std::ref(on_half), value, value});
}

}  // namespace

UnitAtoms unit_atoms(const Entry& entry, const Stand& stand) {
  noise::Sheet atoms = stand.whitener.sheet(*entry.atoms);
  stand.at.basis.take_out_of(atoms);
  return {std::move(atoms), entry.candidate->width};
}

Eigen::VectorXd gains(const Candidate& candidate, const UnitAtoms& unit, const Eigen::VectorXd& residual) {
  return statistics(candidate, unit.along(residual.cast<float>())).col(0).cast<double>();
}

double gain_of(const Candidate& candidate, const Stand& stand, const Eigen::MatrixXd& columns) {
  return candidate.whole ? std::max(0.0, stand.gain_as_it_is(columns)) : stand.gain(columns);
}

void by_evidence(std::vector<Lead>& leads) {
  std::stable_sort(leads.begin(), leads.end(), [](const Lead& a, const Lead& b) { return a.evidence > b.evidence; });
}

std::vector<Lead> leads(Bench& bench, const Stand& stand,
                        const std::function<void(const Candidate&, const UnitAtoms&)>& also) {
  std::vector<Lead> result;
  for (const Entry& entry : bench.entries()) {
    const Candidate& c = *entry.candidate;
    const UnitAtoms unit = unit_atoms(entry, stand);
    bench.log_atoms(entry, unit);
    if (also) also(c, unit);
    Lead lead{&entry, {}, {}, 0, 0, 0, false, gains(c, unit, stand.at.residual)};
    if (c.whole && !c.refinable()) {
      for (Index k = 0; k < lead.all.size(); ++k)
        lead.all[k] = std::clamp(stand.gain_as_it_is(entry.atom(k)), 0.0, lead.all[k]);
    }
    Index best = 0;
    lead.gain = lead.all.maxCoeff(&best);
    lead.theta = c.grid[static_cast<std::size_t>(best)];
    lead.columns = entry.atom(best);
    lead.evidence = bench.evidence(c, lead.gain, c.width, false);
    lead.log_p = bench.log_p(c, lead.gain, c.width, false);
    result.push_back(std::move(lead));
  }
  by_evidence(result);
  return result;
}

Lead refined(const Bench& bench, const Stand& stand, const Lead& lead, bool from_lead_alone) {
  const Candidate& c = lead.candidate();
  Lead best = lead;
  if (c.refinable()) {
    Height height(bench, stand, c, Columns::exact);
    const auto value = [&](const Eigen::VectorXd& theta) { return height(theta); };
    const bool race = !from_lead_alone && c.starts > 1;
    Top top{lead.theta, 0};
    if (race) {
      top = raced_to(bench, stand, lead);
    } else if (c.sketch) {
      top = climbed(c, lead.theta, c.evaluations, Height(bench, stand, c, Columns::sketched));
    }
    if (!race || c.sketch) top = climbed(c, top.first, c.sketch ? c.evaluations / 2 : c.evaluations, value);
    if (top.second > value(lead.theta)) best.theta = std::move(top.first);
    best.columns = bench.columns_of(c, best.theta);
  }
  best.refined = true;
  best.gain = gain_of(c, stand, best.columns);
  best.evidence = bench.evidence(c, best.gain, c.width, true);
  best.log_p = bench.log_p(c, best.gain, c.width, true);
  return best;
}

}  // namespace muster::inference
