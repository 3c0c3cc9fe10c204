// Expected separability: the D that planned readings would give.
#pragma once

#include "diagnosis/inference/select/alternatives.hpp"

namespace muster::inference {

// A planned measurement: the same base and candidates at its readings.
struct Plan {
  std::string say;
  std::shared_ptr<const Layout> layout;
  Eigen::MatrixXd base;
  std::vector<Candidate> candidates;  // with the ids of the problem's candidates, whose grids are used

  bool knows(const std::string& id) const;
};

// The present readings with those of a plan, under the fitted noise. Keeps references to both.
class ExpectedSeparability {
 public:
  ExpectedSeparability(const ModelState& state, const Plan& plan);

  // D of a term against each of these alternatives, by their ids.
  std::vector<double> separability(const Term& term, const std::vector<std::string>& alternatives) const;

 private:
  // Whitened stack of the present rows and the plan's rows.
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& here, const Eigen::MatrixXd& at_readings) const;

  const ModelState& state_;
  const Plan& plan_;
  noise::Rows rows_;
  noise::Field field_;
  noise::Whitener whitener_;
};

}  // namespace muster::inference
