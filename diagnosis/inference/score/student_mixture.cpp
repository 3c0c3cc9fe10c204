#include "diagnosis/inference/score/student_mixture.hpp"

#include <cmath>

#include "diagnosis/inference/noise/dense_solvers.hpp"

namespace muster::inference {

constexpr int freedom = 5;  // degrees

StudentMixture::StudentMixture(std::vector<Eigen::VectorXd> centres, const Eigen::MatrixXd& scale)
    : centres_(std::move(centres)) {
  for (Eigen::Index k = 0; k < scale.cols(); ++k) {
    if (scale(k, k) > 0) varying_.push_back(k);
  }
  const Eigen::MatrixXd of_varying = scale(varying_, varying_);
  root_ = noise::Cholesky(of_varying).lower();
  whitened_.resize(root_.rows(), static_cast<Eigen::Index>(centres_.size()));
  for (std::size_t k = 0; k < centres_.size(); ++k) whitened_.col(static_cast<Eigen::Index>(k)) = whitened(centres_[k]);
}

Eigen::VectorXd StudentMixture::whitened(const Eigen::VectorXd& theta) const {
  return root_.triangularView<Eigen::Lower>().solve(theta(varying_));
}

Eigen::VectorXd StudentMixture::draw(const Stream& stream, uint64_t number) const {
  double squares = 0;
  for (int k = 0; k < freedom; ++k) squares += std::pow(stream.normal(number, static_cast<uint64_t>(k)), 2);
  Eigen::VectorXd normals(root_.rows());
  for (Eigen::Index k = 0; k < normals.size(); ++k)
    normals[k] = stream.normal(number, static_cast<uint64_t>(freedom + k));
  Eigen::VectorXd result = centres_[number % centres_.size()];
  result(varying_) += root_ * normals * std::sqrt(freedom / squares);
  return result;
}

double StudentMixture::density(const Eigen::VectorXd& at) const {
  const Eigen::ArrayXd squared = (whitened_.colwise() - whitened(at)).colwise().squaredNorm();
  const double power = -(freedom + static_cast<double>(root_.rows())) / 2;
  return (1 + squared / freedom).pow(power).mean() / root_.diagonal().prod();
}

}  // namespace muster::inference
