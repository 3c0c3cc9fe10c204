#include "diagnosis/noise/exact.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <map>

#include "diagnosis/noise/neighbourhood.hpp"
#include "diagnosis/noise/reach.hpp"
#include "diagnosis/noise/row_kernel.hpp"

namespace muster::noise {
namespace {

// No two rows lie farther apart, both ends together.
double longest_in(const Sites& sites) {
  const auto size = [](const Eigen::Matrix3Xd& at) {
    return (at.rowwise().maxCoeff() - at.rowwise().minCoeff()).norm();
  };
  return size(sites.place) + size(sites.anchor);
}

bool anchors_move(const Sites& sites) {
  std::map<int, Index> first;  // of each radio
  for (Index i = 0; i < sites.size(); ++i) {
    const Index other = first.try_emplace(sites.radio[static_cast<std::size_t>(i)], i).first->second;
    if (sites.anchor.col(i) != sites.anchor.col(other)) return true;
  }
  return false;
}

// Sites and a table of correlations, as the kernel asks for them.
class PlacedRows {
 public:
  PlacedRows(const Sites& sites, const Covariance& covariance)
      : place_(filled_up(sites.place)), anchor_(filled_up(sites.anchor)), radio_(sites.radio), table_(entries + 1) {
    radio_.resize(static_cast<std::size_t>(place_.rows()));
    const double per_metre = entries / std::max(longest_in(sites), 1.0);
    for (int i = 0; i <= entries; ++i) {
      const double soft = softened(covariance.family, i / per_metre, sites.soft);
      table_[i] = static_cast<float>(correlation(covariance.family, soft / covariance.decorrelation()));
    }
    const double variance = covariance.field_variance(), everywhere = variance * covariance.shared();
    pairs_ = {{place_.col(0).data(), place_.col(1).data(), place_.col(2).data()},
              {anchor_.col(0).data(), anchor_.col(1).data(), anchor_.col(2).data()},
              radio_.data(),
              table_.data(),
              static_cast<float>(per_metre),
              static_cast<float>(everywhere),
              static_cast<float>(variance - everywhere),
              anchors_move(sites)};
  }

  Index filled() const { return place_.rows(); }
  // dB^2, of a row and those before it.
  void covariances(Index row, double* out) const { row_kernels().best().covariances(pairs_, row, out); }

 private:
  static constexpr int entries = 16384;

  // About the first one, so that floats tell them well.
  static Eigen::MatrixX3f filled_up(const Eigen::Matrix3Xd& at) {
    Eigen::MatrixX3f result = Eigen::MatrixX3f::Zero((at.cols() + many - 1) / many * many, 3);
    result.topRows(at.cols()) = (at.colwise() - at.col(0)).transpose().cast<float>();
    return result;
  }

  Eigen::MatrixX3f place_, anchor_;
  std::vector<int> radio_;
  Eigen::VectorXf table_;
  Pairs pairs_;
};

}  // namespace

Eigen::MatrixXd covariance_of_sums(const Sites& sites, const Covariance& covariance, const Eigen::MatrixXd& weights) {
  const PlacedRows rows(sites, covariance);
  Eigen::VectorXd before(rows.filled());
  Eigen::MatrixXd below(weights.rows(), weights.cols());  // the covariance's lower triangle times the weights
  for (Index i = 0; i < sites.size(); ++i) {
    rows.covariances(i, before.data());
    below.row(i).noalias() = before.head(i).transpose() * weights.topRows(i);
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
