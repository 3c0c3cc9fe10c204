#include "diagnosis/inference/select/stays.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <string_view>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

bool in_time(const Candidate& c) {
  constexpr std::string_view time = "time";
  return c.role.time_like || std::any_of(c.covariates.begin(), c.covariates.end(), [&](const std::string& covariate) {
           return std::string_view(covariate).substr(0, time.size()) == time;
         });
}

class Stays {
 public:
  explicit Stays(const ModelState& state)
      : of_row_(state.problem().layout->stays(state.rows())), readings_(state.rows().count()) {
    if (!of_row_.empty()) count_ = 1 + *std::max_element(of_row_.begin(), of_row_.end());
    weight_ = Eigen::VectorXd::Zero(count_);
    for (std::size_t i = 0; i < of_row_.size(); ++i) weight_[of_row_[i]] += readings_[static_cast<Index>(i)];
  }

  Index count() const { return count_; }
  // True if readings come in stays, and not one by one.
  bool any() const {
    return count_ > 0 && readings_.sum() >= thresholds::readings_a_stay * static_cast<double>(count_);
  }

  Eigen::MatrixXd mean(const Eigen::MatrixXd& columns) const {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(count_, columns.cols());
    for (std::size_t i = 0; i < of_row_.size(); ++i)
      result.row(of_row_[i]) += readings_[static_cast<Index>(i)] * columns.row(static_cast<Index>(i));
    return weight_.cwiseInverse().asDiagonal() * result;
  }

  // Sum of squares about the means of stays, of readings.
  double squares_within(const Eigen::MatrixXd& columns) const {
    const Eigen::MatrixXd means = mean(columns);
    double sum = 0;
    for (std::size_t i = 0; i < of_row_.size(); ++i) {
      const auto row = static_cast<Index>(i);
      sum += readings_[row] * (columns.row(row) - means.row(of_row_[i])).squaredNorm();
    }
    return sum;
  }

  // Share of the columns' variance that lies within stays.
  double share_within(const Eigen::MatrixXd& columns) const {
    const Eigen::RowVectorXd level = readings_.transpose() * columns / readings_.sum();
    const double all = readings_.dot((columns.rowwise() - level).rowwise().squaredNorm());
    return all > 0 ? squares_within(columns) / all : 1;
  }

 private:
  std::vector<int> of_row_;
  Eigen::VectorXd readings_, weight_;  // of each row; of each stay
  Index count_ = 0;
};

struct LeastSquares {
  Index rank = 0;
  double squares = 0;  // left
};

LeastSquares least_squares(const Eigen::MatrixXd& design, const Eigen::VectorXd& y) {
  if (design.cols() == 0) return {0, y.squaredNorm()};
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(design);
  return {qr.rank(), (y - design * qr.solve(y)).squaredNorm()};
}

}  // namespace

StayScatter scatter_of_stays(const ModelState& state, const Eigen::MatrixXd& design) {
  const Stays stays(state);
  if (!stays.any()) return {};
  const auto [rank, squares] = least_squares(stays.mean(design), stays.mean(state.y()));
  const Index between = std::max<Index>(stays.count() - rank, 1),
              within = std::max<Index>(state.rows().size() - stays.count(), 1);
  return {stays.count(), squares / static_cast<double>(between),
          stays.squares_within(state.y()) / static_cast<double>(within)};
}

bool differs_between_stays(const ModelState& state, const Candidate& candidate, const Eigen::MatrixXd& columns) {
  if (!in_time(candidate)) return false;
  const Stays stays(state);
  return stays.any() && stays.share_within(columns) <= thresholds::within_stays;
}

bool is_chance_of_stays(const ModelState& state, const Candidate& candidate, const Eigen::MatrixXd& columns,
                        const Eigen::MatrixXd& design) {
  if (!differs_between_stays(state, candidate, columns)) return false;
  const Stays stays(state);
  const Eigen::VectorXd y = stays.mean(state.y());
  const auto [rank, squares] = least_squares(stays.mean(design), y);
  const auto [more, left] = least_squares(stays.mean(noise::hstack(design, columns)), y);
  const Index numbers = more - rank, freedom = stays.count() - more;
  if (numbers <= 0 || freedom <= 0) return true;  // it fits each stay
  const auto k = static_cast<double>(numbers), n = static_cast<double>(freedom);
  const double f = std::max(0.0, squares - left) / k / (left / n);
  const double p = boost::math::cdf(boost::math::complement(boost::math::fisher_f(k, n), f));
  return std::log(std::max(p, 1e-300)) + log_tests(state, candidate) > state.threshold();
}

}  // namespace muster::inference
