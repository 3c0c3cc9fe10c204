// Block cross-validation (Roberts et al., Ecography 40, 2017): blocks of sites, or other groups, are left out in
// turn. The others are fitted by generalised least squares (GLS). Intervals by a block bootstrap. Rows are fitted,
// readings are predicted: rows depend on the model, while errors of readings are comparable.
#pragma once

#include <memory>
#include <string>

#include "diagnosis/inference/noise/censored.hpp"
#include "diagnosis/inference/noise/vecchia.hpp"

namespace muster::inference {

using Eigen::Index;

struct HeldOutGain {
  double rmse_before = 0, rmse_after = 0;     // units of a reading, of one reading
  double gain = 0, lower95 = 0, upper95 = 0;  // fall of the mean squared error, squared units of a reading
  int blocks = 0;                             // or groups
};

// Squared errors of readings in left-out blocks or groups, and the block of each.
struct Unseen {
  Eigen::VectorXd before, after;  // of the base model and the extended one, squared units of a reading
  std::vector<int> block;
  uint64_t seed = 0;
};

// Held-out gain with a block-bootstrap interval.
HeldOutGain compared(const Unseen& unseen);

// The same over a grouping with several groups.
struct Elsewhere {
  std::string left_out;  // the grouping's name
  HeldOutGain held_out;
};

// Blocks at least three decorrelation distances wide, one a row.
std::vector<int> blocks_of(const noise::Sites& sites, const noise::Covariance& covariance);
// Prediction error at left-out places, in units of a reading, with its interval over blocks.
struct Stair {
  double rmse = 0, lower95 = 0, upper95 = 0;
  std::string with;  // the finding that it has and the one before has not: a cause, or "~" and a covariate
};
// Of the `before` model.
Stair stair_of(Unseen unseen);

// A response and its design matrix.
struct Sample {
  Eigen::VectorXd y;
  Eigen::MatrixXd design;
  const noise::Bounds* bounds = nullptr;  // of y; null: all are values
};

class Folds {
 public:
  // Deals blocks of rows, numbered from 0, to five folds. `row_of`: of each reading.
  Folds(const noise::Sites& sites, const std::vector<int>& blocks, const std::vector<Index>& row_of,
        const noise::Covariance& covariance, uint64_t seed);
  // The same folds at another covariance.
  Folds(const Folds& other, const noise::Covariance& covariance);

  int blocks() const { return blocks_; }
  // False with fewer than two blocks: nothing is left to fit on.
  bool possible() const { return blocks_ >= 2; }
  // Squared error of every reading with its fold left out; of a censored one by how far the mean misses its bound.
  Eigen::VectorXd squared_errors(const Sample& rows, const Sample& readings) const;
  HeldOutGain compared(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const {
    return inference::compared(unseen(before, after));
  }
  Unseen unseen(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const {
    return {before, after, block_of_, seed_};
  }

 private:
  struct Fold {
    std::vector<Index> fitted, left_out;  // rows, readings
    std::shared_ptr<const noise::Field> field;
    noise::Whitener whitener;
  };

  uint64_t seed_;
  int blocks_ = 0;
  std::vector<int> block_of_;  // of each reading
  std::vector<Fold> folds_;
};

}  // namespace muster::inference
