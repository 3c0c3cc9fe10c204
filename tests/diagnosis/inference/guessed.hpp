// A guessed model, the start of tests of the search's parts.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "diagnosis/inference/score/candidate_scores.hpp"
#include "diagnosis/inference/state/model_state.hpp"
#include "tests/diagnosis/inference/causes.hpp"

namespace muster::inference {

using synthetic::causes_of;
using synthetic::problem_of;
using synthetic::Recipe;
using synthetic::varied;
using synthetic::world_of;

inline Term term_at(const ModelState& state, const std::string& id, const Eigen::VectorXd& theta) {
  for (const Entry& entry : state.entries()) {
    if (entry.candidate->id == id) return {entry.candidate, theta, state.columns_of(*entry.candidate, theta)};
  }
  throw std::logic_error(id);
}

// Computes nulls for every candidate, as forward selection does.
inline void score(ModelState& state) {
  const WhitenedModel model = state.whitened_model(state.base());
  state.renew_depending(model.coefficients(state.sensitivities()));
  scored_candidates(state, model);
}

// An offset, and the same with one more parameter.
inline std::vector<Candidate> twins_of(const synthetic::World& world) {
  std::vector<Candidate> twins = causes_of(world);
  twins.insert(twins.begin(), twins[1]);
  twins[0].id = "twin";
  ++twins[0].role.parameters;
  return twins;
}

}  // namespace muster::inference
