#include "diagnosis/inference/state/long_range_rows.hpp"

#include <algorithm>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/noise/exact_covariance.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

// Fisher information on columns beside a design: the squared lengths of their whitened residuals.
double information(const noise::Field& field, const noise::Covariance& covariance, const Eigen::MatrixXd& design,
                   const Eigen::MatrixXd& columns) {
  const noise::Whitener whitener(field, covariance);
  return noise::basis_of(whitener(design)).rest(whitener(columns)).squaredNorm();
}

}  // namespace

LongRangeRows::LongRangeRows(noise::Rows long_rows, noise::Sites sites, const Options& options, const noise::Rows& rows)
    : rows_(rows),
      prior_(options.prior),
      long_rows_(std::move(long_rows)),
      field_(std::move(sites), {.same = 16, .others = 20, .seed = options.seed}) {}

Eigen::MatrixXd LongRangeRows::lengthened(const Eigen::MatrixXd& of_rows) const {
  Eigen::MatrixXd result(long_rows_.size(), of_rows.cols());
  for (Index j = 0; j < of_rows.cols(); ++j) result.col(j) = long_rows_.mean(rows_.at_readings(of_rows.col(j)));
  return result;
}

struct LongRangeRows::Long {
  Eigen::VectorXd y;
  Eigen::MatrixXd design, columns;
};

LongRangeRows::Long LongRangeRows::lengthened(const Question& q) const {
  return {lengthened(q.y), lengthened(q.design), lengthened(q.columns)};
}

double LongRangeRows::kept(const Question& q, const noise::Field& own) const {
  const Long by_long = lengthened(q);
  return information(field_, q.with, by_long.design, by_long.columns) / information(own, q.with, q.design, q.columns);
}

double LongRangeRows::exact_gain(const Long& q, const noise::Covariance& covariance) const {
  const noise::Whitener whitener(field_, covariance);
  const auto at = noise::whitened(whitener, q.y, q.design, prior_);
  const auto added = noise::basis_of(at.basis.rest(whitener(q.columns)));
  return noise::exact_gain(field_, whitener, added.q, at.residual);
}

double LongRangeRows::exact_gain(const Question& q) const { return exact_gain(lengthened(q), q.with); }

noise::Fit LongRangeRows::fitted(const Eigen::VectorXd& y, const Eigen::MatrixXd& design, const noise::Covariance& near,
                                 noise::Family family) const {
  noise::Covariance from{family, near.theta};
  from.theta[1] += noise::log_scale_of(family) - noise::log_scale_of(near.family);
  const auto same = [&](const Known& known) {
    return known.start == from && known.design.cols() == design.cols() && known.y == y && known.design == design;
  };
  if (const auto known = std::find_if(known_.begin(), known_.end(), same); known != known_.end()) return known->fit;
  constexpr std::size_t most = 64;
  if (known_.size() == most) known_.pop_front();
  return known_.emplace_back(y, design, from, noise::fit(field_, y, design, prior_, from, 4)).fit;
}

double LongRangeRows::profile_gain(const Question& q, const noise::Covariance& without,
                                   const std::vector<noise::Family>& families) const {
  const Eigen::VectorXd y = lengthened(q.y);
  const auto log_likelihood = [&](const Eigen::MatrixXd& design, const noise::Covariance& start) {
    double highest = -1e300;
    for (const noise::Family family : families)
      highest = std::max(highest, fitted(y, design, start, family).log_likelihood());
    return highest;
  };
  const Eigen::MatrixXd design = lengthened(q.design);
  return 2 * (log_likelihood(noise::hstack(design, lengthened(q.columns)), q.with) - log_likelihood(design, without));
}

double LongRangeRows::gain_lower_bound(const Question& q) const {
  const Long question = lengthened(q);
  std::vector<noise::Fit> fits;
  // A share fixed at sites is never left out: no other family holds what all rows of a site share.
  const bool fixed = noise::fixed_share(q.with.family) > 0;
  for (const noise::Family family : fixed ? std::vector{q.with.family} : field_.families())
    fits.push_back(fitted(question.y, noise::hstack(question.design, question.columns), q.with, family));
  const auto likelier = [](const noise::Fit& a, const noise::Fit& b) { return a.value < b.value; };
  const double best = std::min_element(fits.begin(), fits.end(), likelier)->value;
  double least = std::numeric_limits<double>::infinity();
  for (const noise::Fit& fit : fits) {
    const double unlikely = std::max(0.0, fit.value - best - thresholds::likely_nats);
    if (unlikely < thresholds::hopeless_nats)
      least = std::min(least, exact_gain(question, fit.covariance) + 2 * unlikely);
  }
  return least;
}

}  // namespace muster::inference
