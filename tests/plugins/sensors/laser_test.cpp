// Scans of robots in worlds, against plane geometry.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <sstream>

#include "scans.hpp"
#include "tests/plugins/robots/robot_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double forward = 0.05, height = 0.152 + 0.055;  // of the Scarab's laser in its frame

// The Scarab with exact ranges of its laser.
std::string exact_scarab(const Folder& folder) {
  return " model=\"" + scarab_with(folder, {{" resolution=\"0.001\"/>", "/>"}}).string() + "\"";
}

// With a second laser, on the left, turned to there and down a little.
std::string two_lasers(const Folder& folder) {
  const auto model = scarab_with(
      folder,
      {{" resolution=\"0.001\"/>", "/><laser sensor=\"left\" max_range=\"6\"/>"},
       {"<!-- Steppers",
        "<sensor name=\"left\" update_rate=\"10\"><parent link=\"base\"/><origin xyz=\"-0.05 0.02 0.3\" rpy=\"0 0.1 "
        "1.5707963267948966\"/><ray><horizontal samples=\"301\" min_angle=\"-1\" max_angle=\"1\"/></ray></sensor>"
        "<!-- Steppers"}});
  return " model=\"" + model.string() + "\"";
}

const std::string still = "<material name=\"brick\" loss=\"6\"/><physics.planar/><sensors.laser/>";

TEST(Laser, SaysThatNobodyHasOne) {
  const auto warnings = [](const std::string& model) {
    Folder folder;
    const Simulation run = world_of(folder, still + "<robot name=\"r\" model=\"" + model + "\" at=\"0 0 0\"/>");
    return std::count_if(run.events().begin(), run.events().end(), [](const Event& event) {
      return event.message.find("no robot's model has a laser, so that scan/*/message stays empty") !=
             std::string::npos;
    });
  };
  EXPECT_EQ(warnings("husky"), 1);
  EXPECT_EQ(warnings("scarab"), 0);
}

TEST(Laser, RangesToAWallAreThoseOfPlaneGeometry) {
  Folder folder;
  Simulation run = world_of(folder, still + "<robot name=\"r\" at=\"1 2 0\" heading=\"0.5\"" + exact_scarab(folder) +
                                        "/><wall name=\"w\" from=\"3 -50\" to=\"3 50\" material=\"brick\"/>");
  const auto seen = scans(run);
  ASSERT_EQ(seen.size(), 1u);
  ASSERT_EQ(seen[0].ranges.size(), 683u);
  EXPECT_EQ(seen[0].scan.robot, 0);
  EXPECT_NEAR(seen[0].angle(682) - seen[0].angle(0), 682 * 2 * 3.141592653589793 / 1024, 1e-5) << "240 degrees";
  int hits = 0;
  for (std::size_t i = 0; i < 683; ++i) {
    const double way = std::cos(0.5 + seen[0].angle(i));
    const double range = (2.95 - 1 - forward * std::cos(0.5)) / way;  // the wall is 0.1 m thick
    if (way > 0 && range <= 4) {
      EXPECT_NEAR(seen[0].ranges[i], range, 1e-9);
      ++hits;
    } else {
      EXPECT_EQ(seen[0].ranges[i], never);
    }
  }
  EXPECT_GT(hits, 300);
}

TEST(Laser, TellsMillimetres) {
  Folder folder;
  Simulation run = world_of(folder, still +
                                        "<robot name=\"r\" at=\"1 2 0\"/><wall name=\"w\" from=\"3 -50\" to=\"3 50\" "
                                        "material=\"brick\"/>");
  const Seen seen = scans(run).at(0);
  for (std::size_t i = 250; i < 433; ++i) {
    const double exact = (2.95 - 1 - forward) / std::cos(seen.angle(i));
    EXPECT_NEAR(seen.ranges[i], exact, 0.0005 + 1e-12);
    EXPECT_NEAR(seen.ranges[i] * 1000, std::round(seen.ranges[i] * 1000), 1e-9);
  }
}

TEST(Laser, ScansTenTimesASecondOrOnceATick) {
  for (const auto& [dt, expected] : {std::pair{0.02, 31}, {0.03, 31}, {0.25, 13}}) {
    Folder folder;
    std::ostringstream attributes;
    attributes << "dt=\"" << dt << "\" until=\"3\" seed=\"1\"";
    Simulation run = world_of(folder, still + "<robot name=\"r\" at=\"0 0 0\"/>", {}, attributes.str());
    int count = 0;
    for (;;) {
      for (const Seen& seen : scans(run)) {
        ++count;
        EXPECT_LT(std::abs(seen.scan.t - seen.scan.id / 10), dt + 1e-9);
        EXPECT_GE(seen.scan.t, seen.scan.id / 10 - 1e-9);
      }
      if (run.done()) break;
      run.step();
    }
    EXPECT_EQ(count, expected) << dt;
  }
}

TEST(Laser, SeesThroughOpenDoorsAlone) {
  for (const std::string state : {"open", "closed"}) {
    Folder folder;
    Simulation run = world_of(folder, still +
                                          "<robot name=\"r\" at=\"0 0 0\"/>"
                                          "<wall name=\"w\" from=\"2 -3\" to=\"2 3\" material=\"brick\"/>"
                                          "<wall name=\"v\" from=\"3 -3\" to=\"3 3\" material=\"brick\"/>"
                                          "<door name=\"d\" wall=\"w\" at=\"2.5\" width=\"1\" state=\"" +
                                          state + "\"/>");
    const Seen seen = scans(run).at(0);
    EXPECT_NEAR(seen.ranges[341], (state == "open" ? 2.95 : 1.95) - forward, 0.001);
    EXPECT_NEAR(seen.ranges[461] * std::cos(seen.angle(461)), 1.95 - forward, 0.001) << "beside the door";
  }
}

TEST(Laser, SeesOtherRobotsAndNotItsOwn) {
  Folder folder;
  Simulation run =
      world_of(folder, "<physics.simbody/><sensors.laser/><robot name=\"r\" at=\"0 0 0\"" + exact_scarab(folder) +
                           "/><robot name=\"c\" model=\"crate\" at=\"2 0 0\" heading=\"0.3\"/>"
                           "<robot name=\"s\" at=\"0 1 0\"/>");
  const auto all = scans(run);
  ASSERT_EQ(all.size(), 2u) << "a crate has no laser";
  // The crate's near face: its middle 0.2 m from the crate's, turned by 0.3.
  EXPECT_NEAR(all[0].ranges[341], 2 - forward - 0.2 / std::cos(0.3), 1e-9);
  int near = 0;
  for (std::size_t i = 0; i < 683; ++i) near += all[0].ranges[i] < 0.8;
  EXPECT_EQ(near, 0) << "nothing of itself";
  // Over the other's box its own laser rises, a mesh, at (0.05, 1): a disc of 42 mm.
  const std::size_t left = 341 + 256;  // straight to the left
  EXPECT_NEAR(all[0].ranges[left], 1 - 0.021, 0.0005);
  EXPECT_EQ(all[0].ranges[left + 10], never) << "3.5 degrees beside that";
}

TEST(Laser, NoiseHasTheVarianceThatIsStated) {
  Folder folder;
  Simulation run =
      world_of(folder,
               "<material name=\"brick\" loss=\"6\"/><physics.planar/>"
               "<sensors.laser noise=\"0.01\" share=\"0.02\"/><robot name=\"r\" at=\"1 2 0\"" +
                   exact_scarab(folder) + "/><wall name=\"w\" from=\"3 -50\" to=\"3 50\" material=\"brick\"/>",
               {}, "dt=\"0.1\" until=\"20\" seed=\"1\"");
  double squares = 0, neighbours = 0, sum = 0;
  int count = 0;
  while (!run.done()) {
    run.step();
    const Seen seen = scans(run).at(0);
    double before = 0;
    for (std::size_t i = 200; i < 480; ++i) {
      const double exact = (2.95 - 1 - forward) / std::cos(seen.angle(i));
      const double error = (seen.ranges[i] - exact) / std::hypot(0.01, 0.02 * exact);
      squares += error * error;
      neighbours += error * before;
      sum += error;
      before = error;
      ++count;
    }
  }
  const double deviation = std::sqrt(1.0 / count);
  EXPECT_NEAR(squares / count, 1, 5 * std::sqrt(2.0) * deviation);
  EXPECT_NEAR(neighbours / count, 0, 5 * deviation);
  EXPECT_NEAR(sum / count, 0, 5 * deviation);
}

const std::string room =
    "<wall name=\"e\" from=\"2 -2\" to=\"2 2\" material=\"brick\"/><wall name=\"w\" from=\"-2 -2\" to=\"-2 2\" "
    "material=\"brick\"/>"
    "<wall name=\"n\" from=\"-2 2\" to=\"2 2\" material=\"brick\"/><wall name=\"s\" from=\"-2 -2\" to=\"2 -2\" "
    "material=\"brick\"/>";

// End points of the rays of a turned laser, by the pose in the scan.
TEST(Laser, StandsWhereItsScansSay) {
  Folder folder;
  Simulation run = world_of(folder, still + "<robot name=\"r\" at=\"0 0 0\"" + two_lasers(folder) + "/>" + room);
  const auto both = scans(run);
  ASSERT_EQ(both.size(), 2u);
  const Scan& left = both[1].scan;
  EXPECT_EQ(left.sensor, 1);
  const Eigen::Isometry3d at =
      Eigen::Translation3d(left.at_x, left.at_y, left.at_z) * Eigen::Quaterniond(left.qw, left.qx, left.qy, left.qz);
  for (std::size_t i = 0; i < 301; ++i) {
    const double a = both[1].angle(i), range = both[1].ranges[i];
    const Eigen::Vector3d end = at * Eigen::Vector3d(range * std::cos(a), range * std::sin(a), 0);
    EXPECT_NEAR(std::max(std::abs(end.x()), end.y()), 1.95, 1e-9) << i;
    EXPECT_GT(end.y(), 0) << "on the left";
    EXPECT_LT(end.z(), 0.3 - 1e-3) << "and down";
  }
}

TEST(Laser, LasersOfARobotHaveNoiseOfTheirOwn) {
  Folder folder;
  const auto seen = [&](const std::string& noise) {
    return scans(world_of(folder, "<material name=\"brick\" loss=\"6\"/><physics.planar/><sensors.laser noise=\"" +
                                      noise + "\"/><robot name=\"r\" at=\"0 0 0\"" + two_lasers(folder) + "/>" + room));
  };
  const auto exact = seen("0");
  std::filesystem::remove(folder / "hokuyo.stl");
  const auto noisy = seen("0.01");
  for (const std::size_t shift : {std::size_t{0}, std::size_t{300}, std::size_t{301}}) {
    double product = 0;
    for (std::size_t i = 0; i < 301; ++i) {
      product += (noisy[0].ranges[shift + i] - exact[0].ranges[shift + i]) * (noisy[1].ranges[i] - exact[1].ranges[i]);
    }
    EXPECT_LT(std::abs(product) / 1e-4 / 301, 5 / std::sqrt(301.0)) << shift;
  }
}

TEST(Laser, OfAnInstanceThatStepsSeldomScansAsOften) {
  Folder folder;
  Simulation run = world_of(folder, "<physics.planar/><sensors.laser every=\"3\"/><robot name=\"r\" at=\"0 0 0\"/>", {},
                            "dt=\"0.02\" until=\"3\" seed=\"1\"");
  std::set<double> ids;
  while (!run.done()) {
    run.step();
    for (const Seen& seen : scans(run)) ids.insert(seen.scan.id);
  }
  EXPECT_EQ(ids.size(), 31u) << "it steps more often than that";
}

TEST(Laser, WhatIsTooNearIsMinusInfinity) {
  Folder folder;
  Simulation run = world_of(folder, still +
                                        "<robot name=\"r\" at=\"0 0 0\"/>"
                                        "<wall name=\"w\" from=\"0.11 -3\" to=\"0.11 3\" material=\"brick\"/>");
  const Seen seen = scans(run).at(0);
  EXPECT_EQ(seen.ranges[341], -never) << "1 cm";
  EXPECT_NEAR(seen.ranges[541], 0.01 / std::cos(seen.angle(541)), 0.001);
}

TEST(Laser, SaysWhereTheRobotBelievedToBe) {
  Folder folder;
  Simulation run = world_of(folder, still +
                                        "<robot name=\"r\" at=\"0 0 0\"/><control.steady robot=\"r\" v=\"0.4\"/>"
                                        "<robots.drive/><robots.odometry noise=\"0.05\"/>");
  for (int k = 0; k < 100; ++k) run.step();
  const auto seen = scans(run).at(0).scan;
  const auto believed = row<Odometry>(run, "robot/r/odometry");
  EXPECT_EQ(seen.x, believed.x);
  EXPECT_EQ(seen.yaw, believed.yaw);
  EXPECT_NE(seen.x, row<Pose>(run, "robot/r/pose").x) << "not where it was";
  EXPECT_NEAR(seen.at_x, forward, 1e-12);
  EXPECT_NEAR(seen.at_z, height, 1e-12);

  Folder other;
  Simulation without = world_of(other, still + "<robot name=\"r\" at=\"0 0 0\"/>");
  EXPECT_TRUE(is_null(scans(without).at(0).scan.x));
}

// A robot that leans forward by 0.2 detects the ground.
TEST(Laser, SeesTheGroundWhereItLeans) {
  Folder folder;
  std::ostringstream course;
  course.precision(17);
  course << "t[s],robot,x[m],y[m],z[m],qw,qx,qy,qz\n0,r,0,0,0," << std::cos(0.1) << ",0," << std::sin(0.1) << ",0\n";
  Simulation run = world_of(folder,
                            "<robot name=\"r\" at=\"0 0 0\"" + exact_scarab(folder) +
                                "/><physics.replay file=\"course.csv\"/><sensors.laser/>",
                            {{"course.csv", course.str()}}, "dt=\"0.1\" until=\"1\" seed=\"1\"");
  run.step();
  const Seen seen = scans(run).at(0);
  const double high = height * std::cos(0.2) - forward * std::sin(0.2);
  for (std::size_t i = 0; i < 683; ++i) {
    const double range = high / (std::sin(0.2) * std::cos(seen.angle(i)));
    if (range > 0 && range < 4) {
      EXPECT_NEAR(seen.ranges[i], range, 1e-9);
    } else {
      EXPECT_EQ(seen.ranges[i], never);
    }
  }
}

// A robot that joined as a copy has the laser of its original, and is detected.
TEST(Laser, IsOnRobotsThatJoinToo) {
  Folder folder;
  Simulation run = world_of(folder,
                            still +
                                "<robot name=\"r\" at=\"0 0 0\"/>"
                                "<toy.join at=\"3\" leave=\"9\" like=\"0\" column=\"0\" value=\"2\"/>",
                            {}, "dt=\"0.1\" until=\"2\" seed=\"1\"");
  EXPECT_EQ(scans(run).at(0).ranges[341], never);
  while (run.tick() < 6) run.step();
  const auto both = scans(run);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[1].scan.robot, 1);
  EXPECT_EQ(both[1].ranges.size(), 683u);
  EXPECT_NEAR(both[0].ranges[341], 2 - forward, 0.1);
  while (run.tick() < 12) run.step();
  EXPECT_EQ(scans(run).size(), 1u) << "it has left";
  EXPECT_EQ(scans(run).at(0).ranges[341], never);
}

}  // namespace
