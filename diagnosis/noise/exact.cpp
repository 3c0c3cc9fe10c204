#include "diagnosis/noise/exact.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

#include "diagnosis/noise/neighbourhood.hpp"
#include "diagnosis/noise/reach.hpp"

namespace muster::noise {
namespace {

// The correlation at a distance in m, by the nearest entry of a table, as the whitener has it.
class Correlations {
 public:
  Correlations(const Covariance& covariance, double soft, double longest)
      : per_metre_(entries / std::max(longest, 1.0)) {
    for (int i = 0; i <= entries; ++i)
      values_[static_cast<std::size_t>(i)] = correlation(
          covariance.family, softened(covariance.family, i / per_metre_, soft) / covariance.decorrelation());
  }
  double operator()(double distance) const { return values_[static_cast<std::size_t>(distance * per_metre_ + 0.5)]; }

 private:
  static constexpr int entries = 16384;
  double per_metre_;
  std::array<double, entries + 1> values_;
};

// No two rows lie farther apart, both ends together.
double longest_in(const Sites& sites) {
  const auto size = [](const Eigen::Matrix3Xd& at) {
    return (at.rowwise().maxCoeff() - at.rowwise().minCoeff()).norm();
  };
  return size(sites.place) + size(sites.anchor);
}

}  // namespace

Eigen::MatrixXd covariance_of_sums(const Sites& sites, const Covariance& covariance, const Eigen::MatrixXd& weights) {
  using ByRow = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Correlations at(covariance, sites.soft, longest_in(sites));
  const double everywhere = covariance.field_variance() * covariance.shared();
  const double own = covariance.field_variance() - everywhere;
  const ByRow w = weights;
  const Eigen::ArrayX3d places = sites.place.transpose().array(), anchors = sites.anchor.transpose().array();
  const auto squares = [](const Eigen::ArrayX3d& points, Index i) {  // of distances from i to those before it
    const auto along = [&](int axis) { return (points.col(axis).head(i) - points(i, axis)).square(); };
    return Eigen::ArrayXd(along(0) + along(1) + along(2));
  };
  ByRow below = ByRow::Zero(w.rows(), w.cols());  // the covariance's lower triangle times the weights
  for (Index i = 0; i < sites.size(); ++i) {
    const Eigen::ArrayXd apart = squares(places, i), near = apart.sqrt();
    const Eigen::ArrayXd joint = (apart + squares(anchors, i)).sqrt();
    for (Index j = 0; j < i; ++j) {
      double c = everywhere * at(near[j]);
      if (sites.radio[static_cast<std::size_t>(i)] == sites.radio[static_cast<std::size_t>(j)]) c += own * at(joint[j]);
      below.row(i) += c * w.row(j);
    }
  }
  const Eigen::VectorXd alone =
      covariance.field_variance() + floor_variance + covariance.reading_variance() / sites.count.array();
  const Eigen::MatrixXd half = weights.transpose() * below;
  return half + half.transpose() + weights.transpose() * alone.asDiagonal() * weights;
}

Eigen::MatrixXd scatter_of(const Field& field, const Whitener& whitener, const Eigen::MatrixXd& added) {
  const Reach reach(field, whitener);
  Eigen::MatrixXd weights(added.rows(), added.cols());
  for (Index j = 0; j < added.cols(); ++j) weights.col(j) = reach.transposed(added.col(j));
  return covariance_of_sums(field.sites(), whitener.covariance(), weights);
}

double exact_gain(const Field& field, const Whitener& whitener, const Eigen::MatrixXd& added,
                  const Eigen::VectorXd& residual) {
  const Eigen::VectorXd sums = added.transpose() * residual;
  return sums.dot(scatter_of(field, whitener, added).llt().solve(sums));
}

}  // namespace muster::noise
