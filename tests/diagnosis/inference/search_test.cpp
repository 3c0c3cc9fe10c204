// The whole search on worlds with known truth. Counts are small; planted_test.cpp has the large ones.
#include "diagnosis/inference/assess/search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "muster/random.hpp"
#include "tests/diagnosis/inference/causes.hpp"

namespace muster::inference {
namespace {

using synthetic::causes_of;
using synthetic::columns_of;
using synthetic::problem_of;
using synthetic::Recipe;
using synthetic::scaled_to;
using synthetic::varied;
using synthetic::World;
using synthetic::world_of;

Result result_of(const World& world, const Eigen::VectorXd& effect) {
  const Problem problem = problem_of(world, effect, causes_of(world));
  return Search(problem).run();
}

std::vector<std::string> ids(const Result& result) {
  std::vector<std::string> out;
  for (const Finding& f : result.findings) {
    if (f.status != Status::suspected) out.push_back(f.id);
  }
  return out;
}

TEST(Search, AnEffectOfSpeedWithoutACauseIsUnexplained) {
  const World world = world_of(varied(31, 4000));
  const Eigen::VectorXd effect = scaled_to(world, (world.speed.array() > 0.45).cast<double>().sqrt(), 120);
  const Result result = result_of(world, effect);
  ASSERT_FALSE(result.findings.empty());
  EXPECT_EQ(result.findings[0].id, "~speed");
  EXPECT_EQ(result.findings[0].status, Status::unexplained);
  for (const Finding& f : result.findings) EXPECT_NE(f.status, Status::named) << f.id;
}

TEST(Search, EveryCauseAndEveryCovariateIsCheckedOnce) {
  const World world = world_of(varied(34, 2000));
  const Problem problem = problem_of(world, Eigen::VectorXd::Zero(world.readings.size()), causes_of(world));
  const Result result = Search(problem).run();
  std::set<std::string> checked;
  for (const Check& check : result.checks) {
    EXPECT_TRUE(checked.insert(check.id).second) << check.id;
    EXPECT_GE(check.gain, 0) << check.id;
  }
  for (const Candidate& c : problem.candidates) EXPECT_EQ(checked.count(c.id), 1u) << c.id;
  for (const Covariate& c : columns_of(world).covariates) EXPECT_EQ(checked.count('~' + c.name), 1u) << c.name;
  // Of many tests one has a small p by chance: p-values are corrected for their number.
  const auto low = std::count_if(result.checks.begin(), result.checks.end(),
                                 [](const Check& check) { return check.log_p < std::log(0.02); });
  EXPECT_LE(low, static_cast<std::ptrdiff_t>(result.checks.size() / 10));
}

TEST(Search, AntennaLobesWithoutACauseAreReportedAlongTheBearing) {
  const World world = world_of(varied(32, 4000));
  const Eigen::VectorXd effect = scaled_to(world, (3 * world.bearing().array() + 1).cos(), 150);
  EXPECT_EQ(ids(result_of(world, effect)), std::vector<std::string>{"~bearing"});
}

TEST(Search, AProductOfAColumnAndDistanceIsFound) {
  const World world = world_of(varied(33, 4000));
  const Eigen::ArrayXd distance = world.distance().array().log10();
  const Eigen::VectorXd effect = scaled_to(world, (world.temperature.array() - 20) * (distance - distance.mean()), 200);
  const auto found = ids(result_of(world, effect));
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0], "~temperature*logd");
}

TEST(Search, TwoCausesAreBothNamed) {
  const World world = world_of(varied(34, 5000));
  const auto causes = causes_of(world);
  const Eigen::VectorXd effect = scaled_to(world, causes[1].design.columns(causes[1].design.grid[0]), 200) -
                                 scaled_to(world, causes[9].design.columns(causes[9].design.grid[150]), 120);
  auto found = ids(result_of(world, effect));
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (std::vector<std::string>{"rx_offset", "unmapped_wall"}));
}

// A second wall of a thirtieth of the first one's evidence is merged away: one object explains nearly all. It is not
// found and merged again without end.
TEST(Search, AWallThatIsMergedAwayIsNotFoundAgainAndAgain) {
  const World world = world_of(varied(12, 4000));
  const auto causes = causes_of(world);
  const Candidate& wall = causes[causes.size() - 2];
  ASSERT_EQ(wall.id, "unmapped_wall");
  const Eigen::VectorXd effect = -scaled_to(world, wall.design.columns(Eigen::Vector4d(6, 5, 4, 0)), 3000) -
                                 scaled_to(world, wall.design.columns(Eigen::Vector4d(9, 6, 3, 0.6)), 100);
  const auto result = result_of(world, effect);
  const auto entered =
      std::count_if(result.trials.begin(), result.trials.end(), [](const Trial& t) { return t.accepted; });
  EXPECT_GE(entered, 2);
  EXPECT_LE(entered, 4);
  EXPECT_EQ(ids(result), std::vector<std::string>{"unmapped_wall"});
}

// A steeper slope beyond some distance concerns every radio and every run, an offset one radio alone.
TEST(Search, EffectsOnAllRadiosAndRunsGainOnHeldOutOnes) {
  const World world = world_of(varied(34, 5000));
  const auto causes = causes_of(world);
  const Candidate& slope =
      *std::find_if(causes.begin(), causes.end(), [](const Candidate& c) { return c.id == "dual_slope"; });
  const Eigen::VectorXd effect =
      scaled_to(world, causes[0].design.columns(causes[0].design.grid[0]), 200) -
      scaled_to(world, slope.design.columns(slope.design.grid[slope.design.grid.size() / 2]), 300);
  const double half = world.time.maxCoeff() / 2;
  std::vector<int> run;
  for (const double t : world.time) run.push_back(t > half);
  const Problem problem = problem_of(world, effect, causes, {}, run);
  const Result result = Search(problem).run();
  std::vector<std::string> left_out;
  for (const Elsewhere& e : result.elsewhere) left_out.push_back(e.left_out);
  ASSERT_EQ(left_out, (std::vector<std::string>{"radios", "runs"}));
  EXPECT_EQ(result.elsewhere[0].held_out.blocks, world.recipe.transmitters);
  EXPECT_EQ(result.elsewhere[1].held_out.blocks, 2);
  std::set<std::string> seen;
  for (const Finding& f : result.findings) {
    seen.insert(f.id);
    for (const Elsewhere& e : f.elsewhere) {
      EXPECT_GT(e.held_out.gain, 0) << f.id << " without some " << e.left_out;
      EXPECT_FALSE(f.id == "tx_offset" && e.left_out == "radios");
    }
    EXPECT_EQ(f.elsewhere.size(), f.id == "dual_slope" ? 2u : 1u) << f.id;
  }
  EXPECT_EQ(seen, (std::set<std::string>{"dual_slope", "tx_offset"}));
}

TEST(Search, SimplestOfInseparableCausesIsNamed) {
  const World world = world_of(varied(34, 4000));
  auto causes = causes_of(world);
  const Eigen::VectorXd effect = scaled_to(world, causes[1].design.columns(causes[1].design.grid[0]), 200);
  for (const int more : {-1, 1}) {
    auto twins = causes;
    twins.insert(twins.begin() + (more > 0 ? 1 : 2), causes[1]);  // before and after: the order must not matter
    Candidate& twin = twins[more > 0 ? 1 : 2];
    twin.id = "twin";
    twin.role.parameters = causes[1].role.parameters + more;
    const Problem problem = problem_of(world, effect, twins);
    EXPECT_EQ(ids(Search(problem).run()), std::vector<std::string>{more > 0 ? "rx_offset" : "twin"});
  }
}

TEST(Search, AChirpIsNotNamedPeriodic) {
  int unexplained = 0;
  for (uint64_t seed = 240; seed < 246; ++seed) {
    const World world = world_of(varied(seed, 4000));
    const Eigen::ArrayXd part = world.time.array() / world.time.maxCoeff();
    const auto said = ids(result_of(world, scaled_to(world, (6 * M_PI * (part + part * part)).sin(), 70)));
    for (const std::string& id : said) EXPECT_EQ(id[0], '~') << seed << ": " << id;
    unexplained += std::count(said.begin(), said.end(), "~time") > 0;
  }
  EXPECT_EQ(unexplained, 6);
}

// The battery falls with time, so its knee resembles a drift.
TEST(Search, AKneeOfTheBatteryIsNotNamedDrift) {
  int right = 0;
  for (uint64_t seed = 250; seed < 256; ++seed) {
    const World world = world_of(varied(seed, 3000));
    const Eigen::VectorXd effect = scaled_to(world, -(11.7 - world.battery.array()).max(0.0).pow(1.4), 70);
    const auto said = ids(result_of(world, effect));
    for (const char* of_time : {"drift", "step", "periodic"})
      EXPECT_EQ(std::count(said.begin(), said.end(), of_time), 0) << seed << ": " << of_time;
    right += std::count(said.begin(), said.end(), "~battery") > 0;
  }
  EXPECT_GE(right, 5);
}

// A slope over the plan (moisture at one end), which the field can absorb.
TEST(Search, ASlopeOverThePlanIsReportedAlongThePosition) {
  int right = 0;
  for (uint64_t seed = 260; seed < 266; ++seed) {
    const World world = world_of(varied(seed, 3000));
    const Eigen::ArrayXd u = world.readings.rx_at.row(0).transpose().array() / 12 - 1;
    const auto said = ids(result_of(world, scaled_to(world, -(u + 0.7 * u * u), 70)));
    for (const std::string& id : said) EXPECT_EQ(id[0], '~') << seed << ": " << id;
    right += std::count(said.begin(), said.end(), "~position") > 0;
  }
  EXPECT_GE(right, 5);
}

TEST(Search, NoFalseWallForAnOutlier) {
  for (uint64_t seed = 220; seed < 228; ++seed) {
    Recipe recipe = varied(seed, 2500);
    recipe.fading = 0.8;
    const World world = world_of(recipe);
    Eigen::VectorXd far = Eigen::VectorXd::Zero(2500);
    far[700] = -60;
    EXPECT_EQ(ids(result_of(world, far)), std::vector<std::string>{}) << seed;
  }
}

// Named causes with a transmitter's offset of that lambda. The world states its field's size and this multiple of its
// distance; 0: it states nothing.
std::vector<std::string> named_beside_stated_field(uint64_t seed, double lambda, double multiple) {
  const World world = world_of(varied(seed, 2500));
  const auto causes = causes_of(world);
  const Eigen::VectorXd offset = scaled_to(world, causes[0].design.columns(causes[0].design.grid[1]).col(0), 1);
  Problem problem = problem_of(world, std::sqrt(lambda) * offset, causes);
  if (multiple > 0) problem.stated = {world.recipe.sigma, multiple * world.recipe.decorrelation};
  return ids(Search(problem).run());
}

TEST(Search, AStatedFieldRevealsAnOffsetThatAFittedOneAbsorbs) {
  int free = 0, stated = 0;
  for (uint64_t seed = 200; seed < 208; ++seed) {
    const std::vector<std::string> offset{"tx_offset"};
    free += named_beside_stated_field(seed, 60, 0) == offset;
    stated += named_beside_stated_field(seed, 60, 1) == offset;
    for (const double multiple : {0.5, 1.0, 1.5})
      EXPECT_EQ(named_beside_stated_field(seed, 0, multiple), std::vector<std::string>{}) << seed << ' ' << multiple;
  }
  EXPECT_GT(stated, free);
}

TEST(Search, CoefficientsAndHeldOutGainMatchTheTruth) {
  const World world = world_of(varied(35, 6000));
  const auto causes = causes_of(world);
  const Eigen::VectorXd column = causes[1].design.columns(causes[1].design.grid[0]);
  const Result result = result_of(world, 5 * column);
  ASSERT_EQ(ids(result), std::vector<std::string>{"rx_offset"});
  const Finding& f = result.findings[0];
  EXPECT_LT(std::abs(f.coefficients[0] - 5), 4 * std::sqrt(f.uncertainty(0, 0)));
  ASSERT_TRUE(f.held_out.has_value());
  EXPECT_GT(f.held_out->lower95, 0);
  const double share = column.mean();
  EXPECT_NEAR(f.held_out->gain, 25 * share * (1 - share), 2.5);
  EXPECT_NEAR(result.held_out->rmse_before, f.held_out->rmse_before, 1e-9);
}

TEST(Search, IsIndependentOfTheOrderOfReadings) {
  const World world = world_of(varied(36, 2500));
  const auto causes = causes_of(world);
  const Eigen::VectorXd effect = -scaled_to(world, causes[9].design.columns(causes[9].design.grid[40]), 100);
  World mixed = world;
  std::vector<Index> order(2500);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [](Index a, Index b) {
    return Stream(8).uniform(static_cast<uint64_t>(a)) < Stream(8).uniform(static_cast<uint64_t>(b));
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto from = static_cast<std::size_t>(order[i]);
    mixed.readings.t[i] = world.readings.t[from];
    mixed.readings.tx[i] = world.readings.tx[from];
    mixed.readings.rx[i] = world.readings.rx[from];
    mixed.readings.rx_yaw[i] = world.readings.rx_yaw[from];
  }
  for (Eigen::VectorXd World::*column :
       {&World::rssi, &World::time, &World::speed, &World::battery, &World::temperature})
    mixed.*column = (world.*column)(order).eval();
  mixed.base = world.base(order, Eigen::all).eval();
  mixed.readings.rx_at = world.readings.rx_at(Eigen::all, order).eval();
  mixed.readings.tx_at = world.readings.tx_at(Eigen::all, order).eval();
  // Grids must not depend on the order either: the first world's grids are used with the second one's columns.
  auto again = causes_of(mixed);
  for (std::size_t k = 0; k < again.size(); ++k) {
    again[k].design.grid = causes[k].design.grid;
    again[k].refinement.admitted = causes[k].refinement.admitted;
  }
  const Problem a = problem_of(world, effect, causes), b = problem_of(mixed, effect(order), again);
  const Result first = Search(a).run(), second = Search(b).run();
  ASSERT_FALSE(first.findings.empty());
  ASSERT_EQ(first.findings.size(), second.findings.size());
  for (std::size_t k = 0; k < first.findings.size(); ++k) {
    EXPECT_EQ(first.findings[k].id, second.findings[k].id);
    EXPECT_NEAR(first.findings[k].gain, second.findings[k].gain, 1e-6 * first.findings[k].gain);
    EXPECT_NEAR((first.findings[k].theta - second.findings[k].theta).norm(), 0, 1e-6);
  }
  EXPECT_NEAR((first.noise.covariance.theta - second.noise.covariance.theta).norm(), 0, 1e-6);
}

TEST(Search, NoFalseExponentOrDualSlopeForAFloor) {
  for (uint64_t seed = 41; seed < 44; ++seed) {
    const World world = world_of(varied(seed, 4000));
    Problem problem = problem_of(world, Eigen::VectorXd::Zero(4000), causes_of(world));
    std::vector<double> levels(problem.measured.begin(), problem.measured.end());
    std::nth_element(levels.begin(), levels.begin() + 800, levels.end());
    const double floor = levels[800];
    problem.bounds.known.assign(4000, noise::Known::value);
    for (Index i = 0; i < 4000; ++i) {
      if (problem.measured[i] > floor) continue;
      problem.measured[i] = floor;
      problem.bounds.known[static_cast<std::size_t>(i)] = noise::Known::below;
    }
    const Result result = Search(problem).run();
    EXPECT_TRUE(ids(result).empty()) << seed << ' ' << ids(result)[0];
    EXPECT_NEAR(result.base_coefficients[1], 2.0, 0.5) << seed;
  }
}

// An antenna that loses a little from behind, in readings of which six of ten lie below a floor: what it takes from
// those is drawn as if it took nothing.
TEST(Search, ALossThatHidesBelowAFloorIsFound) {
  const auto found_of = [](uint64_t seed, double strength) {
    const World world = world_of(varied(seed, 3000));
    Problem problem = problem_of(world, -strength * (1 - world.bearing().array().cos()), causes_of(world));
    Eigen::VectorXd sorted = problem.measured;
    std::sort(sorted.begin(), sorted.end());
    const double floor = std::round(sorted[sorted.size() * 6 / 10]);
    for (double& reading : problem.measured) {
      problem.bounds.known.push_back(reading <= floor ? noise::Known::below : noise::Known::value);
      reading = std::max(reading, floor);
    }
    problem.bounds.half_code = 0.5;
    return ids(Search(problem).run());
  };
  for (const auto& [seed, strength] : {std::pair{61, 0.9}, std::pair{66, 0.9}, std::pair{63, 1.2}})
    EXPECT_EQ(found_of(static_cast<uint64_t>(seed), strength), std::vector<std::string>{"antenna_rx"}) << seed;
  for (const uint64_t seed : {67, 68}) EXPECT_EQ(found_of(seed, 0), std::vector<std::string>{}) << seed;
}

TEST(Search, AdvisedReadingsRaiseSeparabilityAsPredicted) {
  const World world = world_of(varied(37, 6000));
  const auto causes = causes_of(world);
  const Eigen::VectorXd effect = scaled_to(world, causes[0].design.columns(causes[0].design.grid[1]), 250);
  const auto part_of = [&](Index from, Index count) {
    World part = world;
    const auto rows = Eigen::seqN(from, count);
    const auto cut = [&](auto& values) {
      values = std::remove_reference_t<decltype(values)>(values.begin() + from, values.begin() + from + count);
    };
    cut(part.readings.t);
    cut(part.readings.tx);
    cut(part.readings.rx);
    cut(part.readings.rx_yaw);
    part.readings.tx_at = world.readings.tx_at(Eigen::all, rows).eval();
    part.readings.rx_at = world.readings.rx_at(Eigen::all, rows).eval();
    for (Eigen::VectorXd World::*column :
         {&World::rssi, &World::time, &World::speed, &World::battery, &World::temperature})
      part.*column = (world.*column)(rows).eval();
    part.base = world.base(rows, Eigen::all).eval();
    return part;
  };
  const World start = part_of(0, 2500), next = part_of(2500, 3500);
  const Problem problem = problem_of(start, effect.head(2500), causes_of(start));
  Search search(problem);
  const Result result = search.run();
  ASSERT_EQ(ids(result), std::vector<std::string>{"tx_offset"});
  const Problem whole_problem = problem_of(world, effect, causes_of(world));
  const Search whole(whole_problem);
  const auto& term = search.state().terms[0];
  const Plan plan{"drive on", std::make_shared<diagnosis::LinkLayout>(next.readings, diagnosis::LinkRowLimits()),
                  next.base, causes_of(next)};
  const double predicted = ExpectedSeparability(search.state(), plan).separability(term, {"antenna_tx"})[0];
  // D with the present readings, and with those of the plan added, for the same effect and noise.
  const auto separability = [&](const ModelState& state, const World& of) {
    const WhitenedModel rest = state.whitened_model(state.base(), search.state().fit.covariance);
    const Eigen::VectorXd planted = causes_of(of)[0].design.columns(term.theta) * result.findings[0].coefficients;
    const Eigen::VectorXd e = rest.at.basis.rest(rest.whitener(state.rows().mean(planted)));
    double least = e.squaredNorm();
    for (const Entry& entry : state.entries()) {
      if (entry.candidate->id == "antenna_tx") least -= gains(*entry.candidate, unit_atoms(entry, rest), e).maxCoeff();
    }
    return least;
  };
  EXPECT_GT(predicted, 1.3 * separability(search.state(), start));
  EXPECT_NEAR(predicted / separability(whole.state(), world), 1, 0.25);
}

TEST(Search, RejectsColumnsOfAnotherLength) {
  const World world = world_of(varied(38, 200));
  Problem problem = problem_of(world, Eigen::VectorXd::Zero(200), {});
  problem.base.conservativeResize(199, Eigen::NoChange);
  EXPECT_THROW(Search{problem}, std::invalid_argument);
}

}  // namespace
}  // namespace muster::inference
