// What readings that could be made would tell apart.
#pragma once

#include "diagnosis/inference/select/alternatives.hpp"

namespace muster::inference {

// A measurement that could be made: the same base and candidates at its readings.
struct Plan {
  std::string say;
  std::shared_ptr<const Layout> layout;
  Eigen::MatrixXd base;
  std::vector<Candidate> candidates;  // by the ids of the problem's, whose grids are used

  bool knows(const std::string& id) const;
};

// The readings at hand with those of a plan, at the noise as it is fitted. Keeps references to both.
class ExpectedSeparability {
 public:
  ExpectedSeparability(const ModelState& state, const Plan& plan);

  // D of a term against each of these rivals, by their ids.
  std::vector<double> separability(const Term& term, const std::vector<std::string>& alternatives) const;

 private:
  // What is at hand above what the plan adds, in rows and whitened.
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& here, const Eigen::MatrixXd& at_readings) const;

  const ModelState& state_;
  const Plan& plan_;
  noise::Rows rows_;
  noise::Field field_;
  noise::Whitener whitener_;
};

}  // namespace muster::inference
