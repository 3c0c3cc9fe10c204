// Searches for a model's errors, names their causes where possible, and quantifies the uncertainty.
#pragma once

#include "diagnosis/inference/assess/expected_separability.hpp"
#include "diagnosis/inference/assess/finding.hpp"
#include "diagnosis/inference/assess/held_out_gain.hpp"
#include "diagnosis/inference/assess/parameter_uncertainty.hpp"

namespace muster::inference {

struct Advice {
  std::string say, finding, alternative;
  double separability = 0, predicted = 0;  // D now, and with the plan's readings
};

class Search {
 public:
  // Keeps a reference to the problem. Throws std::invalid_argument if its columns do not match its readings.
  explicit Search(const Problem& problem, const Options& options = {});

  Result run();
  // After run(): expected separability of each plan for every named finding and undecided alternative (D < 25).
  std::vector<Advice> advise(const std::vector<Plan>& plans);

  const ModelState& state() const { return state_; }

 private:
  Finding finding_of(const Term& term, Status status) const;
  // Removes terms whose removal lowers the error at left-out places beyond chance.
  void withdraw_refuted();
  // Parameter uncertainty of each term; moves a place to the middle of its equally likely thetas.
  std::vector<ParameterUncertainty> settle_in_the_middle();
  void check_what_is_left(Result& result, const WhitenedModel& model);

  ModelState state_;
  KeptFolds folds_;
  Result result_;
};

}  // namespace muster::inference
