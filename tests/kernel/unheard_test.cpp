// What a plugin writes and nobody reads, or reads too early.
#include "toy_world.hpp"

namespace muster {
namespace {

using testing::ElementsAre;
using Unheard = ToyWorld;

const std::string drive = two_robots + "<toy.copy_physics name='d' from='robot/*/command' columns='" +
                          Command::columns + "' to='robot/*/moved' read_flags='1'/>\n";

// A command under the name that ROS has for it, or misspelt, beside a message that is heard.
TEST_F(Unheard, ACommandUnderAnotherNameIsWarnedAbout) {
  const auto of = [&](const std::string& name, const std::string& columns, const std::string& more = "") {
    const std::string heard = "<toy.listen_network name='net'/>\n";
    return messages(run(drive + heard + "<toy.copy_control name='c' robot='a' to='robot/{robot}/" + name +
                        "' columns='" + columns + "'/>\n<toy.send_control name='s' robot='a' " +
                        "to='outbox/{robot}/message'/>\n" + more));
  };
  const auto told = [&](const std::string& name, const std::string& rest) {
    return ElementsAre("0 : warning: " + (folder / "world.xml").string() +
                       ":6:1: c (toy.copy_control): writes \"robot/a/" + name + "\", which nobody reads" + rest);
  };
  const std::string command = "; did you mean robot/{robot}/command, which toy.copy_physics reads?";
  EXPECT_THAT(of("cmd_vel", "v[m/s] w[rad/s]"), told("cmd_vel", command));
  EXPECT_THAT(of("cmd_vel", "x y z"), told("cmd_vel", command));
  EXPECT_THAT(of("comand", "x y z"), told("comand", command));
  EXPECT_THAT(of("steering", Command::columns), told("steering", command));
  EXPECT_THAT(of("mood", "value"), told("mood",
                                        ", so that it has no effect; expected a table that somebody reads, or <record "
                                        "table=\"robot/*/mood\"/>"));
  EXPECT_THAT(of("mood", "value", "<record table='robot/*/mood'/>\n"), ElementsAre());
  EXPECT_THAT(of("cmd_vel", "x y z", "<toy.copy_sense from='robot/*/cmd_vel' columns='x y z' to='self/x'/>\n"),
              ElementsAre());
}

TEST_F(Unheard, ACommandThatComesATickLateIsWarnedAbout) {
  const auto of = [&](const std::string& phase) {
    return messages(run(drive + "<toy.copy_" + phase + " name='c' robot='a' to='robot/{robot}/command' columns='" +
                        Command::columns + "'/>\n"));
  };
  EXPECT_THAT(of("sense"),
              ElementsAre("0 : warning: " + (folder / "world.xml").string() +
                          ":5:1: c (toy.copy_sense): writes \"robot/a/command\" in the phase SENSE, when " +
                          (folder / "world.xml").string() +
                          ":4:1: d (toy.copy_physics) has read it already, so that it acts a tick late; expected phase "
                          "= MUSTER_CONTROL in the source of toy.copy_sense"));
  EXPECT_THAT(of("control"), ElementsAre());
  EXPECT_THAT(of("actuate"), ElementsAre());
}

}  // namespace
}  // namespace muster
