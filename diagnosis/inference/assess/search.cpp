#include "diagnosis/inference/assess/search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "diagnosis/inference/assess/held_out_gain.hpp"
#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"
#include "diagnosis/inference/select/backward_elimination.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

const Problem& checked(const Problem& problem) {
  const Index n = problem.layout->size();
  const auto fits = [&](Index rows, const std::string& what) {
    if (rows != n)
      throw std::invalid_argument(what + ": " + std::to_string(rows) + " rows for " + std::to_string(n) + " readings");
  };
  fits(problem.measured.size(), "measured values");
  fits(problem.base.rows(), "base columns");
  if (!problem.measured.allFinite() || !problem.base.allFinite())
    throw std::invalid_argument("a value that is not a number");
  if (n < thresholds::fewest_readings) throw std::invalid_argument("too few readings: " + std::to_string(n));
  return problem;
}

}  // namespace

Search::Search(const Problem& problem, const Options& options) : state_(checked(problem), options) {}

Result Search::run() {
  result_ = {};
  const Watch& watch = state_.options().watch;
  forward_selection(state_, result_.trials);
  watch.at("checking the findings at left-out places");
  withdraw_refuted();
  const std::vector<Term> aside = backward_elimination(state_, result_.trials);
  withdraw_refuted();
  watch.at("intervals and alternatives of the findings");
  const std::vector<ParameterUncertainty> spreads = settle_in_the_middle();
  for (std::size_t k = 0; k < state_.terms.size(); ++k) {
    const Term& term = state_.terms[k];
    result_.findings.push_back(finding_of(term, term.smooth() ? Status::unexplained : Status::named));
    Finding& finding = result_.findings.back();
    finding.alternatives = alternatives_of(state_, term);
    std::erase_if(finding.alternatives, [](const Alternative& r) { return !left_open(r); });
    if (term.smooth()) continue;
    finding.uncertainty = spreads[k].coefficients;
    finding.thetas = spreads[k].thetas;
  }
  for (const Term& term : aside)
    result_.findings.push_back(finding_of(term, term.smooth() ? Status::unexplained : Status::suspected));
  watch.at("held-out errors");
  result_.noise = state_.fit;
  result_.families = state_.families;
  const Eigen::MatrixXd design = state_.design();
  const WhitenedModel model = state_.whitened_model(design);
  const Eigen::VectorXd coefficients = model.coefficients(design.cols());
  result_.base_coefficients = coefficients.head(state_.sensitivities());
  result_.mean = design * coefficients;
  add_held_out_gains(state_, folds_, result_);
  check_what_is_left(result_, model);
  result_.aside = state_.take_back_all();
  if (result_.aside > 0) {  // strays are part of the scatter, and may be outliers by its law
    state_.refit();
    result_.noise = state_.fit;
  }
  const bool of_stays =
      std::any_of(result_.trials.begin(), result_.trials.end(), [](const Trial& t) { return t.of_stays; });
  const StayScatter stays = of_stays ? scatter_of_stays(state_, design) : StayScatter();
  // Where each site has one stay, what differs is the site.
  if (stays.stays > state_.field().recurring().streams()) result_.stays = stays;
  return result_;
}

// The worst first: each leaves another model and another covariance behind.
void Search::withdraw_refuted() {
  while (const auto worst = most_refuted(state_, folds_)) {
    const Term& term = state_.terms[*worst];
    result_.trials.push_back({term.candidate->id, term.candidate->label_of(term.theta), term.gain, term.log_p,
                              term.log_p, false, "refuted by readings at places left out"});
    result_.trials.back().of_stays = differs_between_stays(state_, *term.candidate, term.columns);
    state_.terms.erase(state_.terms.begin() + static_cast<std::ptrdiff_t>(*worst));
    state_.refit();
  }
  measure_gains(state_);
}

std::vector<ParameterUncertainty> Search::settle_in_the_middle() {
  std::vector<ParameterUncertainty> result;
  for (Term& term : state_.terms) {
    result.push_back(term.smooth() ? ParameterUncertainty() : parameter_uncertainty(state_, term));
    if (result.back().thetas.size() < 2) continue;
    term.theta = middle_of(state_, term, result.back());
    term.columns = state_.columns_of(*term.candidate, term.theta);
    state_.refit(4);
  }
  measure_gains(state_);
  return result;
}

// One check for each cause and covariate. Of several smooths along a covariate the smallest p-value counts, times
// their number (Bonferroni).
void Search::check_what_is_left(Result& result, const WhitenedModel& model) {
  std::map<std::string, std::pair<std::size_t, double>> along;  // index of the check, number of smooths
  for (ScoredCandidate& lead : scored_candidates(state_, model)) {
    const Candidate& c = lead.candidate();
    // What is moved as a whole gains by a share of the grid's move, which is none.
    if (c.design.whole && c.refinement.any() && lead.log_p < std::log(thresholds::near_miss_p))
      lead = refined(state_, model, lead, true);
    const Check check{c.kind == Kind::smooth ? "~" + c.own() : c.id, c.label_of(lead.theta), c.kind, lead.gain,
                      lead.log_p};
    const auto [at, first] = along.try_emplace(check.id, result.checks.size(), 1.0);
    if (first) {
      result.checks.push_back(check);
      continue;
    }
    auto& [place, ways] = at->second;
    Check& known = result.checks[place];
    const double one = std::min(known.log_p - std::log(ways), check.log_p);
    if (check.gain > known.gain) known.gain = check.gain;
    known.log_p = one + std::log(++ways);
  }
  for (const Trial& trial : result.trials) {
    // "slope~position" is one of the smooths along "~position".
    const std::string id = trial.id.find('~') == trial.id.npos ? trial.id : trial.id.substr(trial.id.find('~'));
    if (const auto at = along.find(id); at != along.end()) result.checks[at->second.first].refused = trial.reason;
  }
}

namespace {

double reach_of(Eigen::VectorXd effect) {
  const Index end = effect.size() / 100;
  std::sort(effect.begin(), effect.end());
  return effect[effect.size() - 1 - end] - effect[end];
}

}  // namespace

Finding Search::finding_of(const Term& term, Status status) const {
  const Eigen::MatrixXd design = noise::hstack(state_.design_without(term), term.columns);
  const WhitenedModel model = state_.whitened_model(design);
  const Index width = term.columns.cols();
  Finding finding;
  finding.id = term.id();
  finding.label = term.candidate->label_of(term.theta);
  finding.status = status;
  finding.covariates = term.candidate->covariates;
  finding.theta = term.theta;
  finding.coefficients = model.coefficients(design.cols()).tail(width);
  finding.uncertainty = model.at.basis.uncertainty(design.cols()).bottomRightCorner(width, width);
  finding.gain = term.gain;
  finding.evidence = term.evidence;
  finding.log_p = term.log_p;
  finding.reach = reach_of(state_.rows().by_stream(term.columns * finding.coefficients));
  finding.inflation = term.inflation;
  return finding;
}

namespace {

// Undecided alternatives of a finding; plans do not separate the same cause on other rows.
std::vector<const Alternative*> open_rivals(const Finding& finding) {
  std::vector<const Alternative*> result;
  for (const Alternative& alternative : finding.alternatives)
    if (alternative.separability < thresholds::decided && alternative.id != finding.id) result.push_back(&alternative);
  return result;
}

}  // namespace

std::vector<Advice> Search::advise(const std::vector<Plan>& plans) {
  std::vector<Advice> result;
  for (const Plan& plan : plans) {
    std::optional<ExpectedSeparability> planned;  // built on first use
    for (std::size_t k = 0; k < state_.terms.size(); ++k) {
      if (state_.terms[k].smooth()) continue;  // a smooth predicts nothing for readings elsewhere
      const Finding& finding = result_.findings[k];
      std::vector<const Alternative*> open = open_rivals(finding);
      std::erase_if(open, [&](const Alternative* alternative) { return !plan.knows(alternative->id); });
      if (open.empty()) continue;
      std::vector<std::string> ids(open.size());
      std::transform(open.begin(), open.end(), ids.begin(),
                     [](const Alternative* alternative) { return alternative->id; });
      if (!planned) planned.emplace(state_, plan);
      const std::vector<double> predicted = planned->separability(state_.terms[k], ids);
      for (std::size_t r = 0; r < open.size(); ++r)
        result.push_back({plan.say, finding.id, ids[r], open[r]->separability, predicted[r]});
    }
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Advice& a, const Advice& b) { return a.predicted > b.predicted; });
  return result;
}

}  // namespace muster::inference
