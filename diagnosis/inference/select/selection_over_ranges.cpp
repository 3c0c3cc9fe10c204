#include "diagnosis/inference/select/selection_over_ranges.hpp"

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

}  // namespace

void selection_over_ranges(std::unique_ptr<ModelState>& state, std::vector<Trial>& trials) {
  forward_selection(*state, trials);
  const Options& options = state->options();
  if (!options.prior.is_wider() || options.watch.stop()) return;
  Options usual = options;
  usual.prior = usual.prior.narrowed();
  auto other = std::make_unique<ModelState>(state->problem(), usual);
  std::vector<Trial> others;
  forward_selection(*other, others);
  if (options.watch.stop() || same_terms(*state, *other)) return;
  const Ground ground(*state);
  if (ground.evidence(*other) < ground.evidence(*state) - std::log(thresholds::first_alpha)) return;
  state = std::move(other);
  trials = std::move(others);
}

}  // namespace muster::inference
