#include "diagnosis/search/spread.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "diagnosis/search/integrated.hpp"
#include "diagnosis/search/refine.hpp"
#include "diagnosis/search/scores.hpp"
#include "diagnosis/search/uncertainty.hpp"
#include "muster/random.hpp"

namespace muster::search {
namespace {

// Steps of the walk: along the moves, then along what those showed to be its own long axes, time and again; the last
// ones count, until both halves of them tell the same.
constexpr std::array first_laps{300, 600};
constexpr int lap = 800, most_laps = 5;
// The walk is over exp(gain / 2 / heat), which lets it over to other tops; what it meets is weighed back.
constexpr double heat = 3;
constexpr int kept = 400;  // thetas

// Columns beside the rest of the model.
struct Beside {
  Eigen::MatrixXd columns;  // whitened, without what the rest explains
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd covariance;
  double gain = 0;

  Beside(const Stand& rest, const Eigen::MatrixXd& plain, bool whole)
      : columns(rest.at.basis.rest(rest.whitener(plain))) {
    const noise::Basis basis = noise::basis_of(columns);
    const Eigen::VectorXd explained = basis.q.transpose() * rest.at.residual;
    coefficients = basis.coefficients(explained, plain.cols());
    covariance = basis.uncertainty(plain.cols());
    gain = whole ? rest.gain_as_it_is(plain) : explained.squaredNorm();
  }
};

struct Met {
  Eigen::VectorXd theta, coefficients;
  Eigen::MatrixXd covariance;
  double weight;  // its logarithm, until weigh()
};

void weigh(std::vector<Met>& met) {
  double top = met[0].weight, sum = 0;
  for (const Met& m : met) top = std::max(top, m.weight);
  for (Met& m : met) sum += m.weight = std::exp(m.weight - top);
  for (Met& m : met) m.weight /= sum;
}

// Mean and standard deviation of each number of the thetas, by their weights.
struct Told {
  Eigen::ArrayXd mean, sd;

  explicit Told(std::vector<Met> met) {
    weigh(met);
    const Eigen::ArrayXd first = met[0].theta;
    Eigen::ArrayXd sum = 0 * first, squares = sum;
    for (const Met& m : met) {
      const Eigen::ArrayXd off = m.theta.array() - first;
      sum += m.weight * off, squares += m.weight * off.square();
    }
    mean = first + sum;
    sd = (squares - sum.square()).max(0).sqrt();
  }
};

// Whether the walk's halves agree.
bool is_settled(const std::vector<Met>& met) {
  constexpr double apart = 0.3, ratio = 1.3;
  const auto half = met.begin() + static_cast<std::ptrdiff_t>(met.size() / 2);
  const Told first({met.begin(), half}), second({half, met.end()});
  const Eigen::ArrayXd larger = first.sd.max(second.sd), smaller = first.sd.min(second.sd);
  return ((first.mean - second.mean).abs() <= apart * larger).all() && (larger <= ratio * smaller).all();
}

// As many of each as its weight asks for.
std::vector<Eigen::VectorXd> drawn(const std::vector<Met>& met) {
  std::vector<Eigen::VectorXd> result;
  double sum = 0;
  for (const Met& m : met) {
    sum += m.weight * kept;
    while (static_cast<double>(result.size()) + 0.5 < sum) result.push_back(m.theta);
  }
  return result;
}

class Walk {
 public:
  // `overstated`: by how much gains are.
  Walk(const Bench& bench, const Stand& rest, const Term& term, double overstated)
      : bench_(bench),
        rest_(rest),
        c_(*term.candidate),
        overstated_(overstated),
        theta_(term.theta),
        at_(rest, term.columns, c_.whole) {
    weight_ = weight(theta_, at_);
  }

  // What it met in so many steps.
  std::vector<Met> lap(int steps, bool tune) {
    std::vector<Met> met;
    for (int k = 0; k < steps; ++k) {
      step(tune);
      met.push_back({theta_, at_.coefficients, at_.covariance, weight_ * (1 - 1 / heat)});
    }
    return met;
  }

  // Strides along the axes of what was met (Haario, Saksman and Tamminen 2001), now and then along a move, or a leap.
  void learn(const std::vector<Met>& met) {
    const Index n = theta_.size(), count = static_cast<Index>(met.size());
    Eigen::MatrixXd all(n, count);
    for (Index k = 0; k < count; ++k) all.col(k) = met[static_cast<std::size_t>(k)].theta;
    all.colwise() -= all.rowwise().mean().eval();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(all * all.transpose() / static_cast<double>(count));
    axes_ = axes.eigenvectors() * axes.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
    length_ = 1;
  }

 private:
  // One in three accepted suits few dimensions (Gelman, Roberts and Gilks 1996).
  void step(bool tune) {
    const bool leaps = stream_.uniform(k_, 101) > 0.8;
    const Eigen::VectorXd theta = theta_ + (leaps ? leap() : stride());
    bool accepted = false;
    if (theta == theta.cwiseMax(c_.lower).cwiseMin(c_.upper)) {
      // No sketch: of a strong effect it is off by many nats.
      Beside there(rest_, bench_.columns_of(c_, theta), c_.whole);
      const double log_ratio = (weight(theta, there) - weight_) / heat;
      if (std::log(stream_.uniform(k_, 100)) < log_ratio) {
        accepted = true;
        theta_ = theta;
        weight_ += heat * log_ratio;
        at_ = std::move(there);
      }
    }
    if (tune && !leaps) length_ = std::min(3.0, length_ * (accepted ? 1.2 : 0.91));
    ++k_;
  }

  double weight(const Eigen::VectorXd& theta, const Beside& at) const {
    if (c_.sign && at.coefficients[0] * c_.sign < 0) return 0;
    return (c_.admitted ? c_.admitted(theta) : 1) * at.gain / (2 * overstated_) + (c_.belief ? c_.belief(theta) : 0);
  }

  Eigen::VectorXd stride() const {
    const bool own = axes_.size() > 0 && stream_.uniform(k_, 102) < 0.75;
    const Eigen::MatrixXd moves = own ? axes_ : moves_at(c_, theta_);
    const double unit = axes_.size() == 0 ? length_ : own ? 2.4 * length_ : 0.1;
    Eigen::VectorXd mix(moves.cols());
    for (Index j = 0; j < mix.size(); ++j) mix[j] = stream_.normal(k_, static_cast<uint64_t>(j));
    return moves * mix * (unit / std::sqrt(static_cast<double>(mix.size())));
  }

  // Along one move, by a length that has no mean: over places where nothing can stand.
  Eigen::VectorXd leap() const {
    const Eigen::MatrixXd moves = moves_at(c_, theta_);
    const auto one = static_cast<Index>(stream_.uniform(k_, 102) * static_cast<double>(moves.cols()));
    return moves.col(one) * std::tan(M_PI * (stream_.uniform(k_, 103) - 0.5));
  }

  const Bench& bench_;
  const Stand& rest_;
  const Candidate& c_;
  const double overstated_;
  const Stream stream_{key_of("walk")};
  uint64_t k_ = 0;
  Eigen::MatrixXd axes_;  // empty: the candidate's moves alone
  Eigen::VectorXd theta_;
  Beside at_;
  double weight_ = 0, length_ = 0.2;
};

// By how much the variance is larger by the scatter of the residuals: scores added up over cells of places (Liang and
// Zeger 1986).
double by_scatter(const Bench& bench, const Stand& rest, const Beside& fitted) {
  const double side = std::max(1.0, bench.fit.covariance.decorrelation());
  const noise::Sites& sites = bench.field().sites();
  const Eigen::VectorXd residual = rest.at.residual - fitted.columns * fitted.coefficients;
  std::map<std::tuple<int, long, long>, Eigen::VectorXd> scores;
  for (Index i = 0; i < residual.size(); ++i) {
    const std::tuple cell(sites.radio[static_cast<std::size_t>(i)], std::lround(std::floor(sites.place(0, i) / side)),
                          std::lround(std::floor(sites.place(1, i) / side)));
    Eigen::VectorXd& score = scores.try_emplace(cell, Eigen::VectorXd::Zero(fitted.columns.cols())).first->second;
    score += residual[i] * fitted.columns.row(i).transpose();
  }
  Eigen::MatrixXd meat = Eigen::MatrixXd::Zero(fitted.columns.cols(), fitted.columns.cols());
  double squares = 0, fourths = 0;
  for (const auto& [cell, score] : scores) {
    meat += score * score.transpose();
    squares += score.squaredNorm();
    fourths += score.squaredNorm() * score.squaredNorm();
  }
  if (squares * squares < 10 * fourths) return 1;  // a few cells have most of it: too few to tell a scatter
  return (fitted.covariance * meat * fitted.covariance).trace() / fitted.covariance.trace();
}

}  // namespace

Spread spread_of(const Bench& bench, const Term& term) {
  const Stand rest = bench.stand(bench.design_without(term));
  const Beside fitted(rest, term.columns, term.candidate->whole);
  const Index width = term.columns.cols();
  const Eigen::MatrixXd known =
      uncertainty_of(bench, beside(bench.design_without(term), term.columns)).bottomRightCorner(width, width);
  const double overstated = std::max(1.0, known.trace() / fitted.covariance.trace());
  const double grown = std::max(overstated, by_scatter(bench, rest, fitted));
  Spread result{{term.theta}, grown * fitted.covariance};
  if (!term.candidate->refinable() || term.smooth()) return result;
  Walk walk(bench, rest, term, overstated);
  for (const int steps : first_laps) {
    std::vector<Met> learnt = walk.lap(steps, true);
    learnt.erase(learnt.begin(), learnt.begin() + steps / 4);
    walk.learn(learnt);
  }
  std::vector<Met> met = walk.lap(lap, false);
  for (int laps = 1; laps < most_laps && !is_settled(met); ++laps) {
    walk.learn(met);
    const std::vector<Met> more = walk.lap(lap, false);
    met.insert(met.end(), more.begin(), more.end());
  }
  weigh(met);
  Eigen::MatrixXd within = 0 * fitted.covariance, between = within;
  for (const Met& m : met) {
    const Eigen::VectorXd off = m.coefficients - fitted.coefficients;
    within += m.weight * m.covariance;
    between += m.weight * off * off.transpose();
  }
  result.thetas = drawn(met);
  result.coefficients = grown * within + between;
  return result;
}

Eigen::VectorXd middle_of(const Bench& bench, const Term& term, const Spread& spread) {
  constexpr double nearly = 4;  // of deviance, a 95 % region of one parameter
  constexpr std::size_t tries = 40;
  const Candidate& c = *term.candidate;
  const Stand rest = bench.stand(bench.design_without(term));
  const double best = Beside(rest, term.columns, c.whole).gain;
  std::vector<Eigen::VectorXd> thetas{term.theta};
  const std::size_t every = spread.thetas.size() / tries + 1;
  for (std::size_t k = 0; k < spread.thetas.size(); k += every) thetas.push_back(spread.thetas[k]);
  Eigen::MatrixXd effects(rest.at.residual.size(), static_cast<Index>(thetas.size()));
  std::vector<bool> explains(thetas.size());
  for (std::size_t k = 0; k < thetas.size(); ++k) {
    const Beside there(rest, bench.columns_of(c, thetas[k]), c.whole);
    effects.col(static_cast<Index>(k)) = there.columns * there.coefficients;
    explains[k] = there.gain > best - nearly;
  }
  const Eigen::VectorXd mean = effects.rightCols(effects.cols() - 1).rowwise().mean();
  const Eigen::VectorXd off = (effects.colwise() - mean).colwise().squaredNorm();
  std::size_t middle = 0;
  for (std::size_t k = 1; k < thetas.size(); ++k)
    if (explains[k] && off[static_cast<Index>(k)] < off[static_cast<Index>(middle)]) middle = k;
  return thetas[middle];
}

}  // namespace muster::search
