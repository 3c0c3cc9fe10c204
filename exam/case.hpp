// A sealed case: a site, two runs over it, and its hidden effects.
#pragma once

#include <cstdint>
#include <memory>

#include "exam/effects/effect.hpp"
#include "exam/field.hpp"

namespace muster::exam {

struct Hidden {
  Effect effect;
  bool in_vocabulary = true;
  double strength = 0;
  double wanted = 0;  // requested lambda
  double lambda = 0;  // of this effect beside the base model and the other effects
};

// Held-out mean squared errors on spatial blocks, in dB^2, of GLS fits with the true covariance.
struct Oracle {
  double without = 0, with = 0;  // the base model alone; the base model beside the true effects
};

struct Order {
  std::string kind;                  // clean, one, two, three, outside
  std::vector<std::string> effects;  // their ids
  std::vector<double> lambdas;       // one an effect
  int rows = 6000;
  std::string walls{};  // of the plan, as a table; empty: drawn at random
};

struct Case {
  std::string name;
  std::uint64_t seed = 0;  // of its site; a fresh one if the case's own could not give the requested lambdas
  Order order;
  std::shared_ptr<GroundTruth> site;  // the effects refer to it
  Data measured, second;
  std::vector<Hidden> hidden;
  Oracle oracle;
};

Case make_case(const std::string& name, std::uint64_t seed, const Order& order);
// Remakes a case from the seed of its site; no oracle.
Case remake_case(const std::string& name, std::uint64_t site_seed, const Order& order);

// Sum of all effects' mean shifts, the receiver's included, expected over the noise.
Eigen::VectorXd expected_shift(const GroundTruth& site, const std::vector<Hidden>& hidden, const Data& data);

std::vector<char> heard(const Data& data);

// Draws field, fading and all other noise, to be added to the mean.
Eigen::VectorXd draw_noise(const Case& made, const Field& field, const Data& data, const std::string& run);

// Fills in the readings that the receivers of a run report.
void hear(const Case& made, const Field& field, Data& data, const std::string& run);

}  // namespace muster::exam
