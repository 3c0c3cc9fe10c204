// Squared errors at places that a fit has not seen: blocks of space are left out in turn, generalised least squares on
// the others (Roberts et al., Ecography 40, 2017). An interval by resampling whole blocks.
#pragma once

#include <memory>

#include "diagnosis/noise/vecchia.hpp"

namespace muster::search {

using Eigen::Index;

struct HeldOut {
  double rmse_before = 0, rmse_after = 0;     // dB, of one row
  double gain = 0, lower95 = 0, upper95 = 0;  // fall of the mean squared error, dB^2
  int blocks = 0;
};

class Folds {
 public:
  // Blocks at least three decorrelation distances wide, dealt to five folds.
  Folds(const noise::Sites& sites, const noise::Covariance& covariance, uint64_t seed);

  int blocks() const { return blocks_; }
  // Fewer than two blocks leave nothing to fit on.
  bool possible() const { return blocks_ >= 2; }
  // Squared error of every row when its fold was left out.
  Eigen::VectorXd squared_errors(const Eigen::VectorXd& y, const Eigen::MatrixXd& design) const;
  HeldOut compared(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const;

 private:
  struct Fold {
    std::vector<Index> fitted, left_out;
    noise::Field field;
    noise::Whitener whitener;
    Fold(const noise::Sites& sites, const noise::Covariance& covariance, std::vector<Index> in, std::vector<Index> out);
    Fold(const Fold&) = delete;
  };

  uint64_t seed_;
  int blocks_ = 0;
  std::vector<int> block_of_;
  std::vector<std::unique_ptr<Fold>> folds_;
};

}  // namespace muster::search
