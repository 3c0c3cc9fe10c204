#include "diagnosis/inference/assess/posterior_sampler.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/inference/noise/dense_solvers.hpp"
#include "diagnosis/inference/score/importance_weights.hpp"
#include "diagnosis/inference/score/refine.hpp"
#include "diagnosis/inference/score/sparse_columns.hpp"
#include "diagnosis/inference/score/student_mixture.hpp"
#include "diagnosis/inference/thresholds.hpp"
#include "muster/random.hpp"

namespace muster::inference {
namespace {

// Steps of the walk: along the moves, then along the principal axes of those.
constexpr std::array walked{300, 600};
constexpr int lap = 400, most_laps = 8;  // of draws

// Fit at a theta beside the rest of the model, and its log-likelihood.
class Likelihood {
 public:
  Likelihood(const ModelState& state, const WhitenedModel& rest, const Term& term, double overstated)
      : state_(state),
        rest_(rest),
        c_(*term.candidate),
        columns_(c_.design.columns),
        overstated_(overstated),
        thin_(state, rest) {}

  const Candidate& candidate() const { return c_; }
  // Most thetas to come are among these.
  void stay_among(const std::vector<Eigen::VectorXd>& thetas) {
    if (c_.design.near) columns_ = c_.design.near(thetas);
  }
  bool allows(const Eigen::VectorXd& theta) const {
    return theta == theta.cwiseMax(c_.refinement.lower).cwiseMin(c_.refinement.upper);
  }

  // Exact columns: for a strong effect a sketch is off by many nats.
  ConditionalGain explained(const Eigen::VectorXd& theta) {
    const Eigen::MatrixXd columns = state_.rows().mean(columns_(theta));
    if (columns.cols() > 1 || c_.design.whole || !thin_.take(columns.col(0)))
      return ConditionalFit(rest_, columns, c_.design.whole);
    const double along = thin_.along(), length = thin_.length();
    if (length < 1e-6) return {Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Zero(1, 1), 0};
    return {Eigen::VectorXd::Constant(1, along / length), Eigen::MatrixXd::Constant(1, 1, 1 / length),
            along * along / length};
  }

  double log(const Eigen::VectorXd& theta, const ConditionalGain& at) const {
    if (c_.design.sign && at.coefficients[0] * c_.design.sign < 0) return 0;
    return (c_.refinement.admitted ? c_.refinement.admitted(theta) : 1) * at.gain / (2 * overstated_) +
           (c_.refinement.belief ? c_.refinement.belief(theta) : 0);
  }

 private:
  const ModelState& state_;
  const WhitenedModel& rest_;
  const Candidate& c_;
  std::function<Eigen::MatrixXd(const Eigen::VectorXd&)> columns_;
  const double overstated_;
  SparseColumns thin_;
};

struct Moments {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;

  // Entries equal in all thetas get exactly zero variance.
  Moments(const std::vector<Eigen::VectorXd>& thetas, const Eigen::VectorXd& weights) {
    Eigen::MatrixXd off(thetas[0].size(), weights.size());
    for (Index k = 0; k < off.cols(); ++k) off.col(k) = thetas[static_cast<std::size_t>(k)] - thetas[0];
    const Eigen::VectorXd middle = off * weights / weights.sum();
    off.colwise() -= middle;
    mean = thetas[0] + middle;
    covariance = off * weights.asDiagonal() * off.transpose() / weights.sum();
  }
};

// Samples exp(gain / 2 / temperature): the walk crosses to other optima, and its fit has heavy tails.
class MetropolisChain {
 public:
  MetropolisChain(Likelihood& likelihood, const Eigen::VectorXd& theta, double searched)
      : likelihood_(likelihood), theta_(theta), log_(likelihood.log(theta, likelihood.explained(theta))) {
    heat_ = std::clamp(log_ / searched, 1.0, thresholds::max_temperature);
  }

  // Visited thetas, without the first quarter (burn-in).
  std::vector<Eigen::VectorXd> lap(int steps) {
    std::vector<Eigen::VectorXd> met;
    for (int k = 0; k < steps; ++k) {
      step();
      if (k >= steps / 4) met.push_back(theta_);
    }
    return met;
  }

  // Adapts steps to the principal axes of visited thetas (Haario, Saksman and Tamminen 2001); some steps remain moves
  // or leaps.
  void learn(const Moments& met) {
    const noise::SymmetricEigen axes = noise::symmetric_eigen(met.covariance);
    axes_ = axes.vectors * axes.values.cwiseMax(0).cwiseSqrt().asDiagonal();
    length_ = 1;
  }

 private:
  // Acceptance rate near one in three, for few dimensions (Gelman, Roberts and Gilks 1996).
  void step() {
    const bool leaps = stream_.uniform(k_, 101) > 0.8;
    const Eigen::VectorXd theta = theta_ + (leaps ? leap() : stride());
    bool accepted = false;
    if (likelihood_.allows(theta)) {
      const double there = likelihood_.log(theta, likelihood_.explained(theta));
      accepted = std::log(stream_.uniform(k_, 100)) < (there - log_) / heat_;
      if (accepted) theta_ = theta, log_ = there;
    }
    if (!leaps) length_ = std::min(3.0, length_ * (accepted ? 1.2 : 0.91));
    ++k_;
  }

  Eigen::VectorXd stride() const {
    const bool own = axes_.size() > 0 && stream_.uniform(k_, 102) < 0.75;
    const Eigen::MatrixXd moves = own ? axes_ : moves_at(likelihood_.candidate(), theta_);
    const double unit = axes_.size() == 0 ? length_ : own ? 2.4 * length_ : 0.1;
    Eigen::VectorXd mix(moves.cols());
    for (Index j = 0; j < mix.size(); ++j) mix[j] = stream_.normal(k_, static_cast<uint64_t>(j));
    return moves * mix * (unit / std::sqrt(static_cast<double>(mix.size())));
  }

  // A Cauchy step along one move, across impossible places.
  Eigen::VectorXd leap() const {
    const Eigen::MatrixXd moves = moves_at(likelihood_.candidate(), theta_);
    const auto one = static_cast<Index>(stream_.uniform(k_, 102) * static_cast<double>(moves.cols()));
    return moves.col(one) * std::tan(M_PI * (stream_.uniform(k_, 103) - 0.5));
  }

  Likelihood& likelihood_;
  const Stream stream_{key_of("walk")};
  uint64_t k_ = 0;
  Eigen::MatrixXd axes_;  // empty: the candidate's moves alone
  Eigen::VectorXd theta_;
  double log_, heat_, length_ = 0.2;
};

class Draws {
 public:
  Draws(Likelihood& likelihood, const Moments& found) : likelihood_(likelihood) {
    draw(lap, StudentMixture({found.mean}, scale_of(found, 1)));
  }

  bool any() const { return !thetas_.empty(); }

  // Importance weights against the mixture of all proposals so far. Sum 1.
  Eigen::VectorXd weights() const {
    const auto count = static_cast<Index>(thetas_.size());
    const Eigen::ArrayXd log_likelihood = Eigen::ArrayXd::Map(log_likelihood_.data(), count);
    const Eigen::ArrayXd result =
        (log_likelihood - log_likelihood.maxCoeff()).exp() / Eigen::ArrayXd::Map(density_.data(), count);
    return result / result.sum();
  }

  // Draws around the thetas of largest weight, and a few over the whole posterior.
  void lap_about(const Eigen::VectorXd& weights) {
    constexpr double wider = 1.5, narrower = 0.25;  // of variance
    constexpr int places = 50;
    const Moments found(thetas_, weights);
    std::vector<Eigen::VectorXd> centres;
    for (const std::size_t k : resampled(weights, places)) centres.push_back(thetas_[k]);
    draw(lap / 5, StudentMixture({found.mean}, scale_of(found, wider)));
    draw(lap - lap / 5, StudentMixture(std::move(centres), scale_of(found, narrower)));
  }

  LikelyThetas take(Eigen::VectorXd weights) { return {std::move(thetas_), std::move(explained_), std::move(weights)}; }

 private:
  // At least a hundredth of the steps, where nearly all weight is on one theta.
  Eigen::MatrixXd scale_of(const Moments& found, double factor) const {
    Eigen::MatrixXd scale = factor * found.covariance;
    scale.diagonal().array() += (0.01 * likelihood_.candidate().refinement.step).array().square();
    return scale;
  }

  void draw(int count, StudentMixture mixture) {
    for (std::size_t k = 0; k < thetas_.size(); ++k) density_[k] += count * mixture.density(thetas_[k]);
    from_.push_back({count, std::move(mixture)});
    for (int k = 0; k < count; ++k) {
      Eigen::VectorXd theta = from_.back().mixture.draw(stream_, drawn_++);
      if (!likelihood_.allows(theta)) continue;
      explained_.push_back(likelihood_.explained(theta));
      log_likelihood_.push_back(likelihood_.log(theta, explained_.back()));
      density_.push_back(0);
      for (const From& from : from_) density_.back() += from.count * from.mixture.density(theta);
      thetas_.push_back(std::move(theta));
    }
  }

  struct From {
    int count;
    StudentMixture mixture;
  };

  Likelihood& likelihood_;
  const Stream stream_{key_of("draws")};
  uint64_t drawn_ = 0;
  std::vector<From> from_;
  std::vector<Eigen::VectorXd> thetas_;
  std::vector<ConditionalGain> explained_;
  std::vector<double> log_likelihood_, density_;
};

}  // namespace

LikelyThetas sample_posterior(const ModelState& state, const WhitenedModel& rest, const Term& term, double overstated) {
  Likelihood likelihood(state, rest, term, overstated);
  const Candidate& c = *term.candidate;
  // Limits the temperature: hotter, the walk would leave a narrow optimum for the many places with chance gains.
  MetropolisChain walk(likelihood, term.theta,
                       std::max(0.0, state.log_effective_tests(c) + c.refinement.charge) + thresholds::spared_nats);
  const auto found = [&](int steps) {
    const std::vector<Eigen::VectorXd> met = walk.lap(steps);
    likelihood.stay_among(met);
    return Moments(met, Eigen::VectorXd::Ones(static_cast<Index>(met.size())));
  };
  walk.learn(found(walked[0]));
  Draws draws(likelihood, found(walked[1]));
  if (!draws.any()) return {{term.theta}, {likelihood.explained(term.theta)}, Eigen::VectorXd::Ones(1)};
  Eigen::VectorXd weights = draws.weights();
  for (int laps = 1; laps < most_laps && effective_sample_size(weights) < thresholds::enough_effective; ++laps) {
    draws.lap_about(tempered(weights));
    weights = draws.weights();
  }
  return draws.take(tempered(weights));
}

}  // namespace muster::inference
