// The generator `run`: readings of the simulator itself, weighed by a covariance in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "exam/case.hpp"
#include "exam/simulated/simulated_case.hpp"
#include "exam/write.hpp"

namespace muster::exam::simulated {
namespace {

Request of(const std::string& kind, std::vector<std::string> effects = {}) {
  Request request;
  request.seed = 17;
  request.program = MUSTER_PROGRAM;
  request.kinds = {kind};
  request.effects = std::move(effects);
  request.least_rows = 400;
  request.most_rows = 700;
  return request;
}

std::string everything(const Made& made) {
  return world_xml(made) + table(made, made.measured) + table(made, made.second) + answer_json(made);
}

TEST(SimulatedCase, DependsOnSeedAndNumberAlone) {
  const Request request = of("one");
  const std::string second = everything(make(request, 2));
  make(request, 1);
  EXPECT_EQ(everything(make(request, 2)), second);
  Request other = request;
  other.seed = 18;
  EXPECT_NE(everything(make(other, 2)), second);
}

TEST(SimulatedCase, EveryCausePluginCanBePlanted) {
  std::set<std::string> plugins, kinds;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(MUSTER_SOURCE_DIR) / "plugins/causes"))
    if (entry.path().extension() == ".cpp") plugins.insert(entry.path().stem().string());
  for (const CauseKind& kind : cause_kinds()) kinds.insert(kind.id);
  EXPECT_EQ(kinds, plugins);
  std::set<std::string> planted;
  Request request = of("each");
  for (int number = 1; number <= static_cast<int>(kinds.size()); ++number) {
    const Made made = make(request, number);
    ASSERT_EQ(made.causes.size(), 1u) << number;
    planted.insert(made.causes[0].id);
    EXPECT_TRUE(std::isfinite(made.causes[0].lambda)) << made.causes[0].id;
    EXPECT_GE(made.causes[0].lambda, 0) << made.causes[0].id;
    EXPECT_EQ(world_xml(made).find("effect."), std::string::npos);
  }
  EXPECT_GE(planted.size(), kinds.size() - 2);  // a plan may have no place for one of them
}

// The world in which walls are counted has no plan: a second cause could ask for a wall that is not there.
TEST(SimulatedCase, CountedWallsStandAlone) {
  for (int number = 1; number <= 4; ++number) {
    const Made made = make(of("two", {"counted_walls", "wall_material", "wall_absent"}), number);
    EXPECT_FALSE(made.counts_walls);
    for (const PlantedCause& cause : made.causes) EXPECT_NE(cause.id, "counted_walls");
  }
}

TEST(SimulatedCase, TheWorldIsTheTruthWithoutTheCause) {
  const Made made = make(of("one", {"tx_offset"}), 1);
  const Simulator simulator(MUSTER_PROGRAM, table(made, made.measured), walls_csv(made.site.plan));
  const Eigen::VectorXd without = simulator.expected(world_elements(made)),
                        with = simulator.expected(world_elements(made) + made.causes[0].element());
  const std::string sender = made.causes[0].rows[0].substr(6);
  for (std::size_t i = 0; i < made.measured.size(); ++i) {
    const Reading& r = made.measured.readings[i];
    const std::string tx =
        r.up ? robot_name(r.robot) : made.site.plan.stations[static_cast<std::size_t>(r.station)].name;
    ASSERT_NEAR(with[static_cast<Eigen::Index>(i)] - without[static_cast<Eigen::Index>(i)],
                tx == sender ? made.causes[0].number("offset") : 0, 1e-9);
  }
}

// Law of a made world, as the generator takes it.
LinkLaw law_of(const Made& made) {
  const Channel& c = made.channel;
  return {c.shadowing, c.decorrelation,
          c.fading == Channel::Fading::none ? 0 : std::sqrt(rician_moments(c.rician_k).variance), c.step()};
}

TEST(LinkCovariance, IsThatOfTheSimulatorsDraws) {
  Made made = make(of("clean"), 1);
  made.channel = {Channel::Fading::none, 4, 2, 6, 1};
  const Simulator simulator(MUSTER_PROGRAM, table(made, made.measured), walls_csv(made.site.plan));
  const Eigen::VectorXd mean = simulator.expected(world_elements(made));
  constexpr int seeds = 250;
  const std::vector<std::pair<int, int>> pairs{{0, 0}, {0, 1}, {0, 40}, {7, 120}, {60, 61}, {30, 300}, {200, 201}};
  std::vector<double> sampled(pairs.size(), 0);
  for (int seed = 1; seed <= seeds; ++seed) {
    const Eigen::VectorXd e = simulator.drawn(world_elements(made), static_cast<std::uint64_t>(seed)) - mean;
    for (std::size_t k = 0; k < pairs.size(); ++k) sampled[k] += e[pairs[k].first] * e[pairs[k].second] / seeds;
  }
  const auto link = [&](int i) {
    const Reading& r = made.measured.readings[static_cast<std::size_t>(i)];
    return Link{place_of(made.site, r), r.at};
  };
  for (std::size_t k = 0; k < pairs.size(); ++k)
    EXPECT_NEAR(shadowing_covariance(link(pairs[k].first), link(pairs[k].second), 4, 2), sampled[k],
                5 * 16 / std::sqrt(static_cast<double>(seeds)))
        << pairs[k].first << ' ' << pairs[k].second;
  // The closed form of the variance.
  const Link l = link(0);
  const double d = distance_of(l.a, l.b), u = d / 2;
  EXPECT_NEAR(shadowing_covariance(l, l, 4, 2), 16 * (1 - (1 - std::exp(-u)) / u), 0.03 * 16);
}

TEST(LinkCovariance, WhitensWhatTheSimulatorDraws) {
  // By law of fading: the mean square of whitened errors, over seeds.
  for (const auto fading : {Channel::Fading::none, Channel::Fading::multipath, Channel::Fading::per_reading}) {
    // Both directions of a pair share their error, which the covariance takes for two.
    int number = 1;
    Made made = make(of("clean"), number);
    while (made.site.two_way) made = make(of("clean"), ++number);
    made.channel = {fading, 4, 2, 3, 1};
    const Simulator simulator(MUSTER_PROGRAM, table(made, made.measured), walls_csv(made.site.plan));
    const Eigen::VectorXd mean = simulator.expected(world_elements(made));
    const std::vector<char> all(made.measured.size(), 1);
    const LinkCovariance covariance(made.site, made.measured, law_of(made), all);
    double energy = 0;
    constexpr int seeds = 12;
    for (int seed = 1; seed <= seeds; ++seed) {
      Eigen::VectorXd e = simulator.drawn(world_elements(made), static_cast<std::uint64_t>(seed));
      e = e.unaryExpr([](double v) { return std::round(v * 10) / 10; }) - mean;
      energy += covariance.whitened(e).squaredNorm() / static_cast<double>(made.measured.size()) / seeds;
    }
    // Without fading neighbours within a cell have less independent error than the covariance takes them to have: its
    // lambda is a lower bound there.
    EXPECT_LT(energy, 1.1);
    EXPECT_GT(energy, fading == Channel::Fading::none ? 0.3 : 0.9);
  }
}

TEST(CauseLambda, RayleighFadingHasItsMoments) {
  const Moments rayleigh = rician_moments(-40);
  EXPECT_NEAR(rayleigh.mean, -2.507, 0.01);
  EXPECT_NEAR(std::sqrt(rayleigh.variance), 5.570, 0.03);
  PlantedCause same{"fading_law"};
  same.numbers = {{"rician_k", 6, "dB"}};
  EXPECT_NEAR(reading_divergence(same, 6, true, 0.1), 0, 1e-9);
  EXPECT_GT(reading_divergence(same, -40, true, 0.1), 0.05);
}

}  // namespace
}  // namespace muster::exam::simulated
