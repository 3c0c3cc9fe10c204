// Data that a controller may read: its own robot's sensors, its own memory, and its messages.
#include "toy_world.hpp"

namespace muster {
namespace {

using Truth = ToyWorld;

const std::string all_sensed =
    "robot/command, robot/car_command, robot/goal2d, robot/odometry, robot/odometry_reset, "
    "robot/stall, "
    "robot/geometry, robot/attitude_thrust, robot/velocity3d, robot/position3d, robot/imu, "
    "robot/gps, scan/message, heard/peer, range/message, image/message, outbox/message, inbox/message";
const std::string sensed = "expected one of " + all_sensed;
const std::string for_a_pose =
    "expected in its place read<Odometry>(\"robot/{robot}/odometry\"), or "
    "read<Position3d>(\"robot/{robot}/position3d\") of what flies; or another of " +
    all_sensed;
const std::string for_a_level =
    "expected in its place the rssi of messages, read<Incoming>(\"inbox/{robot}/message\"); or another of " +
    all_sensed;
const std::string odometry = "x[m] y[m] yaw[rad] v[m/s] w[rad/s]";
const std::string rest = "<toy.copy_sense name='sensor' to='robot/*/odometry' columns='" + odometry + "'/>\n";

TEST_F(Truth, TruthIsRefused) {
  const auto controller = [&](const std::string& attributes) {
    return error_of_world(two_robots + rest + "<toy.copy_control name='c' robot='a' to='self/x' " + attributes +
                          "/>\n");
  };
  EXPECT_EQ(controller("from='robot/{robot}/odometry' from_columns='" + odometry + "'"), "no error");
  EXPECT_EQ(controller("from='robot/{robot}/pose' from_columns='" + pose + "'"),
            "world.xml:5:1: c (toy.copy_control): claims \"robot/a/pose\", which is truth; a controller knows what its "
            "robot senses: " +
                for_a_pose);
  EXPECT_EQ(controller("from='robot/b/odometry' from_columns='" + odometry + "'"),
            "world.xml:5:1: c (toy.copy_control): claims \"robot/b/odometry\", but it is bound to the robot \"a\"; "
            "expected that robot's own row, read<Odometry>(\"robot/{robot}/odometry\") in its source");
  EXPECT_EQ(controller("from='robot/*/odometry' from_columns='" + odometry + "'"),
            "world.xml:5:1: c (toy.copy_control): claims \"robot/*/odometry\", but it is bound to the robot \"a\"; "
            "expected that robot's own row, read<Odometry>(\"robot/{robot}/odometry\") in its source");
  EXPECT_EQ(controller("from='outbox/b/message' from_columns='radio:radio to:radio? payload{}'"),
            "world.xml:5:1: c (toy.copy_control): claims \"outbox/b/message\", but it is bound to the robot \"a\"; "
            "expected that robot's own row, read<Outgoing>(\"outbox/{robot}/message\") in its source");
  EXPECT_EQ(controller("from='link/*/level' from_columns='level[dBm]'"),
            "world.xml:5:1: c (toy.copy_control): claims \"link/*/level\", which is truth; a controller knows what its "
            "robot senses: " +
                for_a_level);
  EXPECT_EQ(controller("from='instance/sensor/state'"),
            "world.xml:5:1: c (toy.copy_control): claims \"instance/sensor/*/state\", which is truth; a controller "
            "knows what its robot "
            "senses: " +
                sensed);
}

TEST_F(Truth, TheStagesOfAReadingAreTruth) {
  EXPECT_EQ(
      error_of_world(
          two_robots + rest + "<toy.copy_sense name='noise' as='modify' to='robot/*/odometry' columns='" + odometry +
          "' add='1'/>\n"
          "<toy.copy_control name='c' robot='a' to='self/x' from='robot/{robot}/odometry@base' from_columns='" +
          odometry + "'/>\n"),
      "world.xml:6:1: c (toy.copy_control): claims \"robot/a/odometry@base\", which is truth; a controller reads what "
      "comes out of the last stage");
}

TEST_F(Truth, OtherQuantitiesAreSensedIfEveryWriterSaysSo) {
  const auto reads = [&](const std::string& writer) {
    return error_of_world(two_robots + writer +
                          "\n<toy.copy_control name='c' robot='a' from='robot/{robot}/v' to='self/x'/>\n");
  };
  EXPECT_EQ(reads("<toy.copy_sense name='w' to='robot/*/v' flags='4'/>"), "no error");
  EXPECT_EQ(reads("<toy.copy_sense name='w' to='robot/*/v'/>"),
            "world.xml:5:1: c (toy.copy_control): reads \"robot/*/v\", which is truth: world.xml:4:1: w "
            "(toy.copy_sense) does not write it as sensed");
  EXPECT_EQ(reads("<toy.copy_sense name='u' to='robot/b/v' flags='4'/><toy.copy_sense name='w' to='robot/a/v'/>"),
            "world.xml:5:1: c (toy.copy_control): reads \"robot/*/v\", which is truth: world.xml:4:52: w "
            "(toy.copy_sense) does not write it as sensed");
  EXPECT_EQ(reads("<toy.copy_sense name='w' to='robot/*/v' as='add'/>"),
            "world.xml:5:1: c (toy.copy_control): reads \"robot/*/v\", which is truth: world.xml:4:1: w "
            "(toy.copy_sense) does not write it as sensed");
  EXPECT_EQ(reads("<toy.copy_sense name='w' to='robot/*/v' as='add' flags='4'/>"), "no error");
}

TEST_F(Truth, WhoWritesACommandIsAControllerInAnyPhase) {
  const auto plugin = [&](const std::string& kind, const std::string& to, const std::string& from) {
    return error_of_world(two_robots + rest + "<toy.copy_" + kind + " name='c' robot='a' to='robot/{robot}/command' " +
                          "columns='" + to + "' from='" + from + "/>\n");
  };
  const std::string velocity = "v[m/s] w[rad/s]", of_pose = "robot/{robot}/pose' from_columns='" + pose + "'";
  for (const std::string kind : {"sense", "actuate", "observe"})
    EXPECT_EQ(plugin(kind, velocity, of_pose),
              "world.xml:5:1: c (toy.copy_" + kind +
                  "): claims \"robot/a/pose\", which is truth, and writes \"robot/a/command\", which makes it a "
                  "controller, whatever its phase; a controller knows what its robot senses: " +
                  for_a_pose);
  EXPECT_EQ(plugin("sense", velocity, "robot/{robot}/odometry' from_columns='" + odometry + "'"), "no error");
}

TEST_F(Truth, AControllerWithoutARobotSeesNoTruthEither) {
  EXPECT_EQ(error_of_world(two_robots + "<toy.copy_control name='c' from='robot/*/pose' from_columns='" + pose +
                           "' to='self/x'/>\n"),
            "world.xml:4:1: c (toy.copy_control): claims \"robot/*/pose\", which is truth; a controller knows what its "
            "robot senses: " +
                for_a_pose);
}

}  // namespace
}  // namespace muster
