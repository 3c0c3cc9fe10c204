// Places: whether a climb gets to the top, how sure a place is said to be, and what skewed noise does to it.
#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/search/refine.hpp"
#include "diagnosis/search/scores.hpp"
#include "diagnosis/search/spread.hpp"
#include "diagnosis/search/tail.hpp"
#include "muster/random.hpp"
#include "tests/search/causes.hpp"
#include "tests/search/planted.hpp"

namespace muster::search {
namespace {

using synthetic::causes_of;
using synthetic::problem_of;
using synthetic::scaled_to;
using synthetic::varied;
using synthetic::World;
using synthetic::world_of;

// A wall off the grid, where no robot drove.
Eigen::VectorXd hidden_wall(const World& world, const Candidate& wall) {
  const Stream stream(combined(key_of("hidden wall"), world.recipe.seed));
  for (uint64_t k = 0;; ++k) {
    Eigen::VectorXd theta =
        wall.grid[static_cast<std::size_t>(stream.uniform(k, 0) * static_cast<double>(wall.grid.size()))];
    for (Index j = 0; j < 4; ++j) theta[j] += wall.step[j] * (2 * stream.uniform(k, 1 + static_cast<uint64_t>(j)) - 1);
    if (wall.admitted(theta) == 1 && (wall.columns(theta).array() != 0).cast<double>().mean() > 0.03) return theta;
  }
}

Lead best_of_grid(Bench& bench, const Stand& stand, const std::string& id) {
  bench.renew_depending(stand.coefficients(bench.base_columns()));
  for (const Lead& lead : leads(bench, stand)) {
    if (lead.candidate().id == id) return lead;
  }
  throw std::logic_error(id);
}

TEST(Race, ReachesWhatTheTruthGains) {
  int reached = 0, from_grid = 0;
  for (uint64_t seed = 810; seed < 818; ++seed) {
    const World world = world_of(varied(seed, 2000));
    const auto causes = causes_of(world);
    const Candidate& wall = causes[causes.size() - 2];
    ASSERT_EQ(wall.id, "unmapped_wall");
    const Eigen::VectorXd truth = hidden_wall(world, wall);
    const Problem problem = problem_of(world, -scaled_to(world, wall.columns(truth), 150), causes);
    Bench bench(problem, {});
    const Stand stand = bench.stand(bench.design());
    const Lead lead = best_of_grid(bench, stand, "unmapped_wall");
    const double wanted = stand.gain(bench.columns_of(wall, truth)) - 6;
    from_grid += lead.gain >= wanted;
    reached += refined(bench, stand, lead, false).gain >= wanted;
  }
  EXPECT_LE(from_grid, 4);
  EXPECT_GE(reached, 7);
}

TEST(Spread, HoldsPlacesAndLossesAsOftenAsItSays) {
  int held = 0, asked = 0;
  for (uint64_t seed = 830; seed < 842; ++seed) {
    const World world = world_of(varied(seed, 1500));
    const auto causes = causes_of(world);
    const Candidate& wall = causes[causes.size() - 2];
    const Eigen::VectorXd truth = hidden_wall(world, wall), column = wall.columns(truth);
    const Eigen::VectorXd effect = -scaled_to(world, column, 300);
    const Problem problem = problem_of(world, effect, causes);
    Bench bench(problem, {});
    const Stand stand = bench.stand(bench.design());
    const Lead found = refined(bench, stand, best_of_grid(bench, stand, "unmapped_wall"), false);
    bench.terms.push_back({found.entry->candidate, found.theta, found.columns});
    bench.refit();
    const Spread spread = spread_of(bench, bench.terms[0]);
    const Eigen::MatrixXd design = bench.design();
    const double loss = bench.stand(design).coefficients(design.cols()).tail(1)[0];
    const double sd = std::sqrt(spread.coefficients(0, 0));
    held += std::abs(loss - effect.sum() / column.sum()) < 1.96 * sd;
    ++asked;
    for (Index k = 0; k < 2; ++k) {  // the middle: ends may change places
      double mean = 0, square = 0;
      for (const auto& t : spread.thetas) mean += t[k] / static_cast<double>(spread.thetas.size());
      for (const auto& t : spread.thetas) square += std::pow(t[k] - mean, 2) / static_cast<double>(spread.thetas.size());
      held += std::abs(truth[k] - mean) < 1.96 * std::sqrt(square);
      ++asked;
    }
  }
  std::printf("%d of %d intervals hold the truth\n", held, asked);
  EXPECT_GE(held, synthetic::least_successes(asked, 0.88));
}

TEST(SkewCharge, IsHowMuchLikelierDeepFadesMakeALoss) {
  // Sums of 80 Rayleigh fades in dB, upside down, against the normal tail.
  const Stream stream(key_of("fades"));
  constexpr int sums = 40000, terms = 80;
  double cubes = 0;
  std::vector<double> z(sums, 0);
  const double sd = 10 / std::log(10.0) * M_PI / std::sqrt(6.0), mean = -10 / std::log(10.0) * 0.5772156649;
  for (uint64_t k = 0; k < sums; ++k) {
    for (uint64_t j = 0; j < terms; ++j) {
      const double x = -(10 * std::log10(-std::log(stream.uniform(k, j) + 1e-300)) - mean) / sd;
      cubes += x * x * x / (sums * terms);
      z[k] += x / std::sqrt(static_cast<double>(terms));
    }
  }
  double beyond = 0;
  for (const double x : z) beyond += x > 3.0 ? 1.0 / sums : 0.0;
  const double normal = 0.5 * std::erfc(3 / std::sqrt(2.0));
  EXPECT_NEAR(skew_charge(3, cubes / std::sqrt(static_cast<double>(terms))), std::log(beyond / normal), 0.25);
  EXPECT_EQ(skew_charge(6, -0.3), 0);
  EXPECT_NEAR(skew_charge(6, 0), 0, 1e-9);
}

}  // namespace
}  // namespace muster::search
