// What becomes of a guessed model: pieces that merge, places in the middle, causes that give way or are dropped.
#include "diagnosis/search/clean_up.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <tuple>

#include "diagnosis/search/beside.hpp"
#include "diagnosis/search/choose.hpp"
#include "diagnosis/search/merge.hpp"
#include "diagnosis/search/rivals.hpp"
#include "diagnosis/search/spread.hpp"
#include "diagnosis/search/uncertainty.hpp"
#include "tests/search/causes.hpp"

namespace muster::search {
namespace {

using synthetic::causes_of;
using synthetic::problem_of;
using synthetic::Recipe;
using synthetic::varied;
using synthetic::world_of;

Term term_at(const Bench& bench, const std::string& id, const Eigen::VectorXd& theta) {
  for (const Entry& entry : bench.entries()) {
    if (entry.candidate->id == id) return {entry.candidate, theta, bench.columns_of(*entry.candidate, theta)};
  }
  throw std::logic_error(id);
}

// Nulls for every candidate, as the forward search would have worked out.
void score(Bench& bench) {
  const Stand stand = bench.stand(bench.base());
  bench.renew_depending(stand.coefficients(bench.base_columns()));
  leads(bench, stand);
}

TEST(Merge, TwoHalvesOfOneWallBecomeTheWall) {
  const auto world = world_of(varied(11, 4000));
  const auto causes = causes_of(world);
  const Candidate& wall = causes[causes.size() - 2];
  ASSERT_EQ(wall.id, "unmapped_wall");
  const Eigen::VectorXd whole = Eigen::Vector4d(12, 8, 5, 0.35);
  const Eigen::VectorXd effect = -scaled_to(world, wall.columns(whole), 400);
  const Problem problem = problem_of(world, effect, causes);
  Bench bench(problem, {});
  score(bench);
  const double x = 1.25 * std::cos(0.35), y = 1.25 * std::sin(0.35);
  bench.terms.push_back(term_at(bench, "unmapped_wall", Eigen::Vector4d(12 - x, 8 - y, 2.5, 0.35)));
  bench.terms.push_back(term_at(bench, "unmapped_wall", Eigen::Vector4d(12 + x, 8 + y, 2.5, 0.35)));
  bench.refit();
  ASSERT_TRUE(merge_pieces(bench, "place"));
  ASSERT_EQ(bench.terms.size(), 1u);
  const Eigen::VectorXd& found = bench.terms[0].theta;
  EXPECT_EQ(bench.terms[0].candidate->id, "unmapped_wall");
  EXPECT_LT(std::hypot(found[0] - 12, found[1] - 8), 0.5);
  EXPECT_NEAR(found[2], 5, 1);
}

TEST(Merge, TwoWallsStayTwo) {
  const auto world = world_of(varied(12, 4000));
  const auto causes = causes_of(world);
  const Candidate& wall = causes[causes.size() - 2];
  const Eigen::VectorXd one = Eigen::Vector4d(6, 5, 4, 0), other = Eigen::Vector4d(18, 10, 4, M_PI / 2);
  const Eigen::VectorXd effect = -scaled_to(world, wall.columns(one), 150) - scaled_to(world, wall.columns(other), 150);
  const Problem problem = problem_of(world, effect, causes);
  Bench bench(problem, {});
  score(bench);
  bench.terms = {term_at(bench, "unmapped_wall", one), term_at(bench, "unmapped_wall", other)};
  bench.refit();
  EXPECT_FALSE(merge_pieces(bench, "place"));
  EXPECT_EQ(bench.terms.size(), 2u);
}

TEST(Spread, ItsMiddleIsAPlaceThatExplainsAsMuch) {
  const auto world = world_of(varied(12, 4000));
  const auto causes = causes_of(world);
  const Candidate& wall = causes[causes.size() - 2];
  const Eigen::Vector4d place(12, 8, 4, 0), east(1, 0, 0, 0);
  const Problem problem = problem_of(world, -scaled_to(world, wall.columns(place), 300), causes);
  Bench bench(problem, {});
  const auto middle = [&](const Eigen::Vector4d& found, const std::vector<double>& alike) {
    bench.terms = {term_at(bench, "unmapped_wall", found)};
    bench.refit();
    Spread spread;
    for (const double off : alike) spread.thetas.push_back(place + off * east);
    return middle_of(bench, bench.terms[0], spread)[0] - place[0];
  };
  EXPECT_NEAR(middle(place + east, {-1, -0.8, -0.6, -0.4, -0.2, 0, 0.2, 0.4, 0.6, 0.8, 1}), 0, 0.7);
  EXPECT_NEAR(middle(place, {0, -0.001, -4, -7.999, -8}), 0, 0.1);  // what is between two places explains nothing
}

// Against the sum over a grid of places and sizes.
TEST(Spread, OfAThingIsThatOfTheWholeLikelihood) {
  const auto world = world_of(varied(12, 4000));
  const auto causes = causes_of(world);
  const Candidate& thing = causes.back();
  const Eigen::Vector3d truth(11, 7, 0.7);
  const Problem problem = problem_of(world, -scaled_to(world, thing.columns(truth), 60), causes);
  Bench bench(problem, {});
  bench.terms = {term_at(bench, "obstacle", truth)};
  bench.refit();
  score(bench);
  const Term& term = bench.terms[0];
  const Spread spread = spread_of(bench, term);
  const Stand rest = bench.stand(bench.design_without(term)), whole = bench.stand(bench.design());
  const Index last = whole.design.cols() - 1;
  const double overstated = std::max(
      1.0, uncertainty_of(bench, bench.design())(last, last) / whole.at.basis.uncertainty(last + 1)(last, last));
  const Beside found(rest, term.columns, false);
  auto still = std::make_shared<Candidate>(*term.candidate);
  still->step.setZero();
  std::shared_ptr<const Candidate> known = still;
  std::swap(bench.terms[0].candidate, known);
  const double grown = spread_of(bench, term).coefficients(0, 0) / found.covariance(0, 0);
  std::swap(bench.terms[0].candidate, known);
  Eigen::Array3d sum = Eigen::Array3d::Zero(), squares = sum;
  double weights = 0, within = 0, losses = 0, loss_squares = 0;
  const double top = rest.gain(term.columns);
  for (double x = -0.24; x <= 0.24; x += 0.02) {
    for (double y = -0.1; y <= 0.38; y += 0.02) {
      for (double radius = -0.2; radius <= 0.12; radius += 0.016) {
        const Eigen::Vector3d theta = truth + Eigen::Vector3d(x, y, radius);
        const Beside there(rest, bench.columns_of(*term.candidate, theta), false);
        if (there.gain < top - 40) continue;  // a thing that hides no link has no loss at all
        const double w = std::exp((there.gain - top) / (2 * overstated)), loss = there.coefficients[0];
        const Eigen::Array3d off = theta - truth;
        weights += w, sum += w * off, squares += w * off.square();
        within += w * there.covariance(0, 0), losses += w * loss, loss_squares += w * loss * loss;
      }
    }
  }
  const Eigen::Array3d mean = sum / weights, sd = (squares / weights - mean.square()).sqrt();
  Eigen::Array3d told = Eigen::Array3d::Zero(), scattered = told;
  const auto count = static_cast<double>(spread.thetas.size());
  for (const auto& theta : spread.thetas) told += (theta - truth).array() / count;
  for (const auto& theta : spread.thetas) scattered += ((theta - truth).array() - told).square() / count;
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(told[k], mean[k], 0.25 * sd[k]) << k;
    EXPECT_NEAR(std::sqrt(scattered[k]) / sd[k], 1, 0.15) << k;
  }
  const double loss = found.coefficients[0];  // that is told, whatever the mean is
  const double between = loss_squares / weights - 2 * loss * losses / weights + loss * loss;
  EXPECT_NEAR(spread.coefficients(0, 0) / (grown * within / weights + between), 1, 0.15);
}

// A weak one of two transmitters is the other one's strength, whatever is read; among three it is not, nor where the
// strength of each is given. The same transmitter by another number is no rival.
TEST(Rivals, OfTwoRadiosEitherMayBeMeant) {
  for (const auto& [transmitters, whole, others] : {std::tuple(2, false, 1u), {3, false, 0u}, {2, true, 0u}}) {
    Recipe recipe = varied(14, 4000);
    recipe.transmitters = transmitters;
    const auto world = world_of(recipe);
    auto causes = causes_of(world);
    Candidate& offset = causes[0];
    ASSERT_EQ(offset.id, "tx_offset");
    offset.whole = whole;
    offset.grid.push_back(Eigen::VectorXd::Constant(1, 9));
    offset.columns = [columns = offset.columns, one = offset.grid[1]](const Eigen::VectorXd& t) {
      return columns(t[0] == 9 ? one : t);
    };
    offset.label = [](const Eigen::VectorXd& t) { return "tx" + std::to_string(static_cast<int>(t[0])); };
    const Problem problem = problem_of(world, -scaled_to(world, offset.columns(offset.grid[1]).col(0), 100), causes);
    Bench bench(problem, {});
    score(bench);
    bench.terms = {term_at(bench, "tx_offset", offset.grid[1])};
    bench.refit();
    std::vector<Rival> own = rivals_of(bench, bench.terms[0]);
    std::erase_if(own, [](const Rival& r) { return r.id != "tx_offset"; });
    ASSERT_EQ(own.size(), others) << transmitters << ' ' << whole;
    if (own.empty()) continue;
    EXPECT_EQ(own[0].label, "tx0");
    EXPECT_NEAR(own[0].separability, 0, 0.01);
    EXPECT_NEAR(own[0].evidence_gap, 0, 0.01);
    EXPECT_NEAR(own[0].by_readings, 0, 0.01);
  }
}

// A battery that falls all the while may stand for what acts in time, one that comes and goes for nothing else.
TEST(Rivals, OfWhatIsUnexplainedAreTheCausesThatExplainItNearlyAsWell) {
  auto world = world_of(varied(254, 3000));
  for (const bool falls : {true, false}) {
    if (!falls) std::shuffle(world.battery.begin(), world.battery.end(), std::mt19937(1));
    const Eigen::VectorXd effect = falls ? world.time : world.battery;
    const Problem problem = problem_of(world, scaled_to(world, effect, 120), causes_of(world));
    Bench bench(problem, {});
    score(bench);
    bench.terms = {term_at(bench, "~battery", {})};
    bench.refit();
    std::vector<std::string> causes;
    std::set<std::string> seen;
    for (const Rival& r : rivals_of(bench, bench.terms[0])) {
      EXPECT_TRUE(seen.insert(r.id).second) << r.id << " twice";
      EXPECT_NE(r.id, "~battery");
      if (r.id[0] != '~') causes.push_back(r.id);
      if (r.id != "drift") continue;
      EXPECT_LT(r.separability, inseparable);
      EXPECT_NEAR(r.by_readings, r.separability / 2, 3 * std::sqrt(r.separability));
      EXPECT_GT(r.by_readings, r.evidence_gap + 5);  // five functions cost more than a drift's one
    }
    if (falls)
      EXPECT_EQ(std::count(causes.begin(), causes.end(), "drift"), 1);
    else
      EXPECT_EQ(causes, std::vector<std::string>());
  }
}

TEST(Rivals, OfSeveralWaysAlongOneCovariateTheLikestIsTold) {
  const auto world = world_of(varied(271, 3000));
  const Eigen::VectorXd knee = -(11.2 - world.battery.array()).max(0.0);
  const Problem problem = problem_of(world, scaled_to(world, knee, 120), causes_of(world));
  Bench bench(problem, {});
  score(bench);
  bench.terms = {term_at(bench, "drift", Eigen::VectorXd::Constant(1, -1))};
  bench.refit();
  const Stand rest = bench.stand(bench.design_without(bench.terms[0]));
  const double of_drift = bench.evidence(*bench.terms[0].candidate, rest.gain(bench.terms[0].columns), 1, false);
  std::vector<double> gaps;  // before the refinement of those that have a place to refine
  for (const Lead& lead : leads(bench, rest)) {
    if (lead.candidate().own() == "battery") gaps.push_back(of_drift - lead.evidence);
  }
  ASSERT_GE(gaps.size(), 2u);
  const auto [least, most] = std::minmax_element(gaps.begin(), gaps.end());
  EXPECT_GT(*most - *least, 5);
  const std::vector<Rival> rivals = rivals_of(bench, bench.terms[0]);
  const auto told = std::find_if(rivals.begin(), rivals.end(), [](const Rival& r) { return r.id == "~battery"; });
  ASSERT_NE(told, rivals.end());
  EXPECT_LE(told->evidence_gap, *least + 1e-9);
}

TEST(Rivals, AreLeftOpenUnlessTheReadingsThemselvesSpeakForTheFinding) {
  const auto open = [](double gap, double separability, double by_readings) {
    return left_open({"step", "all", {}, gap, separability, by_readings});
  };
  EXPECT_TRUE(open(2.9, 40, 20));
  EXPECT_TRUE(open(5, 11, 2.9));
  EXPECT_FALSE(open(5, 11, 3.1));
  EXPECT_FALSE(open(5, 13, 0));
}

struct Guess {
  std::string id;
  Eigen::VectorXd theta;
};

// What cleaning up leaves of a model that was guessed so.
std::vector<Term> cleaned_up(const Problem& problem, const std::vector<Guess>& guesses) {
  Bench bench(problem, {});
  score(bench);
  for (const auto& [id, theta] : guesses) bench.terms.push_back(term_at(bench, id, theta));
  bench.refit();
  std::vector<Trial> trials;
  clean_up(bench, trials);
  return bench.terms;
}

// A function of the battery may enter first, while the field holds a part of what acts in time.
TEST(CleanUp, WhatActsInTimeIsNotTheBatteryThatFallsMeanwhile) {
  const auto world = world_of(varied(254, 3000));
  const Eigen::VectorXd step = (world.time.array() > 0.4 * world.time.maxCoeff()).cast<double>(),
                        knee = -(11.7 - world.battery.array()).max(0.0).pow(1.4);
  for (const auto& [effect, name] : {std::pair(step, "step"), std::pair(knee, "~battery")}) {
    const Problem problem = problem_of(world, scaled_to(world, effect, 120), causes_of(world));
    const std::vector<Term> terms = cleaned_up(problem, {{"~battery", {}}});
    ASSERT_EQ(terms.size(), 1u);
    EXPECT_EQ(terms[0].id(), name);
  }
}

// Less than 3 nats likelier is likelier; and a true bend keeps its place.
TEST(CleanUp, WhatActsInTimeStandsWhereItIsLikelierThanABendAlongTheBattery) {
  const auto world = world_of(varied(270, 3000));
  const Eigen::ArrayXd t = world.time.array() / world.time.maxCoeff();
  const Eigen::VectorXd soft = 1 / (1 + (-12 * (t - 0.5)).exp()),
                        knee = -(11.7 - world.battery.array()).max(0.0).pow(1.4);
  for (const auto& [effect, name] : {std::pair(soft, "drift"), std::pair(knee, "~battery")}) {
    const Problem problem = problem_of(world, scaled_to(world, effect, 60), causes_of(world));
    const std::vector<Term> terms = cleaned_up(problem, {{"bend~battery", Eigen::Vector2d(11.7, -1)}});
    ASSERT_EQ(terms.size(), 1u);
    EXPECT_EQ(terms[0].id(), name);
  }
}

// The strongest reading and all that come near it are known to be as strong at least.
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

// What a clip leaves over finds a place somewhere.
TEST(CleanUp, BesideAClipAWallMustWinMoreThanADrift) {
  const auto world = world_of(varied(13, 4000));
  auto causes = causes_of(world);
  Candidate& wall = causes[causes.size() - 2];
  ASSERT_EQ(wall.id, "unmapped_wall");
  wall.proposed = [](Tally&) { return std::vector<Eigen::VectorXd>(); };  // as one that is sought over a plan
  const Eigen::VectorXd place = Eigen::Vector4d(12, 8, 5, 0.35), all = Eigen::VectorXd::Constant(1, -1);
  const Problem hidden = problem_of(world, -scaled_to(world, wall.columns(place), 50), causes),
                drifts = problem_of(world, scaled_to(world, world.time, 50), causes);
  EXPECT_EQ(cleaned_up(hidden, {{"unmapped_wall", place}}).size(), 1u);
  EXPECT_EQ(cleaned_up(clipped(hidden), {{"unmapped_wall", place}}).size(), 0u);
  EXPECT_EQ(cleaned_up(clipped(drifts), {{"drift", all}}).size(), 1u);
}

TEST(CleanUp, DropsWhatCarriesNothingAndSetsLeftoversAside) {
  const auto world = world_of(varied(13, 4000));
  const auto causes = causes_of(world);
  const Eigen::VectorXd effect = scaled_to(world, causes[2].columns({}).col(0), 900);  // antenna_rx
  const Problem problem = problem_of(world, effect, causes);
  const std::vector<Term> terms = cleaned_up(
      problem, {{"antenna_rx", {}}, {"step", Eigen::Vector2d(100, -1)}, {"drift", Eigen::VectorXd::Constant(1, 2)}});
  ASSERT_EQ(terms.size(), 1u);
  EXPECT_EQ(terms[0].candidate->id, "antenna_rx");
  EXPECT_NEAR(terms[0].gain, 900, 300);
}

TEST(CleanUp, ACauseGivesWayToARivalThatDoesBetter) {
  const auto world = world_of(varied(13, 4000));
  const auto causes = causes_of(world);
  const Eigen::VectorXd effect = scaled_to(world, causes[2].columns({}).col(0), 400);  // antenna_rx
  const Problem problem = problem_of(world, effect, causes);
  const std::vector<Term> terms = cleaned_up(problem, {{"drift", Eigen::VectorXd::Constant(1, 2)}});
  ASSERT_EQ(terms.size(), 1u);
  EXPECT_EQ(terms[0].candidate->id, "antenna_rx");
}

// An offset, and the same with one parameter more.
std::vector<Candidate> twins_of(const synthetic::World& world) {
  std::vector<Candidate> twins = causes_of(world);
  twins.insert(twins.begin(), twins[1]);
  twins[0].id = "twin";
  ++twins[0].parameters;
  return twins;
}

TEST(CleanUp, ACauseGivesWayToASimplerOneThatTheReadingsCannotTellFromIt) {
  const auto world = world_of(varied(34, 4000));
  const auto twins = twins_of(world);
  const Problem problem = problem_of(world, scaled_to(world, twins[0].columns(twins[0].grid[0]), 200), twins);
  const std::vector<Term> terms = cleaned_up(problem, {{"twin", twins[0].grid[0]}});
  ASSERT_EQ(terms.size(), 1u);
  EXPECT_EQ(terms[0].candidate->id, "rx_offset");
}

// A twin that is sought at one transmitter alone costs less to find, and is no more likely for that.
TEST(CleanUp, ASimpleCauseGivesNoWayToATwinThatIsSoughtAtFewerPlaces) {
  const auto world = world_of(varied(34, 4000));
  std::vector<Candidate> causes = causes_of(world);
  const auto simple =
      std::find_if(causes.begin(), causes.end(), [](const Candidate& c) { return c.id == "tx_offset"; });
  ASSERT_NE(simple, causes.end());
  Candidate twin = *simple;
  const Eigen::VectorXd theta = simple->grid[0];
  twin.id = "twin";
  twin.grid = {theta};
  ++twin.parameters;
  const Eigen::VectorXd effect = scaled_to(world, simple->columns(theta), 200);
  causes.push_back(twin);
  const Problem problem = problem_of(world, effect, causes);
  for (const char* first : {"tx_offset", "twin"}) {
    const std::vector<Term> terms = cleaned_up(problem, {{first, theta}});
    ASSERT_EQ(terms.size(), 1u);
    EXPECT_EQ(terms[0].candidate->id, "tx_offset") << "from " << first;
  }
}

TEST(Compared, TheSimplerOfTwoWithTheSameEffectComesFirst) {
  const auto world = world_of(varied(34, 4000));
  const auto twins = twins_of(world);
  const Problem problem = problem_of(world, scaled_to(world, twins[0].columns(twins[0].grid[0]), 200), twins);
  Bench bench(problem, {});
  const Stand stand = bench.stand(bench.base());
  bench.renew_depending(stand.coefficients(bench.base_columns()));
  std::vector<Lead> pair;
  for (const Lead& lead : leads(bench, stand))
    if (lead.candidate().id == "twin" || lead.candidate().id == "rx_offset") pair.push_back(lead);
  ASSERT_EQ(pair.size(), 2u);
  for (int order = 0; order < 2; ++order, std::swap(pair[0], pair[1]))
    EXPECT_EQ(compared(bench, stand, pair, pair, [](const Candidate&) { return true; }).front().candidate().id,
              "rx_offset");
}

// A step of 2 dB, as it is or by any multiple, where a lead of it lies off. What a second look won is its own
// beside what refinement wins, unless a multiple of it means nothing.
TEST(Compared, ALeadIsRefinedAndKeepsWhatItWonUnlessItCountsAsItIs) {
  const auto world = world_of(varied(254, 3000));
  std::vector<Candidate> causes = causes_of(world);
  const auto step = std::find_if(causes.begin(), causes.end(), [](const Candidate& c) { return c.id == "step"; });
  ASSERT_NE(step, causes.end());
  step->columns = [plain = step->columns](const Eigen::VectorXd& theta) { return Eigen::MatrixXd(2 * plain(theta)); };
  const double last = world.time.maxCoeff(), won = 500;
  const Eigen::VectorXd effect = step->columns(Eigen::Vector2d(0.43 * last, -1));
  for (const bool whole : {false, true}) {
    step->whole = whole;
    const Problem problem = problem_of(world, effect, causes);
    Bench bench(problem, {});
    score(bench);
    const Stand stand = bench.stand(bench.base());
    Lead lead{&bench.entry_of(*step), Eigen::Vector2d(0.405 * last, -1), {}, 0, 0, 0, false, {}};
    lead.columns = bench.columns_of(*step, lead.theta);
    const double plain = gain_of(*step, stand, lead.columns);
    lead.gain = plain + won;
    const Lead best = compared(bench, stand, {lead}, {lead}, [](const Candidate&) { return true; }).front();
    const double refined = gain_of(*step, stand, best.columns);
    EXPECT_NEAR(best.theta[0], 0.43 * last, 0.01 * last);
    EXPECT_GT(refined, plain + 5);
    EXPECT_NEAR(best.gain, whole ? refined : refined + won, 1e-6) << whole;
    EXPECT_NEAR(best.log_p, bench.log_p(*step, best.gain, 1, true), 1e-6);
    EXPECT_NEAR(best.evidence, bench.evidence(*step, best.gain, 1, true), 1e-6);
  }
}

TEST(CleanUp, ASmoothGivesWayToTheCauseThatExplainsIt) {
  const auto world = world_of(varied(14, 4000));
  const auto causes = causes_of(world);
  const Eigen::VectorXd effect = scaled_to(world, causes[2].columns({}).col(1), 400);
  const Problem problem = problem_of(world, effect, causes);
  const std::vector<Term> terms = cleaned_up(problem, {{"~bearing", {}}});
  ASSERT_EQ(terms.size(), 1u);
  EXPECT_EQ(terms[0].candidate->id, "antenna_rx");
}

// Of two robots each carries what shadows it: neither alone explains what both do along the bearing.
TEST(CleanUp, ASmoothGivesWayToTheSameCauseOnTwoRadios) {
  const auto world = world_of(varied(14, 4000));
  auto causes = causes_of(world);
  Candidate& one_robots = causes[2];
  const auto of_all = one_robots.columns;
  const auto heard_by = [&](double robot) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::VectorXi>(world.readings.rx.data(), world.readings.size()).unaryExpr([=](int rx) {
      return rx == static_cast<int>(robot) ? 1.0 : 0.0;
    });
  };
  one_robots.grid = {Eigen::VectorXd::Constant(1, 100), Eigen::VectorXd::Constant(1, 101)};
  one_robots.columns = [&](const Eigen::VectorXd& t) -> Eigen::MatrixXd {
    return heard_by(t[0]).asDiagonal() * of_all({});
  };
  one_robots.label = [](const Eigen::VectorXd& t) { return t[0] == 100 ? "first" : "second"; };
  ASSERT_GT(heard_by(100).sum(), 500);
  ASSERT_GT(heard_by(101).sum(), 500);
  const Eigen::VectorXd effect = scaled_to(world, of_all({}).col(1), 400);
  const std::vector<Term> terms = cleaned_up(problem_of(world, effect, causes), {{"~bearing", {}}});
  ASSERT_EQ(terms.size(), 2u);
  for (const Term& term : terms) EXPECT_EQ(term.candidate->id, "antenna_rx");
  EXPECT_NE(terms[0].theta, terms[1].theta);
}

}  // namespace
}  // namespace muster::search
