#include "diagnosis/covariance.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace muster::diagnosis {

// The restricted likelihood of cluster means with covariance white / size + sum of variances times shapes.
struct ErrorModel::Likelihood {
  const Kernels& kernels;
  const Eigen::VectorXd& means;     // of residuals
  const Eigen::MatrixXd& columns;   // means of the fit's columns
  const Eigen::VectorXd& white;     // of each cluster's mean

  double value = 0;
  Eigen::VectorXd score{};
  Eigen::MatrixXd information{};  // average of observed and expected (Gilmour, Thompson and Cullis 1995)

  // False where the covariance is not positive.
  bool evaluate(const Eigen::VectorXd& variances, bool derivatives) {
    Eigen::MatrixXd v = white.asDiagonal();
    for (Eigen::Index k = 0; k < variances.size(); ++k) v += variances[k] * kernels.shapes[static_cast<std::size_t>(k)];
    const Eigen::LLT<Eigen::MatrixXd> root(v);
    if (root.info() != Eigen::Success) return false;
    const Eigen::MatrixXd vx = root.solve(columns);
    const Eigen::LDLT<Eigen::MatrixXd> small(columns.transpose() * vx);
    const Eigen::VectorXd vy = root.solve(means);
    const Eigen::VectorXd py = vy - vx * small.solve(vx.transpose() * means);
    const double log_det = 2 * root.matrixLLT().diagonal().array().log().sum();
    value = -0.5 * (log_det + small.vectorD().array().max(1e-300).log().sum() + means.dot(py));
    if (derivatives) derive(root, vx, small, py);
    return std::isfinite(value);
  }

  void derive(const Eigen::LLT<Eigen::MatrixXd>& root, const Eigen::MatrixXd& vx,
              const Eigen::LDLT<Eigen::MatrixXd>& small, const Eigen::VectorXd& py) {
    const auto n = means.size();
    const auto count = static_cast<Eigen::Index>(kernels.shapes.size());
    const Eigen::MatrixXd p = root.solve(Eigen::MatrixXd::Identity(n, n)) - vx * small.solve(vx.transpose());
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

// Newton steps for variances that may not be negative.
template <class Likelihood>
Eigen::VectorXd maximise(Likelihood& likelihood, Eigen::VectorXd at, double scale) {
  likelihood.evaluate(at, true);
  for (int i = 0; i < 30; ++i) {
    const double before = likelihood.value;
    Eigen::MatrixXd a = likelihood.information;
    Eigen::VectorXd b = likelihood.score;
    a.diagonal().array() += 1e-8 * a.diagonal().maxCoeff() + 1e-12;
    for (Eigen::Index k = 0; k < at.size(); ++k) {
      if (at[k] > 0 || b[k] > 0) continue;
      a.row(k).setZero();
      a.col(k).setZero();
      a(k, k) = 1;
      b[k] = 0;
    }
    Eigen::VectorXd step = a.ldlt().solve(b), next = at;
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
  return at;
}

// A decorrelation distance before data: within a factor of two of 1.8 m (notes on indoor shadowing, 1 to 3 m).
double log_prior(double decorrelation) { return -0.5 * std::pow(std::log(decorrelation / 1.8) / 0.7, 2); }

}  // namespace

Eigen::MatrixXd ErrorModel::cluster_sums(const Eigen::MatrixXd& columns) const {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(clusters_.count()), columns.cols());
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    for (Eigen::Index i = 0; i < columns.rows(); ++i) sums(clusters_.of_row[static_cast<std::size_t>(i)], j) += columns(i, j);
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
  std::vector<Components> fitted;
  double best = -1e300, none = 0;
  for (std::size_t d = 0; d < kernels_.size(); ++d) {
    Likelihood likelihood{kernels_[d], means, x, white};
    const auto count = static_cast<Eigen::Index>(kernels_[d].shapes.size());
    likelihood.evaluate(Eigen::VectorXd::Zero(count), false);
    none = likelihood.value;
    const Eigen::VectorXd start =
        components_.empty() ? Eigen::VectorXd::Constant(count, 0.3 * scale) : components_[d].variances;
    Components c{kernels_[d].decorrelation, maximise(likelihood, start, scale), {}, 0};
    Eigen::MatrixXd information = likelihood.information;
    information.diagonal().array() += 1e-9 * information.diagonal().maxCoeff() + 1e-300;
    c.uncertainty = information.ldlt().solve(Eigen::MatrixXd::Identity(count, count));
    c.belief = likelihood.value + log_prior(c.decorrelation);
    best = std::max(best, likelihood.value);
    fitted.push_back(std::move(c));
  }
  components_ = std::move(fitted);
  evidence_ = 2 * (best - none);
  const auto top = std::max_element(components_.begin(), components_.end(),
                                    [](const auto& a, const auto& b) { return a.belief < b.belief; })->belief;
  double sum = 0;
  for (Components& c : components_) sum += c.belief = std::exp(c.belief - top);
  for (Components& c : components_) c.belief /= sum;
}

void ErrorModel::fit_white(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns) {
  const Eigen::Map<const Eigen::VectorXd> size(clusters_.size.data(), static_cast<Eigen::Index>(clusters_.size.size()));
  measure_white(residual, cluster_sums(residual).col(0).cwiseQuotient(size), columns.cols());
  const auto count = static_cast<Eigen::Index>(kernels_.at(0).shapes.size());
  components_ = {{kernels_[0].decorrelation, Eigen::VectorXd::Zero(count), Eigen::MatrixXd::Zero(count, count), 1}};
  evidence_ = 0;
}

// Each cluster's own variance, drawn towards the mean of all as by twenty readings of it: fading and tails differ by place.
void ErrorModel::measure_white(const Eigen::VectorXd& residual, const Eigen::VectorXd& means, Eigen::Index columns) {
  constexpr double prior = 20;
  const Eigen::Map<const Eigen::VectorXd> size(clusters_.size.data(), means.size());
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(means.size());
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    const int c = clusters_.of_row[static_cast<std::size_t>(i)];
    squares[c] += std::pow(residual[i] - means[c], 2);
  }
  white_freedom_ = std::max(1.0, static_cast<double>(residual.size() - means.size() - columns));
  const double all = std::max(squares.sum() / white_freedom_, 1e-12);
  white_ = (squares.array() + prior * all) / (size.array() - 1 + prior);
}

Eigen::VectorXd ErrorModel::white_of_rows() const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(clusters_.of_row.size()));
  for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = white_[clusters_.of_row[static_cast<std::size_t>(i)]];
  return result;
}

Eigen::MatrixXd ErrorModel::of_sums(const Eigen::MatrixXd& columns) const {
  const Eigen::MatrixXd sums = cluster_sums(columns);
  Eigen::MatrixXd result = columns.transpose() * white_of_rows().asDiagonal() * columns;
  for (std::size_t d = 0; d < components_.size(); ++d) {
    if (components_[d].belief < 1e-4) continue;
    for (Eigen::Index k = 0; k < components_[d].variances.size(); ++k) {
      if (components_[d].variances[k] == 0) continue;
      result += components_[d].belief * components_[d].variances[k] * sums.transpose() *
                kernels_[d].shapes[static_cast<std::size_t>(k)] * sums;
    }
  }
  return result;
}

ErrorModel::Spread ErrorModel::of_sum(const Eigen::VectorXd& weights) const {
  const Eigen::VectorXd sums = cluster_sums(weights).col(0);
  const double own = weights.dot(white_of_rows().cwiseProduct(weights));
  std::vector<double> variance, uncertainty;
  Spread result;
  for (std::size_t d = 0; d < components_.size(); ++d) {
    const Components& c = components_[d];
    Eigen::VectorXd gradient(c.variances.size());
    for (Eigen::Index k = 0; k < gradient.size(); ++k) gradient[k] = sums.dot(kernels_[d].shapes[static_cast<std::size_t>(k)] * sums);
    variance.push_back(own + std::max(0.0, gradient.dot(c.variances)));
    uncertainty.push_back(gradient.dot(c.uncertainty * gradient) + 2 * own * own / white_freedom_);
    result.variance += c.belief * variance.back();
  }
  double of_variance = 0;
  for (std::size_t d = 0; d < components_.size(); ++d)
    of_variance += components_[d].belief * (uncertainty[d] + std::pow(variance[d] - result.variance, 2));
  result.freedom = std::max(3.0, 2 * result.variance * result.variance / of_variance);
  return result;
}

double ErrorModel::shared_sd() const {
  double result = 0;
  for (std::size_t d = 0; d < components_.size(); ++d) {
    for (Eigen::Index k = 0; k < components_[d].variances.size(); ++k)
      result += components_[d].belief * components_[d].variances[k] * kernels_[d].shapes[static_cast<std::size_t>(k)].diagonal().mean();
  }
  return std::sqrt(std::max(result, 0.0));
}

double ErrorModel::decorrelation() const {
  double result = 0;
  for (const Components& c : components_) result += c.belief * std::log(c.decorrelation);
  return std::exp(result);
}

}  // namespace muster::diagnosis
