#include "diagnosis/inference/score/clipping_check.hpp"

#include <cmath>
#include <limits>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"
#include "diagnosis/inference/state/null_tail.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

// Range of levels whose readings are not censored.
std::pair<double, double> range_of(const Problem& problem) {
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < problem.bounds.known.size(); ++i) {
    const double reading = problem.measured[static_cast<Index>(i)];
    if (problem.bounds.known[i] == noise::Known::below) low = std::max(low, reading);
    if (problem.bounds.known[i] == noise::Known::above) high = std::min(high, reading);
  }
  return {low, high};
}

}  // namespace

bool separable_from_clipping(const ModelState& state, const noise::Covariance& covariance,
                             const Eigen::MatrixXd& design, const Eigen::MatrixXd& columns) {
  const Eigen::MatrixXd both = noise::hstack(design, columns);
  const Eigen::VectorXd predicted = both * state.whitened_model(both, covariance).coefficients(both.cols());
  const double sd = std::sqrt((state.y() - predicted).squaredNorm() / static_cast<double>(predicted.size()));
  const auto [low, high] = range_of(state.problem());
  std::vector<Index> clear;
  for (Index i = 0; i < predicted.size(); ++i) {
    if (predicted[i] > low + thresholds::clear_of_clip * sd && predicted[i] < high - thresholds::clear_of_clip * sd)
      clear.push_back(i);
  }
  if (clear.size() < thresholds::fewest_clear_rows) return false;
  const noise::Field field(state.field().sites().of(clear), {.seed = state.options().seed});
  noise::Whitener whitener(field, covariance);
  noise::Whitened at = noise::whitened(whitener, state.y()(clear), design(clear, Eigen::all), state.options().prior);
  const double gain = WhitenedModel{std::move(whitener), std::move(at), {}}.gain(columns(clear, Eigen::all));
  return log_tail(gain, static_cast<double>(columns.cols())) < std::log(thresholds::clear_alpha);
}

}  // namespace muster::inference
