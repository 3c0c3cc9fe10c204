// Squared errors at what a fit has not seen: blocks of sites, or other groups, are left out in turn, generalised least
// squares on the others (Roberts et al., Ecography 40, 2017). An interval by resampling whole blocks. What is fitted
// are rows, what is foretold are readings: how readings make rows depends on the model, errors of readings can be
// compared.
#pragma once

#include <memory>
#include <string>

#include "diagnosis/inference/noise/vecchia.hpp"

namespace muster::inference {

using Eigen::Index;

struct HeldOutGain {
  double rmse_before = 0, rmse_after = 0;     // dB, of one reading
  double gain = 0, lower95 = 0, upper95 = 0;  // fall of the mean squared error, dB^2
  int blocks = 0;                             // or groups
};

// Squared errors of readings whose block or group was left out, dB^2, and which one that is.
struct Unseen {
  Eigen::VectorXd before, after;  // of the base model and the extended one
  std::vector<int> block;
  uint64_t seed = 0;
};

// By resampling whole blocks.
HeldOutGain compared(const Unseen& unseen);

// The same of a grouping's groups, where there are several.
struct Elsewhere {
  std::string left_out;  // the grouping's name
  HeldOutGain held_out;
};

// Blocks at least three decorrelation distances wide, one a row.
std::vector<int> blocks_of(const noise::Sites& sites, const noise::Covariance& covariance);
// The error at places not seen, dB, with its interval over blocks.
struct Stair {
  double rmse = 0, lower95 = 0, upper95 = 0;
};
// Of the model before.
Stair stair_of(Unseen unseen);

// What was measured and the columns that are to explain it.
struct Sample {
  Eigen::VectorXd y;
  Eigen::MatrixXd design;
};

class Folds {
 public:
  // Blocks of rows, from 0 on, are dealt to five folds. `row_of`: of each reading.
  Folds(const noise::Sites& sites, const std::vector<int>& blocks, const std::vector<Index>& row_of,
        const noise::Covariance& covariance, uint64_t seed);

  int blocks() const { return blocks_; }
  // Fewer than two blocks leave nothing to fit on.
  bool possible() const { return blocks_ >= 2; }
  // Squared error of every reading when its fold was left out.
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
    noise::Field field;
    noise::Whitener whitener;
    Fold(const noise::Sites& sites, const noise::Covariance& covariance, std::vector<Index> in, std::vector<Index> out);
    Fold(const Fold&) = delete;
  };

  uint64_t seed_;
  int blocks_ = 0;
  std::vector<int> block_of_;  // a reading
  std::vector<std::unique_ptr<Fold>> folds_;
};

}  // namespace muster::inference
