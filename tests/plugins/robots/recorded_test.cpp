// Recorded commands drive a robot once more as it was driven.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robot_world.hpp"
#include "text/error.hpp"
#include "text/number.hpp"

namespace {

using namespace muster;
using namespace muster::test;
using testing::HasSubstr;

constexpr const char* header = "dt=\"0.02\" until=\"8\" seed=\"4\"";

TEST(RecordedCommands, MakeTheSameRunAgain) {
  Folder folder;
  const std::string robot =
      "<robot name=\"r\" model=\"scarab\" at=\"1 2 0\" heading=\"0.5\"/><physics.planar/><robots.drive/>";
  Simulation first = world_of(folder, robot + "<control.wander/>", {}, header);
  std::string log = "robot,t[s],w[rad/s],v[m/s],note\n";
  while (!first.done()) {
    first.step();
    const auto command = row<Command>(first, "robot/r/command");
    log += "r," + print_real(first.time()) + ',' + print_real(command.w) + ',' + print_real(command.v) + ",x\n";
  }
  Simulation again =
      world_of(folder, robot + "<control.recorded robot=\"r\" file=\"log.csv\"/>", {{"log.csv", log}}, header);
  while (!again.done()) again.step();
  const auto a = row<Pose>(first, "robot/r/pose"), b = row<Pose>(again, "robot/r/pose");
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
  EXPECT_EQ(a.qz, b.qz);
  EXPECT_NE(a.x, 1);
}

// Rest before the first; each holds until the next, the last for ever.
TEST(RecordedCommands, HoldUntilTheNext) {
  Folder folder;
  Simulation run = world_of(folder,
                            "<robot name=\"r\" model=\"scarab\" at=\"0 0 0\"/><physics.planar/><robots.drive/>"
                            "<control.recorded robot=\"r\" file=\"log.csv\"/>",
                            {{"log.csv", "t[s],robot,v[m/s],w[rad/s]\n0.1,r,0.2,0\n0.3,r,0.1,1\n"}}, header);
  while (!run.done()) {
    run.step();
    const auto command = row<Command>(run, "robot/r/command");
    const double t = run.time();
    EXPECT_EQ(command.v, t < 0.0999 ? 0 : t < 0.2999 ? 0.2 : 0.1) << t;
    EXPECT_EQ(command.w, t < 0.2999 ? 0 : 1) << t;
  }
}

TEST(RecordedCommands, SayWhatIsWrongWithTheirFile) {
  Folder folder;
  const auto fault = [&](const std::string& text) -> std::string {
    try {
      Simulation run =
          world_of(folder,
                   "<robot name=\"r\" model=\"scarab\" at=\"0 0 0\"/><robot name=\"q\" model=\"scarab\" at=\"3 0 0\"/>"
                   "<physics.planar/><robots.drive/><control.recorded robot=\"r\" file=\"log.csv\"/>",
                   {{"log.csv", text}}, header);
      run.step();
    } catch (const Error& error) {
      return folder.inside(error.what());
    }
    return "no error";
  };
  EXPECT_THAT(fault("t[s],robot,v[m/s],w[rad/s]\n0,q,0.2,0\n"), HasSubstr("no command of robot 'r'"));
  EXPECT_THAT(fault("t[s],robot,v[m/s],w[rad/s]\n1,r,0.2,0\n0.5,r,0.1,1\n"),
              HasSubstr("log.csv:3:1: time does not rise"));
  EXPECT_THAT(fault("t[s],robot,v[m/s]\n1,r,0.2\n"), HasSubstr("w[rad/s]"));
}

}  // namespace
