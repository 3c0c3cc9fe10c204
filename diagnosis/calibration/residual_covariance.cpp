#include "diagnosis/calibration/residual_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "diagnosis/calibration/distributions.hpp"
#include "diagnosis/inference/noise/dense_solvers.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {

// Restricted likelihood of cluster means with covariance white / size + sum of variances times shapes.
struct ErrorModel::Likelihood {
  const Kernels& kernels;
  const Eigen::VectorXd& means;    // of residuals
  const Eigen::MatrixXd& columns;  // means of the fit's columns
  const Eigen::VectorXd& white;    // of each cluster's mean

  double value = 0;
  Eigen::VectorXd score{};
  Eigen::MatrixXd information{};  // average of observed and expected (Gilmour, Thompson and Cullis 1995)

  // False if the covariance is not positive.
  bool evaluate(const Eigen::VectorXd& variances, bool derivatives) {
    Eigen::MatrixXd v = white.asDiagonal();
    for (Eigen::Index k = 0; k < variances.size(); ++k) v += variances[k] * kernels.shapes[static_cast<std::size_t>(k)];
    const noise::Cholesky root(v);
    if (!root.positive()) return false;
    const Eigen::MatrixXd vx = root.solve(columns);
    const noise::SymmetricSolver small(columns.transpose() * vx);
    const Eigen::VectorXd vy = root.solve(means);
    const Eigen::VectorXd py = vy - vx * small.solve(Eigen::VectorXd(vx.transpose() * means));
    value = -0.5 * (root.log_determinant() + small.log_determinant() + means.dot(py));
    if (derivatives) derive(root, vx, small, py);
    return std::isfinite(value);
  }

  void derive(const noise::Cholesky& root, const Eigen::MatrixXd& vx, const noise::SymmetricSolver& small,
              const Eigen::VectorXd& py) {
    const auto n = means.size();
    const auto count = static_cast<Eigen::Index>(kernels.shapes.size());
    const Eigen::MatrixXd p = root.solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n))) -
                              vx * small.solve(Eigen::MatrixXd(vx.transpose()));
    Eigen::MatrixXd shaped(n, count);
    score.resize(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Eigen::MatrixXd& shape = kernels.shapes[static_cast<std::size_t>(k)];
      shaped.col(k) = shape * py;
      score[k] = 0.5 * (py.dot(shaped.col(k)) - p.cwiseProduct(shape).sum());
    }
    information = 0.5 * shaped.transpose() * p * shaped;
  }
};

namespace {

// Newton steps with an active set: variances are non-negative.
template <class Likelihood>
void maximise(Likelihood& likelihood, Components& c, double scale) {
  Eigen::VectorXd& at = c.variances;
  // Shrinks the start until the covariance is positive. Shapes are means over examples, not exact covariances: they
  // are safe only if weak beside the white part.
  for (int tries = 0; !likelihood.evaluate(at, true); ++tries) {
    if (tries > 10) throw std::runtime_error("residuals that are not numbers");
    at *= tries < 10 ? 0.25 : 0;
  }
  for (int i = 0; i < 30; ++i) {
    const double before = likelihood.value;
    Eigen::MatrixXd a = likelihood.information;
    Eigen::VectorXd b = likelihood.score;
    a.diagonal().array() += 1e-8 * a.diagonal().maxCoeff() + 1e-12;
    for (Eigen::Index k = 0; k < at.size(); ++k) {
      if (c.kinds[static_cast<std::size_t>(k)] && (at[k] > 0 || b[k] > 0)) continue;
      a.row(k).setZero();
      a.col(k).setZero();
      a(k, k) = 1;
      b[k] = 0;
    }
    Eigen::VectorXd step = noise::solve_symmetric(a, b), next = at;
    for (int half = 0; half < 12; ++half, step /= 2) {
      next = (at + step).cwiseMax(0);
      if (likelihood.evaluate(next, false) && likelihood.value >= before - 1e-9) break;
      next = at;
    }
    const double moved = (next - at).cwiseAbs().maxCoeff();
    at = next;
    likelihood.evaluate(at, true);
    if (moved < 1e-3 * scale || likelihood.value - before < 1e-3) break;
  }
}

// Estimates the variances of these kinds and their covariance; a variance at 0 is absent.
template <class Likelihood>
void estimate(Likelihood& likelihood, Components& c, double scale) {
  const auto count = static_cast<Eigen::Index>(c.kinds.size());
  c.variances = Eigen::VectorXd::Zero(count);
  for (Eigen::Index k = 0; k < count; ++k) c.variances[k] = c.kinds[static_cast<std::size_t>(k)] ? 0.3 * scale : 0;
  maximise(likelihood, c, scale);
  Eigen::MatrixXd information = likelihood.information;
  for (Eigen::Index k = 0; k < count; ++k) {
    if (c.variances[k] > 0) continue;
    information.row(k).setZero();
    information.col(k).setZero();
    information(k, k) = 1;
  }
  c.uncertainty = noise::solve_symmetric(information, Eigen::MatrixXd(Eigen::MatrixXd::Identity(count, count)));
}

// Candidate models: nothing shared, or shared by place, by path, or both, at each decorrelation distance. By radio as
// well, if available.
std::vector<Components> possible(const std::vector<Kernels>& kernels) {
  const bool by_radio = kernels.at(0).shapes.size() > 2;
  std::vector<Components> result;
  for (std::size_t d = 0; d < kernels.size(); ++d) {
    for (const auto& [place, way] : {std::pair{false, false}, {true, false}, {false, true}, {true, true}}) {
      if (!place && !way && d > 0) continue;
      Components c{.kernels = d, .kinds = {place, way}, .variances = {}, .uncertainty = {}};
      if (by_radio) c.kinds.push_back(true);
      result.push_back(std::move(c));
    }
  }
  return result;
}

// Prior of the decorrelation distance: 1.8 m within a factor of two (notes on indoor shadowing, 1 to 3 m).
double log_prior(double decorrelation) {
  return -0.5 *
         std::pow(std::log(decorrelation / thresholds::error_decorrelation) / thresholds::error_decorrelation_spread,
                  2);
}

// Each choice of kinds has the same prior weight, for any number of distances.
double prior_of(const Components& c, const std::vector<Kernels>& kernels) {
  if (!c.kinds[0] && !c.kinds[1]) return 0;
  double sum = 0;
  for (const Kernels& k : kernels) sum += std::exp(log_prior(k.decorrelation));
  return log_prior(kernels[c.kernels].decorrelation) - std::log(sum);
}

}  // namespace

Eigen::MatrixXd ErrorModel::cluster_sums(const Eigen::MatrixXd& columns) const {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(clusters_.count()), columns.cols());
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    for (Eigen::Index i = 0; i < columns.rows(); ++i)
      sums(clusters_.of_row[static_cast<std::size_t>(i)], j) += columns(i, j);
  }
  return sums;
}

void ErrorModel::fit(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns) {
  const Eigen::Map<const Eigen::VectorXd> size(clusters_.size.data(), static_cast<Eigen::Index>(clusters_.size.size()));
  const Eigen::VectorXd means = cluster_sums(residual).col(0).cwiseQuotient(size);
  const Eigen::MatrixXd x = size.cwiseInverse().asDiagonal() * cluster_sums(columns);
  measure_white(residual, means, columns.cols());
  Eigen::VectorXd white = white_.cwiseQuotient(size);
  const double scale = means.squaredNorm() / static_cast<double>(means.size());
  std::vector<Components> fitted = possible(kernels_);
  double best = -1e300, none = 0;
  for (std::size_t c = 0; c < fitted.size(); ++c) {
    Likelihood likelihood{kernels_[fitted[c].kernels], means, x, white};
    estimate(likelihood, fitted[c], scale);
    const auto count = static_cast<double>((fitted[c].variances.array() > 0).count());
    fitted[c].belief =
        likelihood.value + prior_of(fitted[c], kernels_) - count;  // a nat for each variance, as in Akaike's criterion
    best = std::max(best, likelihood.value);
  }
  Likelihood nothing{kernels_[0], means, x, white};
  nothing.evaluate(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(kernels_[0].shapes.size())), false);
  none = nothing.value;
  components_ = std::move(fitted);
  evidence_ = 2 * std::max(0.0, best - none);
  share_belief();
}

void ErrorModel::share_belief() {
  double top = -1e300, sum = 0;
  for (const Components& c : components_) top = std::max(top, c.belief);
  for (Components& c : components_) sum += c.belief = std::exp(c.belief - top);
  for (Components& c : components_) c.belief /= sum;
  std::erase_if(components_, [](const Components& c) { return c.belief < thresholds::least_belief; });
  sum = 0;
  for (const Components& c : components_) sum += c.belief;
  for (Components& c : components_) c.belief /= sum;
}

void ErrorModel::fit_white(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns) {
  const Eigen::Map<const Eigen::VectorXd> size(clusters_.size.data(), static_cast<Eigen::Index>(clusters_.size.size()));
  measure_white(residual, cluster_sums(residual).col(0).cwiseQuotient(size), columns.cols());
  const auto count = static_cast<Eigen::Index>(kernels_.at(0).shapes.size());
  components_ = {{0, {}, Eigen::VectorXd::Zero(count), Eigen::MatrixXd::Zero(count, count), 1}};
  evidence_ = 0;
}

// Variance of each cluster, shrunk to the mean of all by the weight of twenty readings: fading and tails vary by
// place.
void ErrorModel::measure_white(const Eigen::VectorXd& residual, const Eigen::VectorXd& means, Eigen::Index columns) {
  const Eigen::Map<const Eigen::VectorXd> size(clusters_.size.data(), means.size());
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(means.size());
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    const int c = clusters_.of_row[static_cast<std::size_t>(i)];
    squares[c] += std::pow(residual[i] - means[c], 2);
  }
  white_freedom_ = std::max(1.0, static_cast<double>(residual.size() - means.size() - columns));
  const double all = std::max(squares.sum() / white_freedom_, 1e-12);
  white_ = (squares.array() + thresholds::white_prior * all) / (size.array() - 1 + thresholds::white_prior);
}

Eigen::VectorXd ErrorModel::white_of_rows() const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(clusters_.of_row.size()));
  for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = white_[clusters_.of_row[static_cast<std::size_t>(i)]];
  return result;
}

Eigen::MatrixXd ErrorModel::of_sums(const Eigen::MatrixXd& columns) const {
  const Eigen::MatrixXd sums = cluster_sums(columns);
  Eigen::MatrixXd result = columns.transpose() * white_of_rows().asDiagonal() * columns;
  for (const Components& c : components_) {
    for (Eigen::Index k = 0; k < c.variances.size(); ++k) {
      if (c.variances[k] == 0) continue;
      const Eigen::MatrixXd& shape = kernels_[c.kernels].shapes[static_cast<std::size_t>(k)];
      result += c.belief * c.variances[k] * (sums.transpose() * (shape * sums));
    }
  }
  return result;
}

ErrorModel::Spread ErrorModel::of_sum(const Eigen::VectorXd& weights) const {
  const Eigen::VectorXd sums = cluster_sums(weights).col(0);
  const double own = weights.dot(white_of_rows().cwiseProduct(weights));
  Spread result;
  for (const Components& c : components_) {
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(c.variances.size());
    for (Eigen::Index k = 0; k < gradient.size(); ++k) {
      if (c.variances[k] > 0) gradient[k] = sums.dot(kernels_[c.kernels].shapes[static_cast<std::size_t>(k)] * sums);
    }
    const double variance = own + std::max(0.0, gradient.dot(c.variances));
    const double uncertainty = gradient.dot(c.uncertainty * gradient) + 2 * own * own / white_freedom_;
    result.parts.push_back({c.belief, std::sqrt(variance), std::max(3.0, 2 * variance * variance / uncertainty)});
    result.variance += c.belief * variance;
  }
  double inverse = 0;
  for (const auto& part : result.parts) inverse += part.belief * part.sd * part.sd / result.variance / part.freedom;
  result.freedom = 1 / inverse;
  return result;
}

double ErrorModel::Spread::reach(double share) const {
  const auto outside = [&](double at) {
    double sum = 0;
    for (const Part& part : parts) sum += 2 * part.belief * student_tail(part.freedom, at / part.sd);
    return sum;
  };
  double low = 0, high = std::sqrt(variance);
  while (outside(high) > 1 - share) high *= 2;
  for (int i = 0; i < 60; ++i) (outside((low + high) / 2) > 1 - share ? low : high) = (low + high) / 2;
  return (low + high) / 2;
}

double ErrorModel::shared_sd() const {
  double result = 0;
  for (const Components& c : components_) {
    for (Eigen::Index k = 0; k < c.variances.size(); ++k)
      result += c.belief * c.variances[k] * kernels_[c.kernels].shapes[static_cast<std::size_t>(k)].diagonal().mean();
  }
  return std::sqrt(std::max(result, 0.0));
}

double ErrorModel::decorrelation() const {
  double sum = 0, logs = 0;
  for (const Components& c : components_) {
    if (c.variances.head(2).maxCoeff() <= 0) continue;
    sum += c.belief;
    logs += c.belief * std::log(kernels_[c.kernels].decorrelation);
  }
  return sum > 0 ? std::exp(logs / sum) : 0;
}

}  // namespace muster::diagnosis
