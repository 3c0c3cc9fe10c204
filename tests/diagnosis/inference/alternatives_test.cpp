// Alternatives of a finding.
#include "diagnosis/inference/select/alternatives.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "diagnosis/inference/thresholds.hpp"
#include "tests/diagnosis/inference/guessed.hpp"

namespace muster::inference {
namespace {

// With two transmitters, a weak one equals a strong other one, for any readings. With three, or with a given strength
// for each, it does not. The same transmitter under another index is no alternative.
TEST(Alternatives, OfTwoRadiosIncludeTheOtherOne) {
  for (const auto& [transmitters, whole, others] : {std::tuple(2, false, 1u), {3, false, 0u}, {2, true, 0u}}) {
    Recipe recipe = varied(14, 4000);
    recipe.transmitters = transmitters;
    const auto world = world_of(recipe);
    auto causes = causes_of(world);
    Candidate& offset = causes[0];
    ASSERT_EQ(offset.id, "tx_offset");
    offset.design.whole = whole;
    offset.design.grid.push_back(Eigen::VectorXd::Constant(1, 9));
    offset.design.columns = [columns = offset.design.columns, one = offset.design.grid[1]](const Eigen::VectorXd& t) {
      return columns(t[0] == 9 ? one : t);
    };
    offset.label = [](const Eigen::VectorXd& t) { return "tx" + std::to_string(static_cast<int>(t[0])); };
    const Problem problem =
        problem_of(world, -scaled_to(world, offset.design.columns(offset.design.grid[1]).col(0), 100), causes);
    ModelState state(problem, {});
    score(state);
    state.terms = {term_at(state, "tx_offset", offset.design.grid[1])};
    state.refit();
    std::vector<Alternative> own = alternatives_of(state, state.terms[0]);
    std::erase_if(own, [](const Alternative& r) { return r.id != "tx_offset"; });
    ASSERT_EQ(own.size(), others) << transmitters << ' ' << whole;
    if (own.empty()) continue;
    EXPECT_EQ(own[0].label, "tx0");
    EXPECT_NEAR(own[0].separability, 0, 0.01);
    EXPECT_NEAR(own[0].evidence_gap, 0, 0.01);
    EXPECT_NEAR(own[0].by_readings, 0, 0.01);
  }
}

// A steadily falling battery may imitate causes in time, a shuffled one no cause.
TEST(Alternatives, OfAnUnexplainedSmoothAreTheCausesThatExplainItNearlyAsWell) {
  auto world = world_of(varied(254, 3000));
  for (const bool falls : {true, false}) {
    if (!falls) std::shuffle(world.battery.begin(), world.battery.end(), std::mt19937(1));
    const Eigen::VectorXd effect = falls ? world.time : world.battery;
    const Problem problem = problem_of(world, scaled_to(world, effect, 120), causes_of(world));
    ModelState state(problem, {});
    score(state);
    state.terms = {term_at(state, "~battery", {})};
    state.refit();
    std::vector<std::string> causes;
    std::set<std::string> seen;
    for (const Alternative& r : alternatives_of(state, state.terms[0])) {
      EXPECT_TRUE(seen.insert(r.id).second) << r.id << " twice";
      EXPECT_NE(r.id, "~battery");
      if (r.id[0] != '~') causes.push_back(r.id);
      if (r.id != "drift") continue;
      EXPECT_LT(r.separability, thresholds::inseparable);
      EXPECT_NEAR(r.by_readings, r.separability / 2, 3 * std::sqrt(r.separability));
      EXPECT_GT(r.by_readings, r.evidence_gap + 5);  // five functions cost more than a drift's one
    }
    if (falls)
      EXPECT_EQ(std::count(causes.begin(), causes.end(), "drift"), 1);
    else
      EXPECT_EQ(causes, std::vector<std::string>());
  }
}

TEST(Alternatives, AlongOneCovariateListTheLikeliestShape) {
  const auto world = world_of(varied(271, 3000));
  const Eigen::VectorXd knee = -(11.2 - world.battery.array()).max(0.0);
  const Problem problem = problem_of(world, scaled_to(world, knee, 120), causes_of(world));
  ModelState state(problem, {});
  score(state);
  state.terms = {term_at(state, "drift", Eigen::VectorXd::Constant(1, -1))};
  state.refit();
  const WhitenedModel rest = state.whitened_model(state.design_without(state.terms[0]));
  const double of_drift = state.evidence(*state.terms[0].candidate, rest.gain(state.terms[0].columns), 1, false);
  std::vector<double> gaps;  // before refinement
  for (const ScoredCandidate& lead : scored_candidates(state, rest)) {
    if (lead.candidate().own() == "battery") gaps.push_back(of_drift - lead.evidence);
  }
  ASSERT_GE(gaps.size(), 2u);
  const auto [least, most] = std::minmax_element(gaps.begin(), gaps.end());
  EXPECT_GT(*most - *least, 5);
  const std::vector<Alternative> alternatives = alternatives_of(state, state.terms[0]);
  const auto told =
      std::find_if(alternatives.begin(), alternatives.end(), [](const Alternative& r) { return r.id == "~battery"; });
  ASSERT_NE(told, alternatives.end());
  EXPECT_LE(told->evidence_gap, *least + 1e-9);
}

TEST(Alternatives, AreLeftOpenUnlessTheLikelihoodFavoursTheFinding) {
  const auto open = [](double gap, double separability, double by_readings) {
    return left_open({"step", "all", {}, gap, separability, by_readings});
  };
  EXPECT_TRUE(open(2.9, 40, 20));
  EXPECT_TRUE(open(5, 11, 2.9));
  EXPECT_FALSE(open(5, 11, 3.1));
  EXPECT_FALSE(open(5, 13, 0));
}

}  // namespace
}  // namespace muster::inference
