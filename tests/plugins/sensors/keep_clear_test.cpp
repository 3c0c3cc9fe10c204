// A robot that drives straight on, and the obstacles at which its laser stops it.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/plugins/robots/robot_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

// Straight on; `more` are attributes of the commanding controller.
std::string driven(const std::string& more = "") {
  return "<material name=\"brick\" loss=\"6\"/><control.steady robot=\"r\" v=\"0.5\"" + more +
         "/><physics.planar/><robots.drive/>";
}

// A Scarab whose laser has exact ranges.
Simulation towards(const Folder& folder, const std::string& more) {
  const auto model = scarab_with(folder, {{" resolution=\"0.001\"/>", "/>"}});
  return world_of(folder, driven() + "<robot name=\"r\" at=\"0 0 0\" model=\"" + model.string() + "\"/>" + more, {},
                  "dt=\"0.02\" until=\"30\" seed=\"1\"");
}

std::string wall(const std::string& name, const std::string& from, const std::string& to) {
  return "<wall name=\"" + name + "\" from=\"" + from + "\" to=\"" + to + "\" material=\"brick\"/>";
}

TEST(KeepClear, StopsBeforeAWallAsHardAsItIsToldTo) {
  Folder folder;
  Simulation run = towards(folder, wall("w", "3 -2", "3 2") + "<control.keep_clear robot=\"r\" clearance=\"0.4\"/>");
  double fastest = 0, hardest = 0, before = 0;
  while (!run.done()) {
    run.step();
    const double v = row<Twist>(run, "robot/r/twist").vx;
    fastest = std::max(fastest, v);
    if (v < before) hardest = std::max(hardest, (before - v) / 0.02);
    before = v;
  }
  EXPECT_NEAR(fastest, 0.5, 1e-9) << "far from it";
  EXPECT_NEAR(hardest, 0.5, 0.02);
  EXPECT_NEAR(row<Pose>(run, "robot/r/pose").x, 2.95 - 0.4, 0.01);
  EXPECT_NEAR(row<Twist>(run, "robot/r/twist").vx, 0, 1e-9);
}

// Resting place of a Scarab with these changes before the same wall.
double stands(const std::vector<std::pair<std::string, std::string>>& changes, const std::string& more = "") {
  Folder folder;
  Simulation run = world_of(folder,
                            driven(more) + "<robot name=\"r\" at=\"0 0 0\" model=\"" +
                                scarab_with(folder, changes).string() + "\"/>" + wall("w", "3 -2", "3 2") +
                                "<control.keep_clear robot=\"r\" clearance=\"0.4\"" + more + "/>",
                            {}, "dt=\"0.02\" until=\"30\" seed=\"1\"");
  while (!run.done()) run.step();
  return row<Pose>(run, "robot/r/pose").x;
}

TEST(KeepClear, LooksWhereItsFirstLaserIsTurnedTo) {
  const std::pair<std::string, std::string> turned = {"<origin xyz=\"0 0 0.055\"/>",
                                                      "<origin xyz=\"0 0 0.055\" rpy=\"0 0 1.5707963267948966\"/>"};
  EXPECT_NEAR(stands({turned}), 2.95 - 0.4, 0.01);
  const std::pair<std::string, std::string> second = {
      "<!-- Steppers",
      "<sensor name=\"back\" update_rate=\"50\"><parent link=\"base\"/><origin rpy=\"0 0 3.14159\" xyz=\"0 0 "
      "0.3\"/><ray>"
      "<horizontal/></ray></sensor><!-- Steppers"};
  EXPECT_NEAR(stands({second, {"<laser ", "<laser sensor=\"back\" max_range=\"9\"/><laser "}}), 2.95 - 0.4, 0.01);
}

// A laser at the robot's origin that has no range below 0.5 m.
TEST(KeepClear, StopsForWhatIsTooNearToTell) {
  const double at = stands({{"<origin xyz=\"0 0 0.055\"/>", "<origin xyz=\"-0.05 0 0.055\"/>"},
                            {"min_range=\"0.02\"", "min_range=\"0.5\""}});
  EXPECT_LT(at, 2.95 - 0.4);
  EXPECT_GT(at, 2.95 - 0.6);
}

// A scan read late is from an earlier place: its free distance is reduced to that of the next step.
TEST(KeepClear, TakesOffTheAgeOfAScan) {
  Folder folder;
  Simulation run = world_of(folder,
                            driven(" every=\"22\"") + "<robot name=\"r\" at=\"0 0 0\"/>" + wall("w", "5 -2", "5 2") +
                                "<control.keep_clear name=\"k\" every=\"22\" robot=\"r\"/>",
                            {}, "dt=\"0.02\" until=\"8\" seed=\"1\"");
  int asked = 0;
  for (double told = 0; run.tick() + 22 <= run.world().ticks; ++asked) {
    for (int k = 0; k < 21; ++k) run.step();
    const double free = 4.95 - row<Pose>(run, "robot/r/pose").x;
    if (free < 3.5 && free > 2) {
      EXPECT_NEAR(told, free, 0.001);  // at 0.5 m/s
    }
    run.step();  // of the 22 the one in which it steps
    told = row<double>(run, "instance/k/ahead");
  }
  EXPECT_GT(asked, 10);
}

TEST(KeepClear, WithoutItTheRobotGoesOn) {
  Folder folder;
  Simulation run = towards(folder, wall("w", "9 -2", "9 2"));
  while (!run.done()) run.step();
  EXPECT_GT(row<Pose>(run, "robot/r/pose").x, 10) << "physics.planar knows no walls";
}

TEST(KeepClear, GoesThroughWhatIsWideEnough) {
  for (const bool wide : {true, false}) {
    Folder folder;
    const std::string edge = wide ? "0.2" : "0.15";  // a path of 0.35 m must be free
    Simulation run = towards(
        folder, wall("a", "3 -3", "3 -" + edge) + wall("b", "3 " + edge, "3 3") + "<control.keep_clear robot=\"r\"/>");
    while (!run.done()) run.step();
    EXPECT_EQ(row<Pose>(run, "robot/r/pose").x > 4, wide);
  }
}

TEST(KeepClear, LetsARobotTurnAwayAndDriveBack) {
  Folder folder;
  Simulation run =
      world_of(folder,
               "<material name=\"brick\" loss=\"6\"/><robot name=\"r\" at=\"2.7 0 0\"/>" + wall("w", "3 -2", "3 2") +
                   "<control.steady robot=\"r\" v=\"-0.2\" w=\"0.3\"/><physics.planar/><robots.drive/>"
                   "<control.keep_clear robot=\"r\"/>",
               {}, "dt=\"0.02\" until=\"1\" seed=\"1\"");
  while (!run.done()) run.step();
  const auto asked = row<Command>(run, "robot/r/command");
  EXPECT_EQ(asked.v, -0.2);
  EXPECT_EQ(asked.w, 0.3);
}

TEST(KeepClear, StandsUntilItHasSeenAnything) {
  Folder folder;
  Simulation run = towards(folder, "<control.keep_clear name=\"k\" robot=\"r\"/>");
  EXPECT_EQ(row<double>(run, "instance/k/ahead"), 0);
  run.step();
  EXPECT_EQ(row<double>(run, "instance/k/ahead"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(row<Command>(run, "robot/r/command").v, 0.5);
}

TEST(KeepClear, NeedsALaser) {
  Folder folder;
  try {
    world_of(folder,
             "<robot name=\"r\" model=\"crate\" at=\"0 0 0\"/><control.steady robot=\"r\"/><physics.simbody/>"
             "<robots.drive/><control.keep_clear robot=\"r\"/>");
    FAIL() << "expected a refusal";
  } catch (const std::exception& refused) {
    const std::string what = refused.what();
    EXPECT_NE(what.find("control.keep_clear (control.keep_clear): the model \"crate\" of robot \"r\" ("),
              std::string::npos)
        << what;
    EXPECT_NE(what.find(") has no laser; expected fittings=\"FILE\" at the robot, with a <sensor> with a <ray> and, in "
                        "<muster>, <laser sensor=\"...\" min_range=\"...\" max_range=\"...\"/>, or a model that has "
                        "one: scarab, waffle"),
              std::string::npos)
        << what;
  }
}

}  // namespace
