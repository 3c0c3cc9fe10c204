#include "diagnosis/noise/exact.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <map>

#include "diagnosis/noise/apart.hpp"
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
  const double stretches =
      sites.place_stretch.colwise().norm().maxCoeff() + sites.anchor_stretch.colwise().norm().maxCoeff();
  return size(sites.place) + size(sites.anchor) + stretches;
}

bool anchors_move(const Sites& sites) {
  std::map<int, Index> first;  // of each radio
  for (Index i = 0; i < sites.size(); ++i) {
    const Index other = first.try_emplace(sites.radio[static_cast<std::size_t>(i)], i).first->second;
    if (sites.anchor.col(i) != sites.anchor.col(other) || !sites.anchor_stretch.col(i).isZero(0)) return true;
  }
  return false;
}

// Sites and a table of correlations, as the kernel asks for them.
class PlacedRows {
 public:
  PlacedRows(const Sites& sites, const Covariance& covariance)
      : place_(sites.place, sites.place_stretch),
        anchor_(sites.anchor, sites.anchor_stretch),
        radio_(sites.radio),
        table_(entries + 1) {
    radio_.resize(static_cast<std::size_t>(filled()));
    const double per_metre = entries / std::max(longest_in(sites), 1.0);
    for (int i = 0; i <= entries; ++i)
      table_[i] = static_cast<float>(correlation(covariance.family, i / per_metre / covariance.decorrelation()));
    const bool by_readings = is_rough(covariance.family) && sites.within() > 0;
    if (by_readings) {
      within_place_ = own_share * place_.stretch.rowwise().norm();
      const Eigen::VectorXf of_anchors = own_share * anchor_.stretch.rowwise().norm();
      within_both_ = (within_place_.cwiseAbs2() + of_anchors.cwiseAbs2()).cwiseSqrt();
    }
    const double variance = covariance.field_variance(), everywhere = variance * covariance.shared();
    pairs_ = {place_.columns(),
              anchor_.columns(),
              by_readings ? within_place_.data() : nullptr,
              by_readings ? within_both_.data() : nullptr,
              by_readings ? far_within * within_both_.maxCoeff() : 0,
              radio_.data(),
              table_.data(),
              static_cast<float>(per_metre),
              static_cast<float>(everywhere),
              static_cast<float>(variance - everywhere),
              anchors_move(sites)};
  }

  Index filled() const { return place_.middle.rows(); }
  // dB^2, of a row and those before it.
  void covariances(Index row, double* out) const { row_kernels().best().covariances(pairs_, row, out); }

 private:
  static constexpr int entries = 16384;
  static constexpr float far_within = 13;  // six stretches: a row across another is 2 % farther than its middle

  struct End {
    Eigen::MatrixX3f middle, stretch;

    // About the first middle, so that floats tell them well.
    End(const Eigen::Matrix3Xd& at, const Eigen::Matrix3Xd& stretches)
        : middle(filled_up(at.colwise() - at.col(0))), stretch(filled_up(stretches)) {}

    static Eigen::MatrixX3f filled_up(const Eigen::Matrix3Xd& columns) {
      Eigen::MatrixX3f result = Eigen::MatrixX3f::Zero((columns.cols() + many - 1) / many * many, 3);
      result.topRows(columns.cols()) = columns.transpose().cast<float>();
      return result;
    }
    Ends columns() const {
      Ends result{};
      for (int axis = 0; axis < 3; ++axis) {
        result.middle[axis] = middle.col(axis).data();
        result.stretch[axis] = stretch.col(axis).data();
      }
      return result;
    }
  };

  End place_, anchor_;
  Eigen::VectorXf within_place_, within_both_;
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
