#include "diagnosis/inference/select/f_test.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>

#include "diagnosis/inference/noise/columns.hpp"

namespace muster::inference {

LeastSquares least_squares(const Eigen::MatrixXd& design, const Eigen::VectorXd& y) {
  if (design.cols() == 0) return {0, y.squaredNorm()};
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(design);
  return {qr.rank(), (y - design * qr.solve(y)).squaredNorm()};
}

double log_p_of_f_test(const Eigen::MatrixXd& design, const Eigen::MatrixXd& columns, const Eigen::VectorXd& y) {
  if (y.size() == 0) return 0;
  const auto [rank, squares] = least_squares(design, y);
  const auto [more, left] = least_squares(noise::hstack(design, columns), y);
  const Eigen::Index numbers = more - rank, freedom = y.size() - more;
  if (numbers <= 0 || freedom <= 0 || squares <= 0) return 0;
  if (left <= 0) return std::log(1e-300);
  const auto k = static_cast<double>(numbers), n = static_cast<double>(freedom);
  const double f = std::max(0.0, squares - left) / k / (left / n);
  const double p = boost::math::cdf(boost::math::complement(boost::math::fisher_f(k, n), f));
  return std::log(std::max(p, 1e-300));
}

}  // namespace muster::inference
