#include "diagnosis/inference/select/selection_over_noise.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

// What both selections are compared on: the problem's own rows, which no term has split, and one imputation.
struct Ground {
  noise::Rows rows;
  noise::Field field;
  Eigen::VectorXd y;
  const noise::Prior& prior;

  Ground(const ModelState& state)
      : rows(state.problem().layout->rows()),
        field(state.problem().layout->sites(rows), {.seed = state.options().seed}),
        y(rows.mean(state.measured())),
        prior(state.options().prior) {}

  // nats: log likelihood of the model, less the price of its terms.
  double evidence(const ModelState& state) const {
    Eigen::MatrixXd design = state.problem().base;
    double price = 0;
    for (const Term& term : state.terms) {
      const Candidate& c = *term.candidate;
      design = noise::hstack(design, c.design.columns(term.theta));
      price -= state.evidence(c, 0, term.columns.cols(), c.refinement.any());
    }
    const Eigen::MatrixXd of_rows = rows.mean(design);
    const noise::Fit fit = noise::fit(field, y, of_rows, prior, state.fit.covariance, 6);
    const noise::Whitened at = noise::whitened(noise::Whitener(field, fit.covariance), y, of_rows, prior);
    return at.basis.log_determinant() - at.value - price;
  }
};

bool same_terms(const ModelState& one, const ModelState& other) {
  return std::equal(one.terms.begin(), one.terms.end(), other.terms.begin(), other.terms.end(),
                    [](const Term& a, const Term& b) {
                      return a.id() == b.id() && a.candidate->label_of(a.theta) == b.candidate->label_of(b.theta);
                    });
}

// The same problem beside fields of the usual range.
std::unique_ptr<ModelState> with_usual_ranges(const ModelState& state) {
  Options options = state.options();
  if (!options.prior.is_wider()) return nullptr;
  options.prior = options.prior.narrowed();
  return std::make_unique<ModelState>(state.problem(), options);
}

// The same problem, begun with the likeliest noise of which no share is fixed to a stream.
std::unique_ptr<ModelState> with_streams_alike(const ModelState& state) {
  if (!noise::fixed_to_stream(state.families.front().covariance.family)) return nullptr;
  const auto alike = std::find_if(state.families.begin(), state.families.end(), [](const noise::Fit& fit) {
    return !noise::fixed_to_stream(fit.covariance.family);
  });
  if (alike == state.families.end()) return nullptr;
  auto result = std::make_unique<ModelState>(state.problem(), state.options());
  result->fit = *alike;
  return result;
}

}  // namespace

void selection_over_noise(std::unique_ptr<ModelState>& state, std::vector<Trial>& trials) {
  std::vector<std::unique_ptr<ModelState>> others;
  for (auto* const other : {with_usual_ranges, with_streams_alike}) {
    if (auto made = other(*state)) others.push_back(std::move(made));
  }
  forward_selection(*state, trials);
  for (auto& other : others) {
    std::vector<Trial> its_trials;
    if (!state->options().watch.stop()) forward_selection(*other, its_trials);
    if (state->options().watch.stop()) return;
    if (same_terms(*state, *other)) continue;
    const Ground ground(*state);
    if (ground.evidence(*other) < ground.evidence(*state) - std::log(thresholds::first_alpha)) continue;
    state = std::move(other);
    trials = std::move(its_trials);
  }
}

}  // namespace muster::inference
