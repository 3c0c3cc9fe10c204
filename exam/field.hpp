// Shadowing by circulant embedding (Dietrich and Newsam 1997): exact on the nodes of a grid. Each place has its
// node's value.
#pragma once

#include "exam/ground_truth.hpp"

namespace muster::exam {

// Correlation of the law at a distance in m.
double correlation(const FieldLaw& law, double distance);

// Tabled correlation, for the many pairs of a covariance: linear between steps of 2 cm, exact to 1e-4 from 1 cm on.
class CorrelationTable {
 public:
  explicit CorrelationTable(const FieldLaw& law);
  double operator()(double distance) const {
    const double at = distance * per_metre;
    const auto step = static_cast<std::size_t>(at);
    if (step + 1 >= values_.size()) return 0;
    return values_[step] + (at - static_cast<double>(step)) * (values_[step + 1] - values_[step]);
  }

 private:
  static constexpr double per_metre = 50;
  std::vector<double> values_;
};

class Field {
 public:
  // Draws one field for each station and a shared one, over the plan.
  Field(const GroundTruth& site, std::uint64_t seed);

  // dB at a robot's place.
  double operator()(int station, Vec2 world) const;

 private:
  const Plan& plan_;
  FieldLaw law_;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<std::vector<float>> values_;  // variance 1; one for each station, the shared one last
};

}  // namespace muster::exam
