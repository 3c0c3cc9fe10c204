// Hypotheses on a map or a log that are judged in worlds of their own: causes with each of their rows and choices.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/causes/cause_model.hpp"
#include "diagnosis/pipeline/setup.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

using InPlan = std::array<double, 2>;  // m, east and north

struct Hypothesis {
  const Cause* cause = nullptr;  // null: the world as it is
  std::size_t number = 0;        // in the order of causes, rows and choices
  CauseRow row{};
  std::map<std::string, std::string> words{};  // its choices and integers
  std::optional<InPlan> place{};               // of a cause that has one, or how far it moves a plan

  std::string label() const;
  // Numbers that were sought, beside the choice among hypotheses.
  double sought() const { return place ? 2 : 0; }
};

// Inserts the hypothesis as an instance during its lifetime. Throws Error.
class Supposed {
 public:
  Supposed(LinkModel& model, const Hypothesis& hypothesis);
  ~Supposed();
  Supposed(const Supposed&) = delete;
  Supposed& operator=(const Supposed&) = delete;

  InPlan move(const InPlan& place);  // as near as its bounds allow: there

 private:
  LinkModel& model_;
  const Cause* cause_;
};

struct Hypotheses {
  std::vector<Hypothesis> all;
  std::vector<std::string> searched, not_tested;  // causes with MUSTER_OWN_WORLD; those not tested with the reason
};

// Those of causes with MUSTER_OWN_WORLD, and exchanged identities, with which they compete. A cause with a place, or
// with two free parameters in metres, how far east and north it moves a plan, has several starts each, a move also
// the one that `found` has in common in the places of several radios.
Hypotheses hypotheses_of(const DiagnosisSetup& setup, const Diagnosis& found);

// The finding that states a hypothesis, without its evidence.
CauseEstimate stated(const Hypothesis& hypothesis, const InPlan& place_sd);

}  // namespace muster::diagnosis
