// Backward elimination of a guessed model: causes that are replaced, set aside or dropped.
#include "diagnosis/inference/select/backward_elimination.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/diagnosis/inference/guessed.hpp"

namespace muster::inference {
namespace {

struct Guess {
  std::string id;
  Eigen::VectorXd theta;
};

// Terms left of a guessed model.
std::vector<Term> terms_left(const Problem& problem, const std::vector<Guess>& guesses) {
  ModelState state(problem, {});
  score(state);
  for (const auto& [id, theta] : guesses) state.terms.push_back(term_at(state, id, theta));
  state.refit();
  std::vector<Trial> trials;
  backward_elimination(state, trials);
  return state.terms;
}

// A smooth of the battery may enter first, while the field has absorbed a part of an effect in time.
TEST(BackwardElimination, SeparatesAStepInTimeFromAFallingBattery) {
  const auto world = world_of(varied(254, 3000));
  const Eigen::VectorXd step = (world.time.array() > 0.4 * world.time.maxCoeff()).cast<double>(),
                        knee = -(11.7 - world.battery.array()).max(0.0).pow(1.4);
  for (const auto& [effect, name] : {std::pair(step, "step"), std::pair(knee, "~battery")}) {
    const Problem problem = problem_of(world, scaled_to(world, effect, 120), causes_of(world));
    const std::vector<Term> terms = terms_left(problem, {{"~battery", {}}});
    ASSERT_EQ(terms.size(), 1u);
    EXPECT_EQ(terms[0].id(), name);
  }
}

// An advantage below 3 nats suffices; and a true bend is kept.
TEST(BackwardElimination, PrefersADriftToABendOfTheBatteryOnlyWhereItIsLikelier) {
  const auto world = world_of(varied(270, 3000));
  const Eigen::ArrayXd t = world.time.array() / world.time.maxCoeff();
  const Eigen::VectorXd soft = 1 / (1 + (-12 * (t - 0.5)).exp()),
                        knee = -(11.7 - world.battery.array()).max(0.0).pow(1.4);
  for (const auto& [effect, name] : {std::pair(soft, "drift"), std::pair(knee, "~battery")}) {
    const Problem problem = problem_of(world, scaled_to(world, effect, 60), causes_of(world));
    const std::vector<Term> terms = terms_left(problem, {{"bend~battery", Eigen::Vector2d(11.7, -1)}});
    ASSERT_EQ(terms.size(), 1u);
    EXPECT_EQ(terms[0].id(), name);
  }
}

// Levels that fall twice are no one step. Where one of the two is most of it, the other is what is left over.
TEST(BackwardElimination, OfTwoOfOneNameTheOneThatLeadsKeepsIt) {
  const auto world = world_of(varied(254, 3000));
  const double last = world.time.maxCoeff(), first = 0.3 * last, second = 0.7 * last;
  const auto step = [&](double at) -> Eigen::VectorXd { return (world.time.array() > at).cast<double>(); };
  for (const double size : {0.4, -1.0}) {
    const Problem problem =
        problem_of(world, scaled_to(world, step(first) + size * step(second), 600), causes_of(world));
    const std::vector<Term> terms =
        terms_left(problem, {{"step", Eigen::Vector2d(first, -1)}, {"step", Eigen::Vector2d(second, -1)}});
    ASSERT_EQ(terms.size(), 2u);
    EXPECT_EQ(terms[0].id(), size > 0 ? "step" : "~time");
    EXPECT_EQ(terms[1].id(), "~time");
  }
}

// Censors the strongest reading and all close to it.
Problem clipped(Problem problem) {
  const double top = problem.measured.maxCoeff() - 8;
  problem.bounds.known.assign(static_cast<std::size_t>(problem.measured.size()), noise::Known::value);
  for (Eigen::Index i = 0; i < problem.measured.size(); ++i) {
    if (problem.measured[i] < top) continue;
    problem.measured[i] = top;
    problem.bounds.known[static_cast<std::size_t>(i)] = noise::Known::above;
  }
  return problem;
}

// Residuals of clipping fit some place by chance.
TEST(BackwardElimination, RequiresMoreGainOfAWallThanOfADriftBesideClipping) {
  const auto world = world_of(varied(13, 4000));
  auto causes = causes_of(world);
  Candidate& wall = causes[causes.size() - 2];
  ASSERT_EQ(wall.id, "unmapped_wall");
  wall.refinement.proposed = [](Tally&) {
    return std::vector<Eigen::VectorXd>();
  };  // as a candidate with a spatial scan
  const Eigen::VectorXd place = Eigen::Vector4d(12, 8, 5, 0.35), all = Eigen::VectorXd::Constant(1, -1);
  const Problem hidden = problem_of(world, -scaled_to(world, wall.design.columns(place), 50), causes),
                drifts = problem_of(world, scaled_to(world, world.time, 50), causes);
  EXPECT_EQ(terms_left(hidden, {{"unmapped_wall", place}}).size(), 1u);
  EXPECT_EQ(terms_left(clipped(hidden), {{"unmapped_wall", place}}).size(), 0u);
  EXPECT_EQ(terms_left(clipped(drifts), {{"drift", all}}).size(), 1u);
}

TEST(BackwardElimination, DropsTermsThatExplainNothing) {
  const auto world = world_of(varied(13, 4000));
  const auto causes = causes_of(world);
  const Eigen::VectorXd effect = scaled_to(world, causes[2].design.columns({}).col(0), 900);  // antenna_rx
  const Problem problem = problem_of(world, effect, causes);
  const std::vector<Term> terms = terms_left(
      problem, {{"antenna_rx", {}}, {"step", Eigen::Vector2d(100, -1)}, {"drift", Eigen::VectorXd::Constant(1, 2)}});
  ASSERT_EQ(terms.size(), 1u);
  EXPECT_EQ(terms[0].candidate->id, "antenna_rx");
  EXPECT_NEAR(terms[0].gain, 900, 300);
}

TEST(BackwardElimination, ReplacesACauseByABetterAlternative) {
  const auto world = world_of(varied(13, 4000));
  const auto causes = causes_of(world);
  const Eigen::VectorXd effect = scaled_to(world, causes[2].design.columns({}).col(0), 400);  // antenna_rx
  const Problem problem = problem_of(world, effect, causes);
  const std::vector<Term> terms = terms_left(problem, {{"drift", Eigen::VectorXd::Constant(1, 2)}});
  ASSERT_EQ(terms.size(), 1u);
  EXPECT_EQ(terms[0].candidate->id, "antenna_rx");
}

TEST(BackwardElimination, ReplacesACauseByASimplerInseparableOne) {
  const auto world = world_of(varied(34, 4000));
  const auto twins = twins_of(world);
  const Problem problem =
      problem_of(world, scaled_to(world, twins[0].design.columns(twins[0].design.grid[0]), 200), twins);
  const std::vector<Term> terms = terms_left(problem, {{"twin", twins[0].design.grid[0]}});
  ASSERT_EQ(terms.size(), 1u);
  EXPECT_EQ(terms[0].candidate->id, "rx_offset");
}

// A twin with a grid of one transmitter costs less to find, and is no likelier for that.
TEST(BackwardElimination, KeepsTheSimplerCauseAgainstATwinWithASmallerGrid) {
  const auto world = world_of(varied(34, 4000));
  std::vector<Candidate> causes = causes_of(world);
  const auto simple =
      std::find_if(causes.begin(), causes.end(), [](const Candidate& c) { return c.id == "tx_offset"; });
  ASSERT_NE(simple, causes.end());
  Candidate twin = *simple;
  const Eigen::VectorXd theta = simple->design.grid[0];
  twin.id = "twin";
  twin.design.grid = {theta};
  ++twin.role.parameters;
  const Eigen::VectorXd effect = scaled_to(world, simple->design.columns(theta), 200);
  causes.push_back(twin);
  const Problem problem = problem_of(world, effect, causes);
  for (const char* first : {"tx_offset", "twin"}) {
    const std::vector<Term> terms = terms_left(problem, {{first, theta}});
    ASSERT_EQ(terms.size(), 1u);
    EXPECT_EQ(terms[0].candidate->id, "tx_offset") << "from " << first;
  }
}

TEST(BackwardElimination, ReplacesASmoothByTheCauseThatExplainsIt) {
  const auto world = world_of(varied(14, 4000));
  const auto causes = causes_of(world);
  const Eigen::VectorXd effect = scaled_to(world, causes[2].design.columns({}).col(1), 400);
  const Problem problem = problem_of(world, effect, causes);
  const std::vector<Term> terms = terms_left(problem, {{"~bearing", {}}});
  ASSERT_EQ(terms.size(), 1u);
  EXPECT_EQ(terms[0].candidate->id, "antenna_rx");
}

// Each of two robots carries its own shadow: neither alone explains the effect along the bearing.
TEST(BackwardElimination, ReplacesASmoothByTheSameCauseOnTwoRadios) {
  const auto world = world_of(varied(14, 4000));
  auto causes = causes_of(world);
  Candidate& one_robots = causes[2];
  const auto of_all = one_robots.design.columns;
  const auto heard_by = [&](double robot) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::VectorXi>(world.readings.rx.data(), world.readings.size()).unaryExpr([=](int rx) {
      return rx == static_cast<int>(robot) ? 1.0 : 0.0;
    });
  };
  one_robots.design.grid = {Eigen::VectorXd::Constant(1, 100), Eigen::VectorXd::Constant(1, 101)};
  one_robots.design.columns = [&](const Eigen::VectorXd& t) -> Eigen::MatrixXd {
    return heard_by(t[0]).asDiagonal() * of_all({});
  };
  one_robots.label = [](const Eigen::VectorXd& t) { return t[0] == 100 ? "first" : "second"; };
  ASSERT_GT(heard_by(100).sum(), 500);
  ASSERT_GT(heard_by(101).sum(), 500);
  const Eigen::VectorXd effect = scaled_to(world, of_all({}).col(1), 400);
  const std::vector<Term> terms = terms_left(problem_of(world, effect, causes), {{"~bearing", {}}});
  ASSERT_EQ(terms.size(), 2u);
  for (const Term& term : terms) EXPECT_EQ(term.candidate->id, "antenna_rx");
  EXPECT_NE(terms[0].theta, terms[1].theta);
}

// A wave in a part of the time, from one share of it to another.
Candidate wave(const synthetic::World& world, const std::string& id, Kind kind, double from, double to, double cycles) {
  Candidate c;
  c.id = id;
  c.kind = kind;
  c.covariates = {"part"};
  c.design.grid = {Eigen::VectorXd()};
  c.design.columns = [&world, from, to, cycles](const Eigen::VectorXd&) -> Eigen::MatrixXd {
    const Eigen::ArrayXd t = world.time.array() / world.time.maxCoeff();
    return (t >= from && t < to).select((2 * M_PI * cycles * t).cos(), 0.0);
  };
  return c;
}

// A count of walls is the loss of these walls. A battery that falls with time is no drift.
TEST(BackwardElimination, ASmoothGivesWayToACauseOfTheSameEffectThatIsNotInTime) {
  const auto world = world_of(varied(13, 4000));
  const Candidate smooth = wave(world, "~part", Kind::smooth, 0, 1, 7);
  Candidate same = wave(world, "same", Kind::named, 0, 1, 7);
  same.covariates = {"count"};
  const Eigen::VectorXd effect = scaled_to(world, smooth.design.columns({}).col(0), 200);
  for (const bool in_time : {false, true}) {
    same.role.time_like = in_time;
    Problem problem = problem_of(world, effect, {same});
    problem.smooths = {smooth};
    const std::vector<Term> terms = terms_left(problem, {{"~part", {}}});
    ASSERT_EQ(terms.size(), 1u);
    EXPECT_EQ(terms[0].candidate->id, in_time ? "~part" : "same");
  }
}

// Of three on one covariate, each shares rows with the next. A name is withdrawn beside a smooth, and not beside a
// name that is withdrawn itself, in whatever order they were found.
TEST(BackwardElimination, ANameThatIsWithdrawnDoesNotWithdrawTheNext) {
  const auto world = world_of(varied(13, 4000));
  const Candidate smooth = wave(world, "~part", Kind::smooth, 0, 0.6, 7),
                  beside = wave(world, "beside", Kind::named, 0.15, 0.75, 17),
                  further = wave(world, "further", Kind::named, 0.3, 0.9, 27);
  Eigen::VectorXd effect = Eigen::VectorXd::Zero(world.readings.size());
  for (const Candidate& c : {smooth, beside, further}) effect += scaled_to(world, c.design.columns({}).col(0), 200);
  Problem problem = problem_of(world, effect, {beside, further});
  problem.smooths = {smooth};
  for (const auto& order : {std::array{"~part", "beside", "further"}, std::array{"~part", "further", "beside"}}) {
    std::vector<Guess> guesses;
    for (const char* id : order) guesses.push_back({id, {}});
    const std::vector<Term> terms = terms_left(problem, guesses);
    ASSERT_EQ(terms.size(), 3u);
    for (const Term& term : terms) EXPECT_EQ(term.smooth(), term.candidate->id != "further") << term.candidate->id;
  }
}

}  // namespace
}  // namespace muster::inference
