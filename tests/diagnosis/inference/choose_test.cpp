// Choice among significant candidates.
#include "diagnosis/inference/select/choose.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "tests/diagnosis/inference/guessed.hpp"

namespace muster::inference {
namespace {

std::vector<ScoredCandidate> freshly_compared(const ModelState& state, const WhitenedModel& model,
                                              const std::vector<ScoredCandidate>& passing,
                                              const std::vector<ScoredCandidate>& all,
                                              const std::function<bool(const Candidate&)>& usable) {
  RememberedLeads none;
  return compared(state, model, passing, all, usable, none);
}

TEST(Compared, SimplerOfTwoEqualEffectsComesFirst) {
  const auto world = world_of(varied(34, 4000));
  const auto twins = twins_of(world);
  const Problem problem =
      problem_of(world, scaled_to(world, twins[0].design.columns(twins[0].design.grid[0]), 200), twins);
  ModelState state(problem, {});
  const WhitenedModel model = state.whitened_model(state.base());
  state.renew_depending(model.coefficients(state.sensitivities()));
  std::vector<ScoredCandidate> pair;
  for (const ScoredCandidate& lead : scored_candidates(state, model))
    if (lead.candidate().id == "twin" || lead.candidate().id == "rx_offset") pair.push_back(lead);
  ASSERT_EQ(pair.size(), 2u);
  for (int order = 0; order < 2; ++order, std::swap(pair[0], pair[1]))
    EXPECT_EQ(freshly_compared(state, model, pair, pair, [](const Candidate&) { return true; }).front().candidate().id,
              "rx_offset");
}

// A step of 2 dB, at its given strength or any multiple, with a lead off its place. A gain from the refit-noise pass
// is kept beside that of refinement, except for a whole column.
TEST(Compared, RefinedCandidateKeepsItsEarlierGainUnlessItsStrengthIsFixed) {
  const auto world = world_of(varied(254, 3000));
  std::vector<Candidate> causes = causes_of(world);
  const auto step = std::find_if(causes.begin(), causes.end(), [](const Candidate& c) { return c.id == "step"; });
  ASSERT_NE(step, causes.end());
  step->design.columns = [plain = step->design.columns](const Eigen::VectorXd& theta) {
    return Eigen::MatrixXd(2 * plain(theta));
  };
  const double last = world.time.maxCoeff(), won = 500;
  const Eigen::VectorXd effect = step->design.columns(Eigen::Vector2d(0.43 * last, -1));
  for (const bool whole : {false, true}) {
    step->design.whole = whole;
    const Problem problem = problem_of(world, effect, causes);
    ModelState state(problem, {});
    score(state);
    const WhitenedModel model = state.whitened_model(state.base());
    ScoredCandidate lead{&state.entry_of(*step), Eigen::Vector2d(0.405 * last, -1), {}, 0, 0, 0, false, {}};
    lead.columns = state.columns_of(*step, lead.theta);
    const double plain = gain_of(*step, model, lead.columns);
    lead.gain = plain + won;
    const ScoredCandidate best =
        freshly_compared(state, model, {lead}, {lead}, [](const Candidate&) { return true; }).front();
    const double refined = gain_of(*step, model, best.columns);
    EXPECT_NEAR(best.theta[0], 0.43 * last, 0.01 * last);
    EXPECT_GT(refined, plain + 5);
    EXPECT_NEAR(best.gain, whole ? refined : refined + won, 1e-6) << whole;
    EXPECT_NEAR(best.log_p, state.log_p(*step, best.gain, 1, true), 1e-6);
    EXPECT_NEAR(best.evidence, state.evidence(*step, best.gain, 1, true), 1e-6);
  }
}

// What varies with temperature faster than five functions follow: whoever asks for the columns again, at the readings
// or at other rows, asks with theta, and is to get those that were chosen.
TEST(Compared, SmoothThatGrewIsTheSameByItsTheta) {
  const auto world = world_of(varied(71, 3000));
  const Eigen::ArrayXd warm = world.temperature.array() - world.temperature.minCoeff();
  const Eigen::VectorXd fast = (8 * M_PI * warm / warm.maxCoeff()).cos();
  const Problem problem = problem_of(world, scaled_to(world, fast, 400), {});
  ModelState state(problem, {});
  const WhitenedModel model = state.whitened_model(state.design());
  std::vector<ScoredCandidate> all = scored_candidates(state, model);
  all.erase(std::remove_if(all.begin(), all.end(),
                           [](const ScoredCandidate& lead) { return lead.candidate().id != "~temperature"; }),
            all.end());
  ASSERT_EQ(all.size(), 1u);
  const ScoredCandidate best = freshly_compared(state, model, all, {}, [](const Candidate&) { return true; }).front();
  const CandidateDesign& design = best.candidate().design;
  EXPECT_GT(best.columns.cols(), design.width);
  EXPECT_EQ(best.columns, state.columns_of(best.candidate(), best.theta));
  EXPECT_EQ(design.columns(best.theta).cols(), best.columns.cols());
}

// A chirp has two functions and a grid, a bend one function and a grid: each costs twice its gain by chance.
TEST(Compared, ObservedColumnPrecedesTimeAtEqualGainBesideItsFunctions) {
  const auto world = world_of(varied(5, 900));
  const Problem problem = problem_of(world, Eigen::VectorXd::Zero(900), {});
  ModelState state(problem, {});
  const WhitenedModel model = state.whitened_model(state.design());
  std::vector<ScoredCandidate> all = scored_candidates(state, model);
  const auto lead_of = [&](const std::string& id) -> ScoredCandidate& {
    return *std::find_if(all.begin(), all.end(),
                         [&](const ScoredCandidate& lead) { return lead.candidate().id == id; });
  };
  ScoredCandidate swing = lead_of("chirp~time"), bend = lead_of("bend~battery");
  swing.gain = 60, swing.evidence = 20, bend.evidence = 19;
  for (const double more : {-0.1, 0.1}) {
    bend.gain = 60 - 2 * (2 + 1) + 2 * (1 + 1) + more;
    const auto pool = freshly_compared(state, model, {swing, bend}, {}, [](const Candidate&) { return true; });
    EXPECT_EQ(pool[0].candidate().id, more > 0 ? "bend~battery" : "chirp~time");
  }
  // A column's own smooth has no grid.
  ScoredCandidate smooth = lead_of("~temperature");
  smooth.evidence = 19;
  for (const double more : {-0.1, 0.1}) {
    smooth.gain = 60 - 2 * (2 + 1) + 2 * static_cast<double>(smooth.columns.cols()) + more;
    const auto pool = freshly_compared(state, model, {swing, smooth}, {}, [](const Candidate&) { return true; });
    EXPECT_EQ(pool[0].candidate().id, more > 0 ? "~temperature" : "chirp~time");
  }
}

}  // namespace
}  // namespace muster::inference
