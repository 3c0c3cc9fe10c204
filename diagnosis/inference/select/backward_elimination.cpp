#include "diagnosis/inference/select/backward_elimination.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/candidate_scores.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"
#include "diagnosis/inference/select/alternatives.hpp"
#include "diagnosis/inference/select/relocate.hpp"
#include "diagnosis/inference/select/replace_smooths.hpp"

namespace muster::inference {
namespace {

// One at a time, the weakest term whose evidence beside the others is below one nat.
void drop_backward(Bench& bench) {
  while (bench.terms.size() > 1) {
    measure_gains(bench);
    const auto worst = std::min_element(bench.terms.begin(), bench.terms.end(),
                                        [](const Term& a, const Term& b) { return a.evidence < b.evidence; });
    if (worst->evidence >= 1) return;
    bench.terms.erase(worst);
    bench.refit();
  }
}

const Entry* named(const Bench& bench, const std::string& id) {
  for (const Entry& entry : bench.entries()) {
    if (entry.candidate->id == id && entry.candidate->kind == Kind::named) return &entry;
  }
  return nullptr;
}

// A cause that was the best guess at first may have a rival that is better now; or one of fewer parameters that is as
// good, since a drift that settles within seconds is a step.
void give_way_to_rivals(Bench& bench) {
  constexpr double clearly = 1, near = 5;  // nats
  constexpr double the_same = 0.5;         // of D
  const auto stands = [&](const Term& term) {
    return standing(bench, bench.design_without(term), *term.candidate, term.columns);
  };
  for (std::size_t k = 0; k < bench.terms.size(); ++k) {
    if (bench.terms[k].smooth()) continue;
    double now = stands(bench.terms[k]);
    for (const Rival& rival : rivals_of(bench, bench.terms[k])) {
      const Entry* const entry = named(bench, rival.id);
      const bool there = std::any_of(bench.terms.begin(), bench.terms.end(),
                                     [&](const Term& term) { return term.candidate->id == rival.id; });
      if (!entry || there || rival.evidence_gap > (rival.separability < inseparable ? near : -clearly)) continue;
      // Of two that are one to the readings only what the search for them cost differs: that makes no name better.
      const bool one = rival.separability < the_same && std::abs(rival.evidence_gap) < near;
      if (one && entry->candidate->parameters >= bench.terms[k].candidate->parameters) continue;
      const Term before = bench.terms[k];
      const noise::Fit fit = bench.fit;
      bench.terms[k].candidate = entry->candidate;
      bench.terms[k].theta = rival.theta;
      bench.terms[k].columns = bench.columns_of(*entry->candidate, rival.theta);
      bench.refit();
      settle(bench, k, false);
      const bool simpler =
          rival.separability < inseparable && entry->candidate->parameters < before.candidate->parameters;
      const double may_lose = one ? near : clearly;
      if (const double then = stands(bench.terms[k]); then > now + (simpler ? -may_lose : clearly)) {
        now = then;
      } else {
        bench.terms[k] = before;
        bench.fit = fit;
      }
    }
  }
}

// The best of the causes that act in time, beside the rest of the model.
std::optional<Term> best_in_time(Bench& bench, const Eigen::MatrixXd& rest) {
  const Stand stand = bench.stand(rest);
  std::optional<Term> best;
  for (const Lead& lead : leads(bench, stand)) {
    const Candidate& c = lead.candidate();
    if (c.kind != Kind::named || !c.time_like) continue;
    const Lead at = refined(bench, stand, lead, true);
    if (!best || at.evidence > best->evidence)
      best = Term{lead.entry->candidate, at.theta, at.columns, at.gain, at.evidence, 0};
  }
  return best;
}

// A column that falls with time came first, beside a field that held much of either: now each has one of its own.
void give_way_to_time(Bench& bench) {
  for (std::size_t k = 0; k < bench.terms.size(); ++k) {
    if (!bench.terms[k].smooth() || !bench.terms[k].candidate->observed) continue;
    const Term before = bench.terms[k];
    const noise::Fit fit = bench.fit;
    const Eigen::MatrixXd rest = bench.design_without(bench.terms[k]);
    const double now = standing(bench, rest, *before.candidate, before.columns);
    const std::optional<Term> other = best_in_time(bench, rest);
    if (!other) return;
    bench.terms[k] = *other;
    bench.refit();
    settle(bench, k, false);
    const double then = standing(bench, rest, *other->candidate, bench.terms[k].columns);
    if (then > now) continue;
    bench.terms[k] = before;
    bench.fit = fit;
  }
}

struct Company {
  double strongest = 0;     // gain of the strongest term
  double smooths = 0;       // joint gain of all smooths
  double stronger_kin = 0;  // gain of the strongest stronger term on the same covariate
};

// Leftovers of strong terms are not named.
bool is_halo(const Term& term, const Company& company, bool clipped) {
  const bool named = !term.smooth(), place = !term.candidate->pieces.empty() || term.candidate->own() == "map";
  if (term.gain < 0.05 * company.stronger_kin) return true;
  if (place && term.gain < std::min(30.0, 0.25 * company.stronger_kin)) return true;
  if (named && term.gain < 0.08 * company.smooths) return true;
  if (named && term.gain < std::min(50.0, 0.01 * company.strongest)) return true;
  return clipped && (term.candidate->proposed || !named) && term.gain < 60;  // what clips leave finds a place somewhere
}

void set_halos_aside(Bench& bench, std::vector<Term>& aside) {
  // Clipping is a strong term too, though none of the search's.
  if (bench.terms.size() + bench.problem().bounds.any() < 2) return;
  measure_gains(bench);
  Company all;
  Eigen::MatrixXd smooths(bench.rows().size(), 0);
  for (const Term& term : bench.terms) {
    all.strongest = std::max(all.strongest, term.gain);
    if (term.smooth()) smooths = noise::hstack(smooths, term.columns);
  }
  if (smooths.cols()) all.smooths = bench.stand(bench.design([](const Term& t) { return t.smooth(); })).gain(smooths);
  std::vector<Term> kept;
  for (const Term& term : bench.terms) {
    Company company = all;
    for (const Term& other : bench.terms) {
      if (other.candidate->own() == term.candidate->own() && other.gain > term.gain)
        company.stronger_kin = std::max(company.stronger_kin, other.gain);
    }
    (is_halo(term, company, bench.problem().bounds.any()) ? aside : kept).push_back(term);
  }
  bench.terms = std::move(kept);
}

// Beside an unexplained structure on its own covariate a name is one more guess at that structure.
void withdraw_names_beside_smooths(Bench& bench) {
  std::set<std::string> unexplained;
  for (const Term& term : bench.terms) {
    if (term.smooth()) unexplained.insert(term.candidate->own());
  }
  for (Term& term : bench.terms)
    term.as_smooth = term.as_smooth || (!term.smooth() && unexplained.count(term.candidate->own()));
}

bool named_twice(const Bench& bench, const Term& term) {
  const auto name = [](const Term& t) { return std::pair(t.candidate->id, t.candidate->label_of(t.theta)); };
  return !term.smooth() && term.candidate->pieces.empty() &&
         std::count_if(bench.terms.begin(), bench.terms.end(),
                       [&](const Term& other) { return name(other) == name(term); }) > 1;
}

// One cause named twice about the same row, where it is no place: what is there is neither.
void withdraw_names_given_twice(Bench& bench) {
  std::vector<bool> twice;
  for (const Term& term : bench.terms) twice.push_back(named_twice(bench, term));
  for (std::size_t k = 0; k < bench.terms.size(); ++k) bench.terms[k].as_smooth = bench.terms[k].as_smooth || twice[k];
}

// A name beside which much is left along its own covariate is no more than a part of what is there.
void withdraw_names_of_parts(Bench& bench) {
  constexpr double doubt = 0.01;  // that chance leaves as much
  constexpr double much = 0.5;    // of the name's own gain: no formula is quite the truth's
  const Stand stand = bench.stand(bench.design());
  for (const Entry& entry : bench.entries()) {
    const Candidate& smooth = *entry.candidate;
    const auto concerns = [&](const Term& term) {
      return !term.smooth() && !term.candidate->whole && term.candidate->own() == smooth.own();
    };
    if (smooth.kind != Kind::smooth || std::none_of(bench.terms.begin(), bench.terms.end(), concerns)) continue;
    const double left = gains(smooth, unit_atoms(entry, stand), stand.at.residual).maxCoeff();
    if (bench.log_p(smooth, left, smooth.width, false) > std::log(doubt)) continue;
    for (Term& term : bench.terms) term.as_smooth = term.as_smooth || (concerns(term) && left > much * term.gain);
  }
}

// Each name again, beside all the others.
void test_each(Bench& bench, std::vector<Term>& aside, std::vector<Trial>& trials) {
  const double threshold = std::log(bench.options().further_alpha / static_cast<double>(bench.entries().size()));
  for (std::size_t k = 0; k < bench.terms.size() && bench.terms.size() > 1;) {
    const Term term = bench.terms[k];
    const Candidate& c = *term.candidate;
    const Eigen::MatrixXd rest = bench.design_without(bench.terms[k]);
    const Stand stand = bench.stand(rest);
    const double gain = stand.gain(term.columns);
    const double log_p = bench.log_p(c, gain, term.columns.cols(), true);
    if (term.smooth() || term.as_stated || log_p < -40) {
      ++k;
      continue;
    }
    // The fit of the whole design, its columns in another order: the value does not depend on it.
    const double integrated =
        integrated_log_p(bench, bench.fit, rest, term.columns, log_tests(bench, c)) + stand.skew_charge(term.columns);
    if (integrated <= threshold) {
      ++k;
      continue;
    }
    trials.push_back(
        {c.id, c.label_of(term.theta), gain, log_p, integrated, false, "not beyond chance beside the others"});
    aside.push_back(term);
    bench.terms.erase(bench.terms.begin() + static_cast<std::ptrdiff_t>(k));
    bench.refit();
  }
}

}  // namespace

void measure_gains(Bench& bench) {
  for (Term& term : bench.terms) {
    term.gain = bench.stand(bench.design_without(term)).gain(term.columns);
    term.evidence = bench.evidence(*term.candidate, term.gain, term.columns.cols(), false);
  }
}

std::vector<Term> clean_up(Bench& bench, std::vector<Trial>& trials) {
  std::vector<Term> aside;
  drop_backward(bench);
  replace_smooths(bench);
  give_way_to_time(bench);
  give_way_to_rivals(bench);
  set_halos_aside(bench, aside);
  withdraw_names_beside_smooths(bench);
  if (!bench.terms.empty()) bench.refit();
  test_each(bench, aside, trials);
  measure_gains(bench);
  withdraw_names_given_twice(bench);
  withdraw_names_of_parts(bench);
  withdraw_names_beside_smooths(bench);
  std::stable_sort(bench.terms.begin(), bench.terms.end(),
                   [](const Term& a, const Term& b) { return a.gain > b.gain; });
  return aside;
}

}  // namespace muster::inference
