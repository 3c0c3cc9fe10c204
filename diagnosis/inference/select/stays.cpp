#include "diagnosis/inference/select/stays.hpp"

#include <algorithm>

#include "diagnosis/inference/score/marginal_p_value.hpp"
#include "diagnosis/inference/select/f_test.hpp"
#include "diagnosis/inference/state/smooths.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

bool in_time(const Candidate& c) {
  return c.role.time_like || std::any_of(c.covariates.begin(), c.covariates.end(), is_time);
}

class Stays {
 public:
  explicit Stays(const ModelState& state)
      : of_row_(state.problem().layout->stays(state.rows())), readings_(state.rows().count()) {
    all_ = readings_.sum();
    of_row_.resize(static_cast<std::size_t>(readings_.size()), -1);
    for (std::size_t i = 0; i < of_row_.size(); ++i) {
      if (of_row_[i] < 0) readings_[static_cast<Index>(i)] = 0;
      count_ = std::max<Index>(count_, of_row_[i] + 1);
      if (of_row_[i] >= 0) ++rows_;
    }
    weight_ = Eigen::VectorXd::Zero(count_);
    for_each_row([&](Index row, Index stay) { weight_[stay] += readings_[row]; });
  }

  Index count() const { return count_; }
  Index rows() const { return rows_; }
  // True if readings come in stays, and neither one by one nor on the way.
  bool any() const {
    return count_ > 0 && weight_.sum() >= thresholds::readings_a_stay * static_cast<double>(count_) &&
           weight_.sum() >= thresholds::share_in_stays * all_;
  }

  Eigen::MatrixXd mean(const Eigen::MatrixXd& columns) const {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(count_, columns.cols());
    for_each_row([&](Index row, Index stay) { result.row(stay) += readings_[row] * columns.row(row); });
    return weight_.cwiseInverse().asDiagonal() * result;
  }

  // Sum of squares about the means of stays, of readings.
  double squares_within(const Eigen::MatrixXd& columns) const {
    const Eigen::MatrixXd means = mean(columns);
    double sum = 0;
    for_each_row(
        [&](Index row, Index stay) { sum += readings_[row] * (columns.row(row) - means.row(stay)).squaredNorm(); });
    return sum;
  }

  // Share of the columns' variance that lies within stays.
  double share_within(const Eigen::MatrixXd& columns) const {
    const Eigen::RowVectorXd level = readings_.transpose() * columns / readings_.sum();
    const double all = readings_.dot((columns.rowwise() - level).rowwise().squaredNorm());
    return all > 0 ? squares_within(columns) / all : 1;
  }

 private:
  template <class Visit>
  void for_each_row(const Visit& visit) const {
    for (std::size_t i = 0; i < of_row_.size(); ++i)
      if (of_row_[i] >= 0) visit(static_cast<Index>(i), Index{of_row_[i]});
  }

  std::vector<int> of_row_;
  Eigen::VectorXd readings_, weight_;  // of each row that lies in a stay, 0 of others; of each stay
  double all_ = 0;                     // readings, in stays or not
  Index count_ = 0, rows_ = 0;
};

// True if there are stays, within which the columns hardly change.
bool are_between(const Stays& stays, const Eigen::MatrixXd& columns) {
  return stays.any() && stays.share_within(columns) <= thresholds::within_stays;
}

}  // namespace

StayScatter scatter_of_stays(const ModelState& state, const Eigen::MatrixXd& design) {
  const Stays stays(state);
  if (!stays.any()) return {};
  const auto [rank, squares] = least_squares(stays.mean(design), stays.mean(state.y()));
  const Index between = std::max<Index>(stays.count() - rank, 1), within = stays.rows() - stays.count();
  return {stays.count(), squares / static_cast<double>(between),
          within > 0 ? stays.squares_within(state.y()) / static_cast<double>(within)
                     : state.fit.covariance.reading_variance()};
}

bool differs_between_stays(const ModelState& state, const Candidate& candidate, const Eigen::MatrixXd& columns) {
  return in_time(candidate) && are_between(Stays(state), columns);
}

bool is_chance_of_stays(const ModelState& state, const Candidate& candidate, const Eigen::MatrixXd& columns,
                        const Eigen::MatrixXd& design) {
  if (!in_time(candidate)) return false;
  const Stays stays(state);
  if (!are_between(stays, columns)) return false;
  return log_p_of_f_test(stays.mean(design), stays.mean(columns), stays.mean(state.y())) + log_tests(state, candidate) >
         state.threshold();
}

}  // namespace muster::inference
