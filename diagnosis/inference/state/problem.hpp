// Input of a search: measured values, their layout, the model's own columns, candidates and smooths.
#pragma once

#include <optional>

#include "diagnosis/inference/noise/censored.hpp"
#include "diagnosis/inference/noise/fit.hpp"
#include "diagnosis/inference/state/candidate.hpp"
#include "diagnosis/inference/state/layout.hpp"
#include "diagnosis/inference/state/watch.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {

struct Problem {
  std::shared_ptr<const Layout> layout;
  Eigen::VectorXd measured;  // response of the base design
  noise::Bounds bounds;      // of measured: censored readings
  Eigen::MatrixXd base;  // one row a reading: derivatives of the model's mean by its parameters, a constant among them
  std::vector<Candidate> candidates;
  std::vector<Candidate> smooths;  // generic ones, along every column of a reading (smooths.hpp)
  noise::StatedField stated;       // correlated part of the errors, as the model states it
  // Errors of all readings as the model itself draws them with such a field, one column a draw. Empty: it draws none.
  std::function<Eigen::MatrixXd(const noise::StatedField& field, Index draws)> drawn{};
  // Candidates that depend on the base coefficients of the current model. May be empty.
  std::function<std::vector<Candidate>(const Eigen::VectorXd& base_coefficients)> depending;
};

// Constants of the method (thresholds.hpp explains them), and the caller's hooks.
struct Options {
  double first_alpha = thresholds::first_alpha;
  double further_alpha = thresholds::further_alpha;
  int nulls = thresholds::nulls;
  int draws = thresholds::covariance_draws;
  double one_group_charge = thresholds::one_group_charge;
  double share = thresholds::replacing_share;
  double merge_share = thresholds::merge_share;
  int most_terms = thresholds::most_terms;
  uint64_t seed = 1;
  noise::Prior prior;
  std::optional<noise::Prior> longer{};  // of fields beside which what is found must stand, too; none: no longer ones
  Watch watch{};
};

}  // namespace muster::inference
