#include "diagnosis/pipeline/unstated_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/inference/noise/basis.hpp"
#include "diagnosis/inference/noise/fit.hpp"
#include "diagnosis/radio/laws/law_sources.hpp"
#include "diagnosis/radio/laws/shadowing_test.hpp"
#include "diagnosis/radio/links/drawn_term.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// True if a field explains the readings beyond chance: without one they are less likely.
bool is_seen(const inference::ModelState& state) {
  noise::Covariance none = state.fit.covariance;
  none.theta[2] = std::log(none.reading_variance() + none.field_variance());
  none.theta[0] = state.options().prior.lower()[0];
  const MatrixXd design = state.design();
  const noise::Fit without = noise::fit(state.field(), state.y(), design, state.options().prior, none, 8, {0, 0, 1, 0});
  return without.value - state.whitened_model(design).at.value > thresholds::seen_field_nats;
}

// The field, in dB, that readings drawn by the world itself share; the largest of several runs.
double drawn_by_the_world(const DiagnosisSetup& at, const inference::ModelState& state,
                          const noise::Covariance& start) {
  double most = 0;
  for (int k = 0; k < thresholds::runs_for_a_field; ++k) {
    const WorldDraw draw = at.draws.draw(static_cast<uint64_t>(k), {}, {});
    const VectorXd all = (draw.drawn - draw.expected)(at.used.rows);
    const VectorXd errors = all.array().isFinite().select(all, 0);
    if (errors.isZero()) continue;
    const noise::Fit fit =
        noise::fit(state.field(), state.rows().mean(errors), state.base(), state.options().prior, start);
    most = std::max(most, noise::stated_by(fit.covariance, state.within()).shadowing);
  }
  return most;
}

// The scatter of single readings beside what neighbours share, against that of draws of the world, fitted alike: a t
// test of one more draw.
std::optional<OtherScatter> other_scatter_of_single(const DiagnosisSetup& at, const inference::ModelState& state) {
  constexpr int n = thresholds::field_draws;
  const LawPart law = stated_law(at.model).base;
  const bool says = law.law && law.law->apart(law.params) == 0;  // fades of places are in the field, too
  if (!says || state.time_unit() > 0 || !at.layout->readings().twin.empty()) return {};
  Eigen::VectorXd logs(n);
  for (int k = 0; k < n; ++k) {
    const WorldDraw draw = at.draws.draw(static_cast<uint64_t>(k), {}, {});
    const VectorXd errors = (draw.drawn - draw.expected)(at.used.rows);
    if (!errors.allFinite()) return {};
    logs[k] = fitted_to(state, state.rows().mean(errors)).theta[2] / 2;
  }
  const double mean = logs.mean(),
               spread = std::sqrt(1e-4 + (logs.array() - mean).square().sum() / (n - 1) * (1 + 1.0 / n));
  const double measured = state.fit.covariance.theta[2] / 2, off = measured - mean;
  if (std::abs(off) < std::log(thresholds::other_scatter) || std::abs(off) < thresholds::other_single_t * spread)
    return {};
  return OtherScatter{std::exp(measured), std::exp(logs.minCoeff()), std::exp(logs.maxCoeff()), true};
}

}  // namespace

std::optional<UnstatedField> unstated_field(const DiagnosisSetup& at, const inference::ModelState& state,
                                            const noise::Covariance& noise) {
  if (drawn_field(at.model).shadowing > 0 || state.time_unit() > 0) return {};
  const noise::StatedField field = noise::stated_by(noise, state.within());
  if (!(field.shadowing > thresholds::unstated_shadowing) || !is_seen(state) ||
      drawn_by_the_world(at, state, noise) > thresholds::drawn_field_share * field.shadowing)
    return {};
  return UnstatedField{field.shadowing, field.decorrelation, std::sqrt(noise.reading_variance())};
}

std::optional<OtherScatter> other_scatter(const DiagnosisSetup& at, const inference::ModelState& state) {
  // A fit takes up a part of a wide field, and none of what differs from place to place: the least scatter is that
  // beside the world's own parameters, the most that about the declared ones.
  const noise::Basis own = noise::basis_of(at.base.slopes(at.used.rows, Eigen::all));
  const auto scatter = [](const VectorXd& errors) {
    const auto heard = errors.array().isFinite().eval();
    return std::sqrt(heard.select(errors, 0).squaredNorm() / std::max<double>(1, static_cast<double>(heard.count())));
  };
  OtherScatter result{scatter((at.fitted.readings.rssi - at.fitted.mean)(at.used.rows)),
                      std::numeric_limits<double>::infinity(), 0};
  for (int k = 0; k < thresholds::runs_of_scatter; ++k) {
    const WorldDraw draw = at.draws.draw(static_cast<uint64_t>(k), {}, {});
    const VectorXd errors = (draw.drawn - draw.expected)(at.used.rows);
    result.least = std::min(result.least, scatter(own.rest(errors.array().isFinite().select(errors, 0).matrix())));
    result.most = std::max(result.most, scatter(errors));
    const bool within = result.measured > result.least / thresholds::other_scatter &&
                        result.measured < result.most * thresholds::other_scatter;
    if (result.least < thresholds::least_stated_scatter) return {};
    if (within) return other_scatter_of_single(at, state);
  }
  return result;
}

}  // namespace muster::diagnosis
