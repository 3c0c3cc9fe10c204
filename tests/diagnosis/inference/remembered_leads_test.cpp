// What was worked out of leads beside one model is not worked out again, and is what it would be.
#include "diagnosis/inference/select/remembered_leads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "diagnosis/inference/select/refit_noise_pass.hpp"
#include "tests/diagnosis/inference/guessed.hpp"

namespace muster::inference {
namespace {

bool equal(const ScoredCandidate& a, const ScoredCandidate& b) {
  return a.entry == b.entry && a.theta == b.theta && a.columns == b.columns && a.gain == b.gain &&
         a.evidence == b.evidence && a.log_p == b.log_p && a.refined == b.refined;
}

// Counts how often a cause of many optima is asked for its columns.
struct Counted {
  synthetic::World world = world_of(varied(34, 4000));
  int asked = 0;
  Problem problem;

  Counted() {
    auto causes = causes_of(world);
    const auto weak = scaled_to(world, causes[0].design.columns(causes[0].design.grid[0]), 25);
    for (Candidate& cause : causes) {
      cause.design.columns = [this, of = cause.design.columns](const Eigen::VectorXd& theta) {
        ++asked;
        return of(theta);
      };
    }
    problem = problem_of(world, weak, causes);
  }
};

TEST(RememberedLeads, AreWorkedOutOnceEach) {
  const auto world = world_of(varied(34, 4000));
  const auto causes = causes_of(world);
  const Problem problem = problem_of(world, Eigen::VectorXd::Zero(world.readings.size()), causes);
  ModelState state(problem, {});
  std::vector<ScoredCandidate> all = scored_candidates(state, state.whitened_model(state.base()));
  ScoredCandidate elsewhere = all[0];
  elsewhere.theta.array() += 1;
  all.push_back(elsewhere);
  RememberedLeads leads;
  std::size_t worked = 0;
  for (int round = 0; round < 3; ++round) {
    for (const ScoredCandidate& lead : all) {
      const ScoredCandidate result = leads.worked_out(lead, [&](ScoredCandidate of) {
        ++worked;
        of.evidence = of.gain + 1;
        return of;
      });
      EXPECT_EQ(result.theta, lead.theta);
      EXPECT_EQ(result.evidence, lead.gain + 1);
    }
    EXPECT_EQ(worked, all.size());
  }
}

TEST(RememberedLeads, ASecondPassBesideOneModelIsTheSameAndFree) {
  Counted counted;
  ModelState state(counted.problem, {});
  const WhitenedModel model = state.whitened_model(state.base());
  state.renew_depending(model.coefficients(state.sensitivities()));
  const std::vector<ScoredCandidate> all = scored_candidates(state, model);
  const auto any = [](const Candidate&) { return true; };
  RememberedRound known;
  const std::vector<ScoredCandidate> first = refit_noise_pass(state, model, all, any, known);
  ASSERT_FALSE(first.empty());
  EXPECT_GT(counted.asked, 0);
  // The likeliest fails: all but it are asked for again.
  const std::string failed = first[0].candidate().id;
  const auto others = [&](const Candidate& c) { return c.id != failed; };
  RememberedRound none;
  const std::vector<ScoredCandidate> fresh = refit_noise_pass(state, model, all, others, none);
  const std::vector<ScoredCandidate> second = refit_noise_pass(state, model, all, others, known);
  ASSERT_EQ(second.size(), fresh.size());
  for (std::size_t k = 0; k < second.size(); ++k) EXPECT_TRUE(equal(second[k], fresh[k])) << k;
  counted.asked = 0;
  const std::vector<ScoredCandidate> third = refit_noise_pass(state, model, all, others, known);
  EXPECT_EQ(counted.asked, 0);
  ASSERT_EQ(third.size(), fresh.size());
  for (std::size_t k = 0; k < third.size(); ++k) EXPECT_TRUE(equal(third[k], fresh[k])) << k;
}

}  // namespace
}  // namespace muster::inference
