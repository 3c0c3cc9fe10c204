// Ranges: the way before errors, and the laws of each error.
#include <map>

#include "sense_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

const std::string anchors =
    "<station name=\"a\" at=\"3 4 0\"/><station name=\"b\" at=\"-12 0 5\"/><robot name=\"r\" at=\"0 0 0\"/>"
    "<robot name=\"s\" at=\"0 6 0\"/>";
const std::string plain = "<physics.planar through_walls=\"true\"/>";

using Ranges = std::map<std::pair<double, double>, std::vector<double>>;  // by robot and peer

Ranges measured(const std::string& inside, int ticks, const std::map<std::string, std::string>& files = {}) {
  Folder folder;
  Simulation run = world_of(folder, inside, files, "dt=\"0.05\" until=\"100000\" seed=\"5\"");
  Ranges result;
  for (int i = 0; i < ticks; ++i) {
    run.step();
    for (const Range& one : told_now<Range>(run, "range/*/message", time_of(run)))
      result[{one.robot, one.peer}].push_back(one.range);
  }
  return result;
}

double mean(const std::vector<double>& of) {
  double sum = 0;
  for (const double one : of) sum += one;
  return sum / static_cast<double>(of.size());
}

double variance(const std::vector<double>& of) {
  double sum = 0;
  for (const double one : of) sum += (one - mean(of)) * (one - mean(of));
  return sum / static_cast<double>(of.size() - 1);
}

TEST(Range, IsTheWayBetweenAntennas) {
  const auto stations = measured(anchors + plain + "<sensors.range noise=\"0\"/>", 20);
  ASSERT_EQ(stations.size(), 4u) << "two robots, two stations";
  EXPECT_EQ(stations.at({0, 0}).size(), 10u) << "ten times a second";
  EXPECT_NEAR(stations.at({0, 0})[0], 5, 1e-12);
  EXPECT_NEAR(stations.at({0, 1})[0], 13, 1e-12);
  EXPECT_NEAR(stations.at({1, 0})[0], std::hypot(3.0, 2.0), 1e-12);
  const auto robots = measured(anchors + plain + "<sensors.range noise=\"0\" to=\"robots\"/>", 2);
  ASSERT_EQ(robots.size(), 2u);
  EXPECT_EQ(robots.at({0, 3})[0], 6);
  EXPECT_EQ(robots.at({1, 2})[0], 6);
  const auto named = measured(anchors + plain + "<sensors.range noise=\"0\" peers=\"b s\" robot=\"r\"/>", 2);
  ASSERT_EQ(named.size(), 2u);
  EXPECT_TRUE(named.count({0, 1}) && named.count({0, 3}));
}

TEST(Range, IsTheSameWhereTheWorldIsTurnedAndMoved) {
  const double turn = 0.8, x = 30, y = -20;
  const auto at = [&](double px, double py, double pz) {
    std::ostringstream text;
    text.precision(17);
    text << x + std::cos(turn) * px - std::sin(turn) * py << ' ' << y + std::sin(turn) * px + std::cos(turn) * py << ' '
         << pz;
    return text.str();
  };
  const std::string errors = plain + "<sensors.range noise=\"0.1\" share=\"0.01\" pair_bias=\"0.2\" drop=\"0.3\"/>";
  const auto one = measured(anchors + errors, 50);
  const auto other = measured("<station name=\"a\" at=\"" + at(3, 4, 0) + "\"/><station name=\"b\" at=\"" +
                                  at(-12, 0, 5) + "\"/><robot name=\"r\" at=\"" + at(0, 0, 0) +
                                  "\"/><robot name=\"s\" at=\"" + at(0, 6, 0) + "\"/>" + errors,
                              50);
  ASSERT_EQ(one.size(), other.size());
  for (const auto& [pair, ranges] : one) {
    ASSERT_EQ(ranges.size(), other.at(pair).size());
    for (std::size_t i = 0; i < ranges.size(); ++i) EXPECT_NEAR(ranges[i], other.at(pair)[i], 1e-9);
  }
}

TEST(Range, HasNoiseThatGrowsWithTheWay) {
  const auto all = measured(anchors + plain + "<sensors.range rate=\"0\" noise=\"0.05\" share=\"0.02\"/>", 20000);
  for (const auto& [pair, way] : std::map<std::pair<double, double>, double>{{{0, 0}, 5}, {{0, 1}, 13}}) {
    const auto& ranges = all.at(pair);
    const double expected = 0.05 * 0.05 + 0.02 * way * 0.02 * way;
    EXPECT_NEAR(mean(ranges), way, 5 * std::sqrt(expected / 20000));
    EXPECT_NEAR(variance(ranges) / expected, 1, 5 * std::sqrt(2.0 / 20000));
  }
}

TEST(Range, HasTheBiasOfItsPairBothWays) {
  const std::string robots = plain + "<sensors.range noise=\"0\" to=\"all\" pair_bias=\"0.3\"/>";
  const auto all = measured(anchors + robots, 5);
  EXPECT_EQ(all.at({0, 3}), all.at({1, 2})) << "the same both ways";
  EXPECT_EQ(all.at({0, 0}).front(), all.at({0, 0}).back()) << "for good";
  EXPECT_NE(all.at({0, 0}).front() - 5, all.at({0, 1}).front() - 13);
  // Of many pairs it has the standard deviation that is stated.
  std::string many = "<robot name=\"r\" at=\"0 0 0\"/>";
  for (int i = 0; i < 400; ++i) many += "<station name=\"s" + std::to_string(i) + "\" at=\"8 0 0\"/>";
  std::vector<double> biases;
  for (const auto& [pair, ranges] : measured(many + robots, 2)) biases.push_back(ranges[0] - 8);
  ASSERT_EQ(biases.size(), 400u);
  EXPECT_NEAR(variance(biases) / 0.09, 1, 5 * std::sqrt(2.0 / 400));
  const auto stated = measured(anchors + plain + "<sensors.range noise=\"0\" bias=\"0.1\" biases=\"b.csv\"/>", 2,
                               {{"b.csv", "a,b,bias[m]\nr,a,0.5\nb,s,-0.25\n"}});
  EXPECT_NEAR(stated.at({0, 0})[0], 5.6, 1e-12);
  EXPECT_NEAR(stated.at({0, 1})[0], 13.1, 1e-12);
  EXPECT_NEAR(stated.at({1, 1})[0], std::hypot(12.0, 6.0, 5.0) + 0.1 - 0.25, 1e-12);
}

// A wall of 6 dB: 0.02 m a dB late, and half of the reach.
TEST(Range, ThroughWallsIsLateAndShort) {
  const std::string wall =
      "<material name=\"brick\" loss=\"6\"/><wall name=\"w\" from=\"1.5 -50\" to=\"1.5 50\" material=\"brick\"/>";
  const auto seen = [&](const std::string& attributes) {
    return measured(wall + anchors + plain + "<sensors.range robot=\"r\" noise=\"0\" " + attributes + "/>", 2);
  };
  EXPECT_NEAR(seen("wall_bias=\"0.02\"").at({0, 0})[0], 5 + 0.12, 1e-12);
  EXPECT_NEAR(seen("wall_bias=\"0.02\"").at({0, 1})[0], 13, 1e-12) << "on this side";
  const double reach = 5 * std::pow(10, 6.0 / 20);
  EXPECT_TRUE(seen("max_range=\"" + std::to_string(reach + 1e-3) + "\"").count({0, 0}));
  EXPECT_FALSE(seen("max_range=\"" + std::to_string(reach - 1e-3) + "\"").count({0, 0}));
  EXPECT_TRUE(seen("max_range=\"5.001\" wall_loss=\"0\"").count({0, 0}));
  EXPECT_FALSE(seen("max_range=\"12.9\"").count({0, 1}));
}

TEST(Range, DropsTheShareThatIsStated) {
  const std::string wall =
      "<material name=\"brick\" loss=\"6\"/><wall name=\"w\" from=\"1.5 -50\" to=\"1.5 50\" material=\"brick\"/>";
  const auto all = measured(
      wall + anchors + plain + "<sensors.range robot=\"r\" rate=\"0\" drop=\"0.2\" wall_drop=\"0.5\"/>", 10000);
  EXPECT_NEAR(static_cast<double>(all.at({0, 1}).size()) / 10000, 0.8, 5 * std::sqrt(0.16 / 10000));
  EXPECT_NEAR(static_cast<double>(all.at({0, 0}).size()) / 10000, 0.4, 5 * std::sqrt(0.24 / 10000));
}

TEST(Range, RefusesAPeerThatIsNoRadio) {
  EXPECT_NE(refusal([] {
              measured(anchors + plain + "<sensors.range peers=\"a c\"/>", 1);
            }).find("attribute \"peers\": no radio is called \"c\"; expected some of a, b, r, s"),
            std::string::npos);
}

TEST(Range, RefusesASecondBiasOfAPair) {
  const auto biased = [](const std::string& rows) {
    return refusal([&] {
      measured(anchors + plain + "<sensors.range biases=\"b.csv\"/>", 1, {{"b.csv", "a,b,bias[m]\n" + rows}});
    });
  };
  const std::string one = "; expected one row a pair: its bias counts both ways";
  EXPECT_NE(biased("a,r,0.2\nb,r,0.1\nr,a,-0.1\n")
                .find("b.csv:4:1: the pair of r and a has a bias in line 2 already, in the other order" + one),
            std::string::npos);
  EXPECT_NE(biased("a,r,0.2\na,r,0.2\n").find("b.csv:3:1: the pair of a and r has a bias in line 2 already" + one),
            std::string::npos);
  EXPECT_EQ(biased("a,r,0.2\na,s,0.2\n"), "nothing refused it");
}

TEST(Range, IsTheSameRun) {
  Folder folder;
  expect_one_run(
      [&] {
        return world_in(folder, anchors + plain +
                                    "<robots.drive/><control.wander/><sensors.range name=\"u\" to=\"all\" rate=\"7\" "
                                    "pair_bias=\"0.1\" share=\"0.01\" drop=\"0.2\"/>");
      },
      "u");
}

}  // namespace
