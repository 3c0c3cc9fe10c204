// Finds what a model gets wrong, names it where it can be named, and says how sure that is.
#pragma once

#include "diagnosis/inference/assess/expected_separability.hpp"
#include "diagnosis/inference/assess/finding.hpp"
#include "diagnosis/inference/assess/parameter_uncertainty.hpp"

namespace muster::inference {

struct Advice {
  std::string say, finding, rival;
  double separability = 0, predicted = 0;  // D now, and with the plan's readings
};

constexpr Eigen::Index fewest_readings = 50;

class Search {
 public:
  // Keeps a reference to the problem. Throws std::invalid_argument where its columns do not fit its readings.
  explicit Search(const Problem& problem, const Options& options = {});

  Result run();
  // After run(): what each plan would do for every named finding and rival that the data do not decide (D < 25).
  std::vector<Advice> advise(const std::vector<Plan>& plans);

  const Bench& bench() const { return bench_; }

 private:
  Finding finding_of(const Term& term, Status status) const;
  // How well each term is known; a place goes to the middle of those that are as likely.
  std::vector<Spread> settle_in_the_middle();
  void check_what_is_left(Result& result, const Stand& stand);

  Bench bench_;
  Result result_;
};

}  // namespace muster::inference
