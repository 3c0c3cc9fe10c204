// What varies slowly, judged by longer rows on more neighbours each than the search has: of few near ones none tells
// how far the field reaches.
#pragma once

#include "diagnosis/inference/state/problem.hpp"

namespace muster::inference {

constexpr double likely_nats = 3;     // that a family may lie behind the best one
constexpr double hopeless_nats = 12;  // beyond those: no gain is so large that it would be the least of all families

// Everything that is given has a value a row of the search.
class LongRangeRows {
 public:
  LongRangeRows(const Layout& layout, const Options& options, const noise::Rows& rows);

  // Columns that a design is extended by, and the noise beside both.
  struct Question {
    const Eigen::VectorXd& y;
    const Eigen::MatrixXd& design;
    const Eigen::MatrixXd& columns;
    const noise::Covariance& with;
  };
  // The share that longer rows keep of what the search's own tell about the columns: little where those change within a
  // row's way.
  double kept(const Question& question, const noise::Field& own) const;
  // The fall of the deviance, as a chi-square under the covariance itself (inference/noise/exact_covariance.hpp).
  double exact_gain(const Question& question) const;
  // The fall of the deviance with the noise fitted beside the columns, and without them from `without`, in each of the
  // families: what they win though the noise could have taken their place.
  double profile_gain(const Question& question, const noise::Covariance& without,
                      const std::vector<noise::Family>& families) const;
  // The exact gain, the noise fitted beside the columns: the least by any family. One that is less likely than the
  // likeliest, by more than `likely_nats`, has to say so much less.
  double sure_gain(const Question& question) const;

 private:
  Eigen::MatrixXd lengthened(const Eigen::MatrixXd& of_rows) const;
  struct Long;  // a question by longer rows
  Long lengthened(const Question& question) const;
  double exact_gain(const Long& question, const noise::Covariance& covariance) const;
  noise::Fit fitted(const Eigen::VectorXd& y, const Eigen::MatrixXd& design, const noise::Covariance& near,
                    noise::Family family) const;

  const noise::Rows& rows_;
  noise::Prior prior_;
  noise::Rows long_rows_;
  noise::Field field_;
};

}  // namespace muster::inference
