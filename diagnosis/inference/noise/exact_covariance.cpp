#include "diagnosis/inference/noise/exact_covariance.hpp"

#include <cmath>

#include "diagnosis/inference/noise/dense_solvers.hpp"
#include "diagnosis/inference/noise/neighbourhood.hpp"
#include "diagnosis/inference/noise/row_distance.hpp"
#include "diagnosis/inference/noise/row_kernel.hpp"
#include "diagnosis/inference/noise/whitener_columns.hpp"

namespace muster::noise {
namespace {

// Upper bound of the distance between two rows, place and anchor jointly.
double longest_in(const Sites& sites) {
  const auto size = [](const Eigen::Matrix3Xd& at) {
    return (at.rowwise().maxCoeff() - at.rowwise().minCoeff()).norm();
  };
  const double stretches =
      sites.place_stretch.colwise().norm().maxCoeff() + sites.anchor_stretch.colwise().norm().maxCoeff();
  return size(sites.place) + size(sites.anchor) + stretches;
}

// Sites and a table of correlations, in the kernel's layout.
class PlacedRows {
 public:
  PlacedRows(const Sites& sites, const Covariance& covariance)
      : sites_(sites.size()), group_(sites.group), table_(entries + 1) {
    group_.resize(static_cast<std::size_t>(filled()));
    const SiteFloats floats = floats_of(sites);
    for (Index i = 0; i < sites.size(); ++i) sites_.set(i, floats.row(i));
    const double per_metre = entries / std::max(longest_in(sites), 1.0);
    for (int i = 0; i <= entries; ++i)
      table_[i] = static_cast<float>((1 - fixed_share(covariance.family)) *
                                     correlation(covariance.family, i / per_metre / covariance.decorrelation()));
    const bool by_readings = is_rough(covariance.family) && sites.within() > 0;
    const double variance = covariance.field_variance(), everywhere = variance * covariance.shared();
    pairs_ = {sites_.places(by_readings, anchors_move(sites), far_within * sites_.longest_within()),
              group_.data(),
              table_.data(),
              static_cast<float>(per_metre),
              static_cast<float>(everywhere),
              static_cast<float>(variance - everywhere)};
  }

  Index filled() const { return sites_.filled(); }
  // Squared units of a reading: covariances of a row with those before it.
  void covariances(Index row, double* out) const { row_kernels().best().covariances(pairs_, row, out); }

 private:
  static constexpr int entries = 16384;
  static constexpr float far_within = 13;  // six stretches: a row across another is 2 % farther than its middle

  PlacedSites sites_;
  std::vector<int> group_;
  Eigen::VectorXf table_;
  Pairs pairs_;
};

// Covariances of each row with those before it, as the model states them at the nearest tabulated distance.
class StatedRows {
 public:
  StatedRows(const Field& field, const Covariance& covariance)
      : StatedRows(field, (1 - fixed_share(covariance.family)) * covariance.field_variance(),
                   StatedTables::position_of(StatedTables::nearest(covariance).theta[1]).k) {}

  void covariances(Index row, double* out) const {
    const uint16_t* const entry = entries_ + row * (row - 1) / 2;
    for (Index j = 0; j < row; ++j) out[j] = variance_ * StatedTables::correlation_of(entry[j]);
  }
  Eigen::ArrayXd own() const { return variance_ * own_.array().cast<double>(); }

 private:
  StatedRows(const Field& field, double variance, int k)
      : variance_(variance), entries_(field.stated_triangle(k).data()), own_(field.stated(k).own) {}

  double variance_;
  const uint16_t* entries_;
  const Eigen::VectorXf& own_;
};

// Adds the share that is fixed at the row's site to covariances with the rows before it.
void add_fixed(const RecurringSites& recurring, const Covariance& covariance, Index row, double* out) {
  const double of_stream = fixed_share(covariance.family) * covariance.field_variance(),
               of_site = fixed_to_site(covariance.family) * covariance.field_variance();
  if (of_stream == 0) return;
  for (const Index other : recurring.rows_with(row)) {
    if (other >= row) return;
    out[other] += recurring.of(row, other) == Relation::stream ? of_stream : of_site;
  }
}

// 1 of a row that shares the field, 0 of one without.
Eigen::ArrayXd shares_of(const Sites& sites) {
  Eigen::ArrayXd result = Eigen::ArrayXd::Ones(sites.size());
  for (Index i = 0; i < sites.size(); ++i) result[i] = sites.is_alone(i) ? 0 : 1;
  return result;
}

template <class Covariances>
Eigen::MatrixXd sums_of(const Field& field, const Covariance& covariance, const Eigen::MatrixXd& weights,
                        const Covariances& rows, Index filled) {
  const Sites& sites = field.sites();
  const Eigen::ArrayXd shares = shares_of(sites);
  Eigen::VectorXd before(filled);
  Eigen::MatrixXd below(weights.rows(), weights.cols());  // the covariance's lower triangle times the weights
  for (Index i = 0; i < sites.size(); ++i) {
    rows.covariances(i, before.data());
    add_fixed(field.recurring(), covariance, i, before.data());
    before.head(i).array() *= shares[i] * shares.head(i);
    below.row(i).noalias() = before.head(i).transpose() * weights.topRows(i);
  }
  Eigen::ArrayXd of_reading = Eigen::ArrayXd::Constant(sites.size(), covariance.reading_variance());
  for (Index i = 0; i < sites.size(); ++i) {
    if (sites.is_alone(i)) of_reading[i] = sites.alone[static_cast<std::size_t>(i)];
  }
  const Eigen::VectorXd variance =
      field_variances(field, covariance).array() + floor_variance + of_reading / sites.count.array();
  const Eigen::MatrixXd half = weights.transpose() * below;
  return half + half.transpose() + weights.transpose() * variance.asDiagonal() * weights;
}

}  // namespace

Eigen::VectorXd field_variances(const Field& field, const Covariance& covariance) {
  const Eigen::ArrayXd shares = shares_of(field.sites());
  if (!is_stated(covariance.family)) return covariance.field_variance() * shares;
  const double fixed = fixed_share(covariance.family) * covariance.field_variance();
  return shares * (StatedRows(field, covariance).own() + fixed);
}

Eigen::MatrixXd covariance_of_sums(const Field& field, const Covariance& covariance, const Eigen::MatrixXd& weights) {
  const Sites& sites = field.sites();
  if (is_stated(covariance.family)) {
    const StatedRows rows(field, covariance);
    return sums_of(field, covariance, weights, rows, sites.size());
  }
  const PlacedRows rows(field.correlated(), covariance);
  return sums_of(field, covariance, weights, rows, rows.filled());
}

Eigen::MatrixXd scatter_of(const Field& field, const Whitener& whitener, const Eigen::MatrixXd& added) {
  const Reach reach(field, whitener);
  Eigen::MatrixXd weights(added.rows(), added.cols());
  for (Index j = 0; j < added.cols(); ++j) weights.col(j) = reach.transposed(added.col(j));
  return covariance_of_sums(field, whitener.covariance(), weights);
}

double exact_gain(const Field& field, const Whitener& whitener, const Eigen::MatrixXd& added,
                  const Eigen::VectorXd& residual) {
  const Eigen::VectorXd sums = added.transpose() * residual;
  return sums.dot(Cholesky(scatter_of(field, whitener, added)).solve(sums));
}

}  // namespace muster::noise
