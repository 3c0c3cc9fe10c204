// A client sees what a controller in process may see: the kernel refuses the same claims.
#include <gmock/gmock.h>

#include "tests/run_world.hpp"

namespace muster::test {
namespace {

using testing::HasSubstr;

std::string refusal(const std::string& attributes) {
  const Folder folder;
  const auto file = folder.write(
      "world.xml",
      R"(<world name="w" dt="0.1" until="1"><station name="base" at="0 0 1"/><robot name="a" at="0 0 0"/>)"
      R"(<robot name="b" at="4 0 0"/><radio.multiwall/><network.ideal/><control.beacon radio="base"/><bridge.socket )" +
          attributes + "/></world>");
  try {
    Simulation run(read_world(file, standard()), standard(), {{MUSTER_PLUGINS_DIR}, 1, {}});
    return "";
  } catch (const Error& e) {
    return folder.inside(e.what());
  }
}

TEST(BridgeBlindness, TruthIsRefusedToATeamsClientAndToARobots) {
  for (const std::string& bound : {std::string(), std::string("robot=\"a\" ")}) {
    for (const char* truth : {"robot/a/pose", "robot/a/twist", "link/*/rssi", "link/*/level", "endpoint/*/pose",
                              "wall/*/shape", "radio/*/traffic", "instance/network.ideal/x(y)"}) {
      EXPECT_THAT(refusal(bound + "reads=\"" + truth + "\" writes=\"robot/a/command\""), HasSubstr("which is truth"))
          << truth;
    }
  }
  EXPECT_THAT(refusal("writes=\"robot/a/pose\""), HasSubstr("which is truth"));
}

TEST(BridgeBlindness, ABoundOneSeesItsOwnRobotAlone) {
  EXPECT_EQ(refusal("robot=\"a\" reads=\"robot/{robot}/odometry inbox/a/message\" writes=\"robot/{robot}/command\""),
            "");
  for (const char* others : {"robot/b/odometry", "robot/*/odometry", "inbox/b/message", "inbox/base/message"})
    EXPECT_THAT(refusal("robot=\"a\" reads=\"" + std::string(others) + "\" writes=\"robot/a/command\""),
                HasSubstr("but it is bound to the robot \"a\"; expected that robot's own row"));
  EXPECT_THAT(refusal("robot=\"a\" writes=\"robot/b/command\""), HasSubstr("but it is bound to the robot \"a\""));
}

TEST(BridgeBlindness, ATeamsSeesWhatItsRobotsSense) {
  EXPECT_EQ(refusal("reads=\"robot/*/odometry robot/b/stall inbox/*/message\" writes=\"robot/*/command\""), "");
}

TEST(BridgeTables, WordsThatAreNoneAreRefused) {
  EXPECT_THAT(refusal(""), HasSubstr("has no tables to be commanded; expected an attribute writes="));
  EXPECT_THAT(refusal("writes=\"command\""),
              HasSubstr("attribute \"writes\": \"command\" is no table; expected set/row/quantity, such as "
                        "robot/{robot}/command"));
  EXPECT_THAT(refusal("writes=\"robot/a/gesture\""),
              HasSubstr("is no standard table; expected its columns behind it, such as robot/a/gesture(x[m] y[m])"));
  EXPECT_THAT(
      refusal("reads=\"robot/a/odom\" writes=\"robot/a/command\""),
      HasSubstr("\"robot/a/odom\" is no standard table; did you mean robot/a/odometry? a table of your own has"));
  EXPECT_THAT(refusal("writes=\"robot/a/cmd_vel\""), HasSubstr("did you mean robot/a/command?"));
  EXPECT_THAT(refusal("writes=\"robot/a/gesture(x[m]\""), HasSubstr("robot/a/gesture( has no closing )"));
  EXPECT_THAT(refusal("writes=\"robot/a/gesture(x[m] y|z)\""), HasSubstr("column \"y|z\""));
  EXPECT_THAT(refusal("writes=\"robot/c/command\""), HasSubstr("called \"c\""));
  EXPECT_EQ(refusal("writes=\"robot/a/gesture(x[m] y[m]?)\""), "");
}

}  // namespace
}  // namespace muster::test
