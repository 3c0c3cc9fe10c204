// What tests of laws work on: the model, the readings and the search's result; and the causes that declare a law.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "diagnosis/calibration/fit.hpp"
#include "diagnosis/causes/cause_model.hpp"
#include "diagnosis/inference/state/model_state.hpp"
#include "diagnosis/radio/laws/fading_tests.hpp"
#include "diagnosis/radio/links/world_draws.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

struct LawSources {
  LinkModel& model;
  const WorldDraws& draws;
  const Dataset& data;
  const std::vector<Cause>& causes;    // on the plugin path
  const inference::ModelState& state;  // after the search
  const LinkReadings& readings;        // of the search
  const std::vector<Eigen::Index>& used;
  const Fit& fit;
  std::optional<double> end{};  // dBm; readings below it are not in the table
};

// The causes of this kind with this property, by id.
template <class Has>
std::vector<const Cause*> causes_that(const LawSources& sources, const Has& has) {
  std::vector<const Cause*> result;
  for (const Cause& cause : sources.causes) {
    if (has(cause)) result.push_back(&cause);
  }
  return result;
}

// Laws of causes that change single readings.
std::vector<std::shared_ptr<const ReadingLaw>> laws_of_causes(const LawSources& sources);
// The fitted numbers of the test's cause, with its units and bounds.
std::vector<CauseValue> values_of(const LawSources& sources, const LawTest& test);
// True for a law that is drawn instead of the stated one, not beside it.
bool replaces(const LawSources& sources, const std::string& cause);
// The law of single readings that the world's instances declare.
ReadingDistribution stated_law(const LinkModel& model);

bool beyond_chance(const LawTest& test, double share);

// Tells of causes that they were tested, or why not.
void add_tested(const std::vector<const Cause*>& causes, const std::string& why_not, Diagnosis& found);

// Adds the first of several causes with the same declaration. The readings cannot exclude the others: alternatives.
CauseEstimate& add_named(const LawSources& sources, const std::vector<const Cause*>& alike, const LawTest& test,
                         Diagnosis& found);

}  // namespace muster::diagnosis
