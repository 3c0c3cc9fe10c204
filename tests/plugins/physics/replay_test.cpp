// physics.replay: bodies follow measured poses.
#include "physics_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

const std::string robots = R"(<robot name="a" at="9 9 0.5"/><robot name="b" at="3 1 0" heading="2"/>)";
const std::string backend = R"(<physics.replay file="course.csv"/>)";

Simulation replayed(const Folder& folder, const std::string& csv) {
  folder.write("course.csv", csv);
  return world_of(folder, robots + backend, 1, "0.1");
}

TEST(Replay, PassesThroughTheSamplesAndEvenlyBetween) {
  Folder folder;
  Simulation run =
      replayed(folder, "t[s],robot,x[m],y[m],z[m],yaw[rad]\n0,a,0,0,0.1,3\n1,a,1,2,0.3,-3\n2,a,1,2,0.3,-3\n");
  run_to(run, 5);
  auto pose = row<Pose>(run, "robot/a/pose");
  EXPECT_NEAR(pose.x, 0.5, 1e-12);
  EXPECT_NEAR(pose.y, 1, 1e-12);
  EXPECT_NEAR(pose.z, 0.2, 1e-12);
  // From 3 to -3 rad the shorter way leads through pi.
  EXPECT_NEAR(std::abs(2 * std::atan2(pose.qz, pose.qw)), 3.141592653589793, 1e-9);
  auto twist = row<Twist>(run, "robot/a/twist");
  EXPECT_NEAR(twist.vx, 1, 1e-9);
  EXPECT_NEAR(twist.vy, 2, 1e-9);
  EXPECT_NEAR(twist.wz, 2 * (3.141592653589793 - 3), 1e-9);
  run_to(run, 10);
  EXPECT_EQ(row<Pose>(run, "robot/a/pose").x, 1);
  run_to(run, 30);  // past the end it is at rest
  EXPECT_EQ(row<Pose>(run, "robot/a/pose").y, 2);
  EXPECT_EQ(row<Twist>(run, "robot/a/twist").vx, 0);
}

TEST(Replay, RobotsWithoutACourseStandAndHeightsStayWhereNotMeasured) {
  Folder folder;
  Simulation run = replayed(folder, "t[s],robot,x[m],y[m],yaw[rad]\n0,a,0,0,0\n1,a,1,0,0\n");
  run_to(run, 20);
  EXPECT_EQ(row<Pose>(run, "robot/b/pose").x, 3);
  EXPECT_EQ(row<Pose>(run, "robot/a/pose").z, 0.5);
}

TEST(Replay, QuaternionsAreRead) {
  Folder folder;
  Simulation run = replayed(folder, "t[s],robot,x[m],y[m],z[m],qw,qx,qy,qz\n0,a,0,0,0,0.6,0.8,0,0\n");
  run_to(run, 1);
  EXPECT_NEAR(row<Pose>(run, "robot/a/pose").qx, 0.8, 1e-12);
}

// Rear wheels stood, front wheels knew no way sideways.
TEST(Replay, AllFourWheelsOfAMecanumDriveTurn) {
  Folder folder;
  folder.write("course.csv", "t[s],robot,x[m],y[m],yaw[rad]\n0,m,0,0,0\n2,m,0,1,0\n");
  Simulation run =
      world_of(folder, R"(<robot name="m" model="youbot" at="0 0 0"/><robots.odometry/>)" + backend, 1, "0.1");
  run_to(run, 20);
  const auto front = row<Wheels>(run, "robot/m/wheels"), rear = row<Wheels>(run, "robot/m/rear_wheels");
  const double turned = 1 / 0.0475;  // [rad] by a metre
  EXPECT_NEAR(front.left, -turned, 1e-6);
  EXPECT_NEAR(front.right, turned, 1e-6);
  EXPECT_NEAR(rear.left, turned, 1e-6);
  EXPECT_NEAR(rear.right, -turned, 1e-6);
  run_to(run, 22);
  EXPECT_EQ(row<Wheels>(run, "robot/m/rear_wheels").left_rate, 0);
  EXPECT_NEAR(row<Odometry>(run, "robot/m/odometry").x, 0, 1e-3);
  EXPECT_NEAR(row<Odometry>(run, "robot/m/odometry").y, 1, 1e-3);
}

TEST(Replay, WheelsTurnAsTheMotionSays) {
  Folder folder;
  Simulation run = replayed(folder, "t[s],robot,x[m],y[m],yaw[rad]\n0,a,0,0,0\n2,a,1,0,0\n");
  run_to(run, 20);
  const auto wheels = row<Wheels>(run, "robot/a/wheels");
  EXPECT_NEAR(wheels.left, 1 / 0.05, 1e-9);
  EXPECT_NEAR(wheels.right, 1 / 0.05, 1e-9);
}

TEST(Replay, RemadeInMidRunGivesTheSameBits) {
  Folder folder;
  const std::string csv = "t[s],robot,x[m],y[m],yaw[rad]\n0,a,0,0,0\n1,a,1,2,1\n3,a,4,5,-2\n";
  Simulation straight = replayed(folder, csv), remade = replayed(folder, csv);
  run_to(straight, 25);
  run_to(remade, 12);
  remade.remake("physics.replay");
  run_to(remade, 25);
  EXPECT_EQ(straight.digest(), remade.digest());
}

std::string refusal(const std::string& csv) {
  Folder folder;
  try {
    Simulation run = replayed(folder, csv);
    run.step();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit(), Exit::invalid_input);
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

std::vector<std::string> warnings(const std::string& csv) {
  Folder folder;
  Simulation run = replayed(folder, csv);
  run.step();
  std::vector<std::string> result;
  for (const auto& event : run.events())
    if (const auto at = event.message.find(".csv:"); at != std::string::npos)
      result.push_back(event.message.substr(at));
  return result;
}

// Columns that are not read are many; one that has the name of what lacks is most likely that.
TEST(Replay, AHeadingByAnotherNameIsToldAsNotRead) {
  const auto told = [](const std::string& columns) {
    Folder folder;
    const Simulation run = replayed(folder, columns + "\n0,a,0,0,0\n1,a,1,0,0\n");
    std::string result;
    for (const auto& event : run.events())
      if (const auto at = event.message.find("course.csv:"); at != std::string::npos)
        result += event.message.substr(at);
    return result;
  };
  EXPECT_EQ(told("t[s],robot,x[m],y[m],theta[rad]"),
            "course.csv:1:22: column \"theta\" is not read; is it yaw? expected the header \"yaw[rad]\"");
  EXPECT_EQ(told("t[s],robot,x[m],y[m],battery[V]"), "");
}

TEST(Replay, DegreesAndJumpsAreWarnedOfOnce) {
  const std::string head = "t[s],robot,x[m],y[m],yaw[rad]\n", row = ".csv:3:1: robot 'a': ";
  EXPECT_EQ(warnings(head + "0,a,0,0,0\n1,a,1,0,90\n2,a,1,1,180\n"),
            std::vector<std::string>(
                {".csv:3:9: column \"yaw[rad]\": 90 rad is more than a full turn; are these degrees? 90 degrees are "
                 "1.5708 rad"}));
  EXPECT_EQ(
      warnings(head + "0,a,0,0,0\n1,a,682034,0,0\n5000,a,682035,0,0\n"),
      std::vector<std::string>({".csv:3:5: column \"x[m]\": 682034 m: a place on the globe (UTM)? expected metres "
                                "from an origin of your own",
                                row + "it moves by 682034 m in 1 s"}));
  EXPECT_EQ(warnings(head + "0,a,0,0,0\n0.01,a,500,0,0\n"),
            std::vector<std::string>({row + "it moves by 500 m in 0.01 s"}));
  EXPECT_EQ(warnings(head + "0,a,0,0,0\n1,a,1,0,6.28\n"), std::vector<std::string>());
}

// As a log of ROS has them: the robot would stand at its first place for the whole run.
TEST(Replay, TimesThatTheRunNeverComesToAreWarnedOf) {
  const auto said = [](const std::string& rows) {
    Folder folder;
    Simulation run = replayed(folder, "t[s],robot,x[m],y[m],yaw[rad]\n" + rows);
    run.step();
    std::string result;
    for (const auto& event : run.events())
      if (const auto at = event.message.find(".csv:"); at != std::string::npos) result += event.message.substr(at);
    return result;
  };
  const std::string end = " s, and the run is from 0 to 600 s, so that it never moves; ";
  EXPECT_EQ(said("1717401234.5,a,0,0,0\n1717401254.25,a,1,0,0\n"),
            ".csv:2:1: the rows of robot 'a' are from t = 1717401234.5 to 1717401254.25" + end +
                "are these seconds since 1970? expected seconds of the run: the time less that of its start");
  EXPECT_EQ(said("5000,a,0,0,0\n5001,a,1,0,0\n"),
            ".csv:2:1: the rows of robot 'a' are from t = 5000 to 5001" + end + "expected seconds of the run");
  EXPECT_EQ(said("43200,a,0,0,0\n43201,a,1,0,0\n"),
            ".csv:2:1: the rows of robot 'a' are from t = 43200 to 43201 s, and the run is from 0 to 600 s, so that it "
            "never moves; are these seconds of the day? expected seconds of the run: the time less that of its start");
  EXPECT_EQ(said("-5,a,0,0,0\n-4,a,1,0,0\n"),
            ".csv:2:1: the rows of robot 'a' are from t = -5 to -4" + end + "expected seconds of the run");
  EXPECT_EQ(said("-5,a,0,0,0\n0.5,a,1,0,0\n"), "");
}

TEST(Replay, WrongRowsAreNamed) {
  using testing::HasSubstr;
  const std::string head = "t[s],robot,x[m],y[m],z[m],yaw[rad]\n";
  EXPECT_THAT(
      refusal(head + "0,a,0,0,0,0\n1,b,0,0,0,0\n0,a,1,0,0,0\n"),
      HasSubstr(".csv:4:1: robot 'a': time does not rise: 0 s after 0 s; expected its rows in the order of time"));
  EXPECT_THAT(refusal(head + "0,a,0,0,0,0\n1,a,0,0,,0\n"),
              HasSubstr(".csv:3:1: robot 'a': z is given in some rows only"));
  EXPECT_THAT(refusal(head + "0,a,0,0,0,\n"), HasSubstr(".csv:2:1: robot 'a': has neither yaw nor qw, qx, qy, qz of "
                                                        "length 1: it has none of them; expected a column yaw[rad]"));
  EXPECT_THAT(refusal("t[s],robot,x[m],y[m],qw,qx,qy\n0,a,0,0,1,0,0\n"), HasSubstr("of length 1: qz is missing"));
  EXPECT_THAT(refusal("t[s],robot,x[m],y[m],qw,qx,qy,qz\n0,a,0,0,0,0,0,0\n"),
              HasSubstr("of length 1: its length is 0"));
  EXPECT_THAT(refusal(head + "0,c,0,0,0,0\n"), HasSubstr("c"));  // no such robot: the kernel's own refusal
}

}  // namespace
