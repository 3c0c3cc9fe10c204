// Errors of lasers beside white noise: against plane geometry, in worlds.
#include "scans.hpp"
#include "sense_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double forward = 0.05;  // of the Scarab's laser in its frame

// At the origin, with exact ranges up to 4 m.
std::string rover(const Folder& folder) {
  return "<robot name=\"r\" at=\"0 0 0\" model=\"" + scarab_with(folder, {{" resolution=\"0.001\"/>", "/>"}}).string() +
         "\"/>";
}
const std::string wall =
    "<material name=\"brick\" loss=\"6\"/><wall name=\"w\" from=\"3 -50\" to=\"3 50\" material=\"brick\"/>";
const std::string still = "<physics.planar through_walls=\"true\"/>";

TEST(LaserErrors, AddTheBiasOfTheirTable) {
  Folder folder;
  Simulation run = world_of(folder, still + wall + rover(folder) + "<sensors.laser biases=\"b.csv\"/>",
                            {{"b.csv", "range[m],bias[m]\n3,0.1\n3.5,0.2\n3.6,-0.1\n"}});
  const Seen seen = scans(run).at(0);
  int between = 0;
  for (std::size_t i = 200; i < 480; ++i) {
    const double way = (2.95 - forward) / std::cos(seen.angle(i));
    if (!(way < 3.7)) continue;
    const double bias = way < 3     ? 0.1
                        : way < 3.5 ? 0.1 + 0.1 * (way - 3) / 0.5
                        : way < 3.6 ? 0.2 - 0.3 * (way - 3.5) / 0.1
                                    : -0.1;
    EXPECT_NEAR(seen.ranges[i], way + bias, 1e-9) << i;
    between += way > 3 && way < 3.6;
  }
  EXPECT_GT(between, 50);
  EXPECT_NE(refusal([] {
              Folder other;
              world_of(other, still + wall + rover(other) + "<sensors.laser biases=\"b.csv\"/>",
                       {{"b.csv", "range[m],bias[m]\n3,0.1\n3,0.2\n"}});
            }).find("b.csv:3:1: the range does not rise: 3 m after 3 m; expected each above the one before"),
            std::string::npos);
}

// The laser reaches 4 m, and the wall is 4.05 m ahead of it.
TEST(LaserErrors, ABiasBringsAWallIntoReach) {
  Folder folder;
  Simulation run = world_of(folder,
                            still + rover(folder) +
                                "<material name=\"brick\" loss=\"6\"/><wall name=\"w\" from=\"4.15 -50\" "
                                "to=\"4.15 50\" material=\"brick\"/><sensors.laser biases=\"b.csv\"/>",
                            {{"b.csv", "range[m],bias[m]\n3,-0.1\n"}});
  const Seen seen = scans(run).at(0);
  for (std::size_t i = 335; i < 347; ++i)
    EXPECT_NEAR(seen.ranges[i], (4.1 - forward) / std::cos(seen.angle(i)) - 0.1, 1e-9) << i;
}

// A near wall ends beside the x axis, before a far one.
TEST(LaserErrors, MixTwoSurfacesWithinABeam) {
  Folder folder;
  const double width = 0.02;
  Simulation run = world_of(folder, still + wall + rover(folder) +
                                        "<wall name=\"v\" from=\"2 -3\" to=\"2 0.00390625\" material=\"brick\"/>"
                                        "<sensors.laser beam=\"0.02\"/>");
  const Seen seen = scans(run).at(0);
  int mixed = 0;
  for (std::size_t i = 250; i < 430; ++i) {
    double sum = 0;
    int near = 0;
    for (int j = 0; j < 9; ++j) {
      const double angle = seen.angle(i) + width * ((j + 0.5) / 9 - 0.5);
      const bool is_near = (1.95 - forward) * std::tan(angle) < 0.00390625;
      near += is_near;
      sum += ((is_near ? 1.95 : 2.95) - forward) / std::cos(angle);
    }
    EXPECT_NEAR(seen.ranges[i], sum / 9, 1e-9) << i;
    mixed += near > 0 && near < 9;
  }
  EXPECT_GE(mixed, 2);
}

TEST(LaserErrors, LoseBeamsWithTheProbabilityThatIsStated) {
  Folder folder;
  Simulation run = world_of(folder, still + wall + rover(folder) + "<sensors.laser drop=\"0.1\" drop_far=\"0.5\"/>", {},
                            "dt=\"0.1\" until=\"40\" seed=\"1\"");
  double lost = 0, expected = 0, variance = 0;
  while (!run.done()) {
    run.step();
    const Seen seen = scans(run).at(0);
    for (std::size_t i = 250; i < 430; ++i) {
      const double share = (2.95 - forward) / std::cos(seen.angle(i)) / seen.scan.max_range;
      const double p = 0.1 + 0.5 * share * share;
      lost += seen.ranges[i] == never;
      expected += p;
      variance += p * (1 - p);
    }
  }
  EXPECT_NEAR(lost, expected, 5 * std::sqrt(variance));
}

TEST(LaserErrors, OfASweepAreThoseOfAPlaceThatMoves) {
  Folder folder;
  Simulation run = world_of(folder,
                            still + wall + rover(folder) +
                                "<robots.drive/><robots.odometry/><control.steady robot=\"r\" v=\"0.4\"/>"
                                "<sensors.laser sweep=\"0.1\"/>",
                            {}, "dt=\"0.02\" until=\"4\" seed=\"1\"");
  std::map<double, double> place, believed;  // by time
  int sent = 0;
  while (!run.done()) {
    run.step();
    place[time_of(run)] = row<Pose>(run, "robot/r/pose").x;
    believed[time_of(run)] = row<Odometry>(run, "robot/r/odometry").x;
    for (const Seen& seen : scans(run)) {
      if (seen.scan.t < 1) continue;  // it gathers speed
      ++sent;
      EXPECT_NEAR(time_of(run), seen.scan.t + 0.1, 1e-9) << "sent when it is whole";
      EXPECT_NEAR(seen.scan.t * 10, std::round(seen.scan.t * 10), 1e-9);
      EXPECT_EQ(seen.scan.x, believed.at(seen.scan.t));
      ASSERT_EQ(seen.ranges.size(), 683u);
      for (std::size_t i = 250; i < 430; ++i) {
        const double at = place.at(seen.scan.t) + 0.4 * 0.1 * static_cast<double>(i) / 682;
        EXPECT_NEAR(seen.ranges[i], (2.95 - forward - at) / std::cos(seen.angle(i)), 1e-9);
      }
    }
  }
  EXPECT_GE(sent, 28);
}

TEST(LaserErrors, OfASweepThatIsLongerThanItsPeriodAreRefused) {
  EXPECT_NE(refusal([] {
              Folder folder;
              world_of(folder, still + rover(folder) + "<sensors.laser sweep=\"0.2\"/>");
            }).find("attribute \"sweep\": the laser"),
            std::string::npos);
}

TEST(LaserErrors, AreTheSameRun) {
  Folder folder;
  const std::string inside = still + wall + rover(folder) +
                             "<robots.drive/><control.wander/><sensors.laser name=\"l\" sweep=\"0.07\" beam=\"0.01\" "
                             "noise=\"0.01\" drop=\"0.1\"/>";
  expect_one_run([&] { return world_in(folder, inside, "dt=\"0.02\" until=\"60\" seed=\"1\""); }, "l");
}

}  // namespace
