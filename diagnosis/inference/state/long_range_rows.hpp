// Tests of slowly varying effects on longer rows, each with more neighbours than in the search. The few near
// neighbours of the search do not determine the range of the field.
#pragma once

#include <deque>

#include "diagnosis/inference/state/problem.hpp"

namespace muster::inference {

// All arguments have a value a row of the search.
class LongRangeRows {
 public:
  // `rows`: of the search.
  LongRangeRows(noise::Rows long_rows, noise::Sites sites, const Options& options, const noise::Rows& rows);

  // Columns beside a design, and the noise fitted beside both.
  struct Question {
    const Eigen::VectorXd& y;
    const Eigen::MatrixXd& design;
    const Eigen::MatrixXd& columns;
    const noise::Covariance& with;
  };
  // Information on the columns in longer rows, as a share of that in the search's rows: low where the columns change
  // within a row.
  double kept(const Question& question, const noise::Field& own) const;
  // Fall of the deviance as a chi-square under the exact covariance (inference/noise/exact_covariance.hpp).
  double exact_gain(const Question& question) const;
  // Profile-likelihood gain: the noise refitted with the columns, and without them from `without`, each at its best
  // family. So the noise is free to absorb the columns.
  double profile_gain(const Question& question, const noise::Covariance& without,
                      const std::vector<noise::Family>& families) const;
  // Least exact gain over all families, with the noise refitted beside the columns. A family more than `likely_nats`
  // behind the best one is credited with twice the excess.
  double gain_lower_bound(const Question& question) const;

 private:
  Eigen::MatrixXd lengthened(const Eigen::MatrixXd& of_rows) const;
  struct Long;  // a question on longer rows
  Long lengthened(const Question& question) const;
  double exact_gain(const Long& question, const noise::Covariance& covariance) const;
  noise::Fit fitted(const Eigen::VectorXd& y, const Eigen::MatrixXd& design, const noise::Covariance& near,
                    noise::Family family) const;

  // A fit that was made: the bound of a gain and its profile ask for the same, and so do leads beside one model.
  struct Known {
    Eigen::VectorXd y;
    Eigen::MatrixXd design;
    noise::Covariance start;
    noise::Fit fit;
  };

  const noise::Rows& rows_;
  noise::Prior prior_;
  noise::Rows long_rows_;
  noise::Field field_;
  mutable std::deque<Known> known_;
};

}  // namespace muster::inference
