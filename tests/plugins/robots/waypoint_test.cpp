#include <gtest/gtest.h>

#include <cmath>

#include "robot_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

struct Progress {
  double next, reached;
};

const char* const square = "x[m],y[m]\n3,0\n3,3\n0,3\n0,0\n";

TEST(Waypoint, ReachesEachInTurnAndStops) {
  Folder folder;
  Simulation run = world_of(folder,
                            "<robot name=\"r\" at=\"0 0 0\"/><test.turner/>"
                            "<control.waypoint name=\"c\" robot=\"r\" path=\"path.csv\"/>",
                            {{"path.csv", square}}, "dt=\"0.05\" until=\"100\" seed=\"1\"");
  const std::pair<double, double> points[] = {{3, 0}, {3, 3}, {0, 3}, {0, 0}};
  std::size_t reached = 0;
  while (!run.done()) {
    run.step();
    const auto now = row<Progress>(run, "instance/c/progress");
    if (static_cast<std::size_t>(now.reached) == reached) continue;
    ASSERT_EQ(now.reached, ++reached);
    const auto o = row<Odometry>(run, "robot/r/odometry");
    EXPECT_LT(std::hypot(o.x - points[reached - 1].first, o.y - points[reached - 1].second), 0.05 + 0.3 * 0.05 * 2);
  }
  EXPECT_EQ(reached, 4u);
  EXPECT_EQ(row<Odometry>(run, "robot/r/odometry").v, 0);
}

TEST(Waypoint, ColumnsThatNobodyReadsAreRefused) {
  Folder folder;
  const auto error = [&](const std::string& controller, const std::string& path) {
    try {
      world_of(folder, "<robot name=\"r\" at=\"0 0 0\"/><" + controller + " robot=\"r\" path=\"path.csv\"/>",
               {{"path.csv", path}});
    } catch (const Error& e) {
      return folder.inside(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(error("control.waypoint", "x[m],y[m],tme\n3,0,1\n"),
            "path.csv:1:11: column \"tme\" means nothing here; expected one of x, y");
  EXPECT_EQ(
      error("control.waypoint", "x[m],y[m],z[m]\n3,0,1\n"),
      "path.csv:1:11: column \"z\" means nothing here; these places are on the ground; expected x, y without z, or "
      "<control.path3d/>, by which a robot flies along x[m],y[m],z[m]");
  EXPECT_EQ(
      error("control.waypoint", "x[m],y[m],yaw[rad]\n3,0,1\n"),
      "path.csv:1:11: column \"yaw\" means nothing here; these places have no headings, which follow from the way; "
      "expected x, y without yaw (in a mission, <go_to at=\"x y\" heading=\"1.57\"/> turns the robot there)");
  EXPECT_EQ(error("control.path3d", "t[s],x[m],y[m],z[m]\n1,3,0,1\n"),
            "path.csv:1:1: column \"t\" means nothing here; these places have no times, which follow from the speed; "
            "expected x, y, z without t (poses over time carry a robot by physics.replay)");
  EXPECT_EQ(
      error("control.waypoint", "x0[m],y0[m],x1[m],y1[m],width[m],radius[m]\n3,0,1,2,1,1\n"),
      "path.csv:1:1: column \"x0\" means nothing here; this is a roadmap, pieces from x0, y0 to x1, y1, and no list "
      "of places; expected x[m],y[m], as `muster roadmap --path` writes a way on it, or <control.navigate>, which "
      "takes the roadmap");
  EXPECT_EQ(error("control.waypoint", "x[m],y[m]\n"),
            "path.csv:1:1: has no rows below its header; expected one at least");
}

// Way points of PX4, whose z is down.
TEST(Waypoint, PlacesBelowTheGroundAreWarnedOf) {
  const auto warnings = [](const std::string& path, const std::string& every = "1") {
    Folder folder;
    Simulation run = world_of(folder,
                              "<robot name=\"r\" model=\"hummingbird\" at=\"0 0 0\"/><test.turner/>"
                              "<control.path3d robot=\"r\" path=\"path.csv\" every=\"" +
                                  every + "\"/>",
                              {{"path.csv", path}});
    for (int k = 0; k < 4; ++k) run.step();
    std::string result;
    for (const auto& event : run.events())
      if (event.message.find("path.csv:") != std::string::npos) result += folder.inside(event.message) + '\n';
    return result;
  };
  EXPECT_EQ(warnings("x[m],y[m],z[m]\n0,0,0\n3,0,1\n"), "");
  EXPECT_EQ(warnings("x[m],y[m],z[m]\n0,0,0\n3,0,-1.5\n3,2,-2\n"),
            "warning: path.csv:3:5: z = -1.5 m is below the ground, in 2 way points; is z down here, as in PX4 (NED)? "
            "expected metres up, and x east, y north\n");
  const std::string below = "x[m],y[m],z[m]\n0,0,-1.5\n";
  EXPECT_EQ(warnings(below, "2"), warnings(below));
}

TEST(Waypoint, LoopsWhereAsked) {
  Folder folder;
  Simulation run = world_of(folder,
                            "<robot name=\"r\" at=\"0 0 0\"/><test.turner/>"
                            "<control.waypoint name=\"c\" robot=\"r\" path=\"path.csv\" loop=\"true\" speed=\"0.5\"/>",
                            {{"path.csv", square}}, "dt=\"0.05\" until=\"100\" seed=\"1\"");
  while (!run.done()) run.step();
  EXPECT_GT(row<Progress>(run, "instance/c/progress").reached, 8);
}

// Way points that had been reached on the longer path ended the run: row 2 of 1.
TEST(Waypoint, AShorterPathThatIsSwappedInEndsNoRun) {
  for (const bool loops : {false, true}) {
    Folder folder;
    folder.write("short.csv", "x[m],y[m]\n1,1\n");
    Simulation run = world_of(folder,
                              "<robot name='r' at='0 0 0'/><test.turner/><control.waypoint name='c' robot='r' "
                              "path='path.csv'/><at t='40'><swap instance='c' plugin='control.waypoint' robot='r' "
                              "path='short.csv' loop='" +
                                  std::string(loops ? "true" : "false") + "'/></at>",
                              {{"path.csv", square}}, "dt='0.05' until='42' seed='1'");
    while (run.time() < 39.99) run.step();
    ASSERT_GE(row<Progress>(run, "instance/c/progress").next, 2);
    EXPECT_NO_THROW({
      while (!run.done()) run.step();
    });
    if (loops) {
      EXPECT_EQ(row<Progress>(run, "instance/c/progress").next, 0) << "it begins the new path";
    } else {
      EXPECT_EQ(row<Command>(run, "robot/r/command").v, 0);
    }
  }
}

}  // namespace
