#include "diagnosis/replicates/variance_components.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

namespace muster::diagnosis {
namespace {

struct Solved {
  Eigen::VectorXd value;
  Eigen::MatrixXd covariance;
};

// Of the components that may be above 0, by weights at variances `at`.
Solved solved(const Eigen::VectorXd& squares, const Eigen::MatrixXd& shapes, const Eigen::MatrixXd& weights,
              const Eigen::VectorXd& at, double kurtosis) {
  const Eigen::MatrixXd score = at.array().square().inverse().matrix().asDiagonal() * weights;
  const Eigen::MatrixXd inverse =
      Eigen::MatrixXd(score.transpose() * shapes).completeOrthogonalDecomposition().pseudoInverse();
  Solved result{inverse * (score.transpose() * squares), {}};
  const Eigen::VectorXd variance = (shapes * result.value).cwiseMax(0);
  const Eigen::VectorXd of_squares = (kurtosis - 1) * variance.array().square();
  result.covariance = inverse * score.transpose() * of_squares.asDiagonal() * score * inverse.transpose();
  return result;
}

}  // namespace

VarianceComponents variance_components(const Eigen::VectorXd& squares, const Eigen::MatrixXd& shapes,
                                       const Eigen::MatrixXd& weights, double kurtosis) {
  const Eigen::Index count = shapes.cols();
  VarianceComponents result{Eigen::VectorXd::Ones(count), Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count)};
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < count; ++k) free.push_back(k);
  constexpr int rounds = 30;
  for (int round = 0; round < rounds && !free.empty(); ++round) {
    const Eigen::VectorXd at = weights * result.value;
    // Values that no free component moves have no weight.
    const Eigen::VectorXd bounded = (at.array() > 0).select(at, 1);
    const Solved now = solved(squares, shapes(Eigen::all, free), weights(Eigen::all, free), bounded, kurtosis);
    Eigen::VectorXd next = Eigen::VectorXd::Zero(count);
    std::vector<Eigen::Index> left;
    for (std::size_t i = 0; i < free.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      next[free[i]] = std::max(0.0, now.value[k]);
      result.stderror[free[i]] = std::sqrt(now.covariance(k, k));
      result.freedom[free[i]] = now.value[k] > 0 ? 2 * now.value[k] * now.value[k] / now.covariance(k, k) : 0;
      if (now.value[k] > 0) left.push_back(free[i]);
    }
    const double change = (next - result.value).cwiseAbs().maxCoeff() / std::max(next.maxCoeff(), 1e-300);
    result.value = next;
    const bool is_settled = change < 1e-9 && left.size() == free.size();
    free = left;
    if (is_settled) break;
  }
  return result;
}

}  // namespace muster::diagnosis
