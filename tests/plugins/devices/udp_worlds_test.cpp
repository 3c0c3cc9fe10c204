// The same controller drives a robot of another run over UDP. Both runs in one process, tick by tick in turn, show the
// laws exactly; in two processes, at the pace of the clock, only what holds on a computer of any speed is asked.
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>

#include "device_worlds.hpp"
#include "plugins/devices/wire.hpp"

namespace muster::test {
namespace {

using testing::HasSubstr;

constexpr double dt = 0.02;
const std::string at_once = " speed=\"1000000\"";  // no tick waits for the clock
const std::string waypoints =
    "<control.waypoint name=\"steer\" robot=\"r\" path=\"square.csv\" speed=\"0.2\" tolerance=\"0.05\"/>";

std::string model() { return burger_model().empty() ? "waffle" : burger_model(); }
std::string robot() { return "<robot name=\"r\" model=\"" + model() + "\" at=\"0 0 0\"/>"; }

int free_port() { return devices::UdpSocket({0x7f000001, 0}).at().port; }

struct Ends {
  // `host`, `device`: further attributes.
  explicit Ends(const std::string& host = "", const std::string& device = "", const std::string& until = "80")
      : port(" port=\"" + std::to_string(free_port()) + "\"") {
    folder.write("square.csv", "x[m],y[m]\n2,0\n2,2\n0,2\n0,0\n");
    robots = world_text(robot() + "<physics.planar/><host.udp name=\"host\" robot=\"r\"" + port + host + "/>", until);
    controllers =
        world_text(robot() + waypoints + "<device.udp name=\"device\" robot=\"r\"" + port + device + "/>", until);
  }
  Simulation robot_run() const { return start_of(folder, "robot.xml", robots); }
  Simulation controller_run() const { return start_of(folder, "controller.xml", controllers); }

  Folder folder;
  std::string port, robots, controllers;
};

struct Link {  // of device.udp
  double silent, age, round_trip, sent, received, lost, late, duplicate, malformed, foreign, left_out;
};
struct HostLink {
  double stopped, age, received, lost, late, duplicate, malformed, foreign;
};

double from_start(const Simulation& run) {
  const auto pose = row<Pose>(run, "robot/r/pose");
  return std::hypot(pose.x, pose.y);
}
std::string events_of(const Simulation& run) {
  std::string result;
  for (const auto& event : run.events()) result += event.message + '\n';
  return result;
}
bool are_equal(const Command& a, const Command& b) { return a.v == b.v && a.w == b.w; }

// How far from its start the robot comes to rest where it is simulated in the controller's own world.
double simulated_closing(const Ends& ends) {
  Simulation run = start_of(ends.folder, "simulated.xml", world_text(robot() + waypoints + "<physics.planar/>", "80"));
  double farthest = 0;
  while (!run.done()) run.step(), farthest = std::max(farthest, from_start(run));
  EXPECT_GT(farthest, 2.5) << "it has not driven round";
  EXPECT_EQ(row<Command>(run, "robot/r/command").v, 0) << "it is still on its way";
  return from_start(run);
}

TEST(UdpDevice, ACommandIsObeyedOneTickLaterAndNothingElseChanges) {
  const Ends ends(at_once, at_once + " wait=\"0\"");
  Simulation here = ends.controller_run(), there = ends.robot_run();
  Command sent{};
  Odometry sensed{};
  double farthest = 0;
  while (!there.done()) {
    there.step();
    const auto obeyed = row<Command>(there, "robot/r/command");
    if (there.tick() > 4) {
      EXPECT_TRUE(are_equal(obeyed, sent)) << "tick " << there.tick();
    }
    here.step();
    const auto known = row<Odometry>(here, "robot/r/odometry");
    if (there.tick() > 4) {
      EXPECT_EQ(known.x, sensed.x);
      EXPECT_EQ(known.y, sensed.y);
      EXPECT_EQ(known.yaw, sensed.yaw);
    }
    sensed = row<Odometry>(there, "robot/r/odometry");
    sent = row<Command>(here, "robot/r/command");
    farthest = std::max(farthest, from_start(there));
    if (HasFailure()) break;
  }
  EXPECT_GT(farthest, 2.5);
  EXPECT_NEAR(from_start(there), simulated_closing(ends), 0.01) << "0.2 m/s, one tick late";
  const auto link = row<Link>(here, "instance/device/link");
  EXPECT_EQ(link.silent, 0);
  EXPECT_EQ(link.lost, 0);
  EXPECT_EQ(link.late + link.duplicate + link.malformed, 0);
  EXPECT_NEAR(link.round_trip, dt, 1e-9);
}

// A fifth of the datagrams is lost, the others come up to 0.15 s late and out of order: the square closes all the same,
// within the tolerance of a way point and what a robot drives until it hears that it has reached it.
TEST(UdpDevice, ARoughNetworkWidensTheSquareByNoMoreThanItsDelays) {
  const Ends ends(at_once + " loss=\"0.2\" delay=\"0.05\" jitter=\"0.1\"", at_once + " wait=\"0\"", "100");
  Simulation here = ends.controller_run(), there = ends.robot_run();
  double farthest = 0;
  while (!there.done()) {
    there.step();
    here.step();
    farthest = std::max(farthest, from_start(there));
  }
  EXPECT_GT(farthest, 2.5);
  EXPECT_EQ(row<Command>(there, "robot/r/command").v, 0);
  EXPECT_LT(from_start(there), simulated_closing(ends) + 0.2 * 2 * (0.15 + 5 * dt));
  const auto link = row<Link>(here, "instance/device/link");
  EXPECT_GT(link.lost, 500);
  EXPECT_LT(link.lost, 1500);
  EXPECT_GT(link.late, 100);
  EXPECT_EQ(link.malformed, 0);
}

TEST(UdpHost, AWatchdogStopsTheRobotAtItsTick) {
  const Ends ends(at_once + " watchdog=\"0.51\"", at_once + " wait=\"0\"");
  Simulation here = ends.controller_run(), there = ends.robot_run();
  for (int i = 0; i < 100; ++i) there.step(), here.step();
  int driven = 0;  // ticks in which the last command goes on
  for (there.step(); row<Command>(there, "robot/r/command").v != 0 && driven < 1000; there.step()) ++driven;
  EXPECT_EQ(driven, 26) << "that of the command itself, and 0.51 s";
  EXPECT_EQ(row<HostLink>(there, "instance/host/link").stopped, 1);
  EXPECT_THAT(events_of(there), HasSubstr("stops: no command for 0.51 s"));
  here.step();
  there.step();
  EXPECT_NE(row<Command>(there, "robot/r/command").v, 0) << "a controller that speaks again drives again";
  EXPECT_THAT(events_of(there), HasSubstr("is driven by 127.0.0.1:"));
}

TEST(UdpHost, StopsWhenItsControllerLeaves) {
  const Ends ends(at_once, at_once + " wait=\"0\"");
  Simulation there = ends.robot_run();
  {
    Simulation here = ends.controller_run();
    for (int i = 0; i < 100; ++i) there.step(), here.step();
    here.close();
  }
  there.step();
  EXPECT_EQ(row<Command>(there, "robot/r/command").v, 0);
  EXPECT_THAT(events_of(there), HasSubstr("stops: its controller has left"));
}

TEST(UdpDevice, ASilentRobotIsToldAndSentZeroCommandsUntilItSpeaks) {
  const Ends ends(at_once, at_once + " wait=\"0\" deadline=\"0.3\"");
  Simulation here = ends.controller_run(), there = ends.robot_run();
  for (int i = 0; i < 100; ++i) there.step(), here.step();
  const auto before = row<Odometry>(here, "robot/r/odometry");
  for (int i = 0; i < 14; ++i) here.step();
  EXPECT_EQ(row<Link>(here, "instance/device/link").silent, 0);
  for (int i = 0; i < 10; ++i) here.step();
  EXPECT_EQ(row<Link>(here, "instance/device/link").silent, 1);
  EXPECT_EQ(row<Odometry>(here, "robot/r/odometry").x, before.x) << "what was sensed last stays";
  EXPECT_NE(row<Command>(here, "robot/r/command").v, 0) << "the controller knows nothing of it";
  EXPECT_THAT(events_of(here), HasSubstr("was not heard for 0.3 s"));
  there.step();
  EXPECT_EQ(row<Command>(there, "robot/r/command").v, 0) << "but the robot is told to rest";
  for (int i = 0; i < 3; ++i) here.step(), there.step();
  EXPECT_EQ(row<Link>(here, "instance/device/link").silent, 0);
  EXPECT_NE(row<Command>(there, "robot/r/command").v, 0);
  EXPECT_THAT(events_of(here), HasSubstr("is heard again"));
}

TEST(UdpDevice, ASilentRobotEndsTheRunWhereThatIsAskedFor) {
  const Ends ends(at_once, at_once + " wait=\"0\" on_silence=\"fail\"");
  Simulation here = ends.controller_run(), there = ends.robot_run();
  for (int i = 0; i < 50; ++i) there.step(), here.step();
  try {
    for (int i = 0; i < 100; ++i) here.step();
    ADD_FAILURE() << "it goes on";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit(), Exit::invalid_input);
    EXPECT_THAT(error.what(),
                HasSubstr("was not heard for 0.5 s; on_silence=\"stop\" or \"hold\" would go on without it"));
  }
}

TEST(UdpDevice, WhatIsWrongIsToldWithThePlaceOfTheElement) {
  const Ends ends(at_once);
  const auto refused = [&](const std::string& attributes) {
    return refusal_of(ends.folder, world_text(robot() + "\n" + waypoints + "\n<device.udp robot=\"r\"" + ends.port +
                                                  at_once + attributes + "/>",
                                              "1"));
  };
  EXPECT_THAT(refused(" wait=\"0.05\""), HasSubstr("no robot answered at 127.0.0.1:"));
  EXPECT_THAT(refused(" wait=\"0.05\""), HasSubstr("within 0.05 s; expected one to be started"));
  EXPECT_THAT(refused(" wait=\"0.05\""), HasSubstr("world.xml:3:1: "));
  EXPECT_THAT(refused(" address=\"localhost\""),
              HasSubstr("\"localhost\" is no address; expected four numbers, such as 127.0.0.1"));
  EXPECT_THAT(refused(" writes=\"\""), HasSubstr("fills no table"));
  EXPECT_THAT(refused(" reads=\"outbox/{robot}/message\""), HasSubstr("is no row; expected commands of one robot"));
}

TEST(UdpDevice, TablesThatTheRobotDoesNotGiveAreNamed) {
  const Ends ends(at_once, at_once + " wait=\"0\" writes=\"robot/{robot}/odometry robot/{robot}/position3d\"");
  Simulation here = ends.controller_run(), there = ends.robot_run();
  try {
    for (int i = 0; i < 10; ++i) there.step(), here.step();
    ADD_FAILURE() << "they agree";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("robot/{robot}/position3d"));
  }
  EXPECT_THAT(events_of(there), HasSubstr("refuses a controller: "));
}

TEST(UdpDevice, WhereNobodyIsToBeWaitedForItSaysThatItGoesByTheClock) {
  const Ends ends;
  ::setenv("MUSTER_BRIDGE", "off", 1);
  Simulation here = ends.controller_run(), there = ends.robot_run();
  here.step();
  there.step();
  ::unsetenv("MUSTER_BRIDGE");
  EXPECT_THAT(events_of(here), HasSubstr("note: "));
  EXPECT_THAT(events_of(here), HasSubstr("a run of this world goes at the pace of the clock on the wall, as with "
                                         "--real-time: the robot at 127.0.0.1:"));
  EXPECT_THAT(events_of(there), HasSubstr("as with --real-time: a controller at 127.0.0.1:"));
  EXPECT_EQ(row<Link>(here, "instance/device/link").silent, 1);
}

TEST(UdpHost, TellsNoTruth) {
  const Folder folder;
  EXPECT_THAT(refusal_of(folder, world_text("<robot name=\"r\" at=\"0 0 0\"/><physics.planar/><host.udp robot=\"r\" "
                                            "reads=\"robot/{robot}/pose\"/>",
                                            "1")),
              HasSubstr("which is truth"));
}

// Messages of the radio go to the controller, whose world has the names of their senders, and may have them in another
// order; of a sender that it does not have none is published, and all are counted.
TEST(UdpDevice, MessagesComeByTheNamesOfTheirSenders) {
  const std::string inbox = "inbox/{robot}/message";
  const Folder folder;
  const std::string port = " port=\"" + std::to_string(free_port()) + "\"" + at_once;
  Simulation there =
      start_of(folder, "robot.xml",
               world_text("<station name=\"s1\" at=\"1 0 1\"/><station name=\"s2\" at=\"2 0 1\"/>" + robot() +
                              "<physics.planar/><radio.multiwall/><network.ideal/><control.beacon name=\"b1\" "
                              "radio=\"s1\" every=\"5\"/>"
                              "<control.beacon name=\"b2\" radio=\"s2\" every=\"5\"/><host.udp robot=\"r\" reads=\"" +
                              inbox + "\"" + port + "/>",
                          "4"));
  Simulation here =
      start_of(folder, "controller.xml",
               world_text("<station name=\"other\" at=\"0 0 0\"/><station name=\"s2\" at=\"0 0 0\"/>" + robot() +
                              "<control.steady robot=\"r\"/><device.udp name=\"device\" robot=\"r\" "
                              "wait=\"0\" writes=\"" +
                              inbox + "\"" + port + "/><record table=\"inbox/*/message\"/>",
                          "4"));
  int published = 0;
  while (!there.done()) {
    there.step();
    here.step();
    const TableView view = here.table("inbox/*/message");
    const Cells& cells = view.table->now();
    for (std::size_t r = 0; r < cells.rows; ++r) {
      if (cells.appended[r] != here.tick()) continue;
      ++published;
      const auto& message = *reinterpret_cast<const Incoming*>(cells.data.data() + r * view.table->width());
      EXPECT_EQ(message.from, 1) << "s2, which is the second radio here";
      EXPECT_EQ(message.radio, 2) << "the robot's own";
    }
  }
  EXPECT_GT(published, 3);
  EXPECT_NEAR(row<Link>(here, "instance/device/link").left_out, published, 2);
}

// Another process is the robot, ten times as fast as the clock. However slow this computer is, the robot drives on an
// old command for no longer than its watchdog lets it, so that much is what the square may be wider than the simulated
// one.
TEST(UdpDevice, DrivesTheSameSquareInAnotherProcess) {
  const double fast = 10, watchdog = 0.5, speed = 0.2;
  const std::string paced = " speed=\"10\"";
  const Ends ends(paced + " watchdog=\"0.5\"", paced + " wait=\"60\"", "150");
  int pipe[2];
  ASSERT_EQ(::pipe(pipe), 0);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    double result[2] = {-1, 0};  // where it rests, and how far it was
    try {
      Simulation there = ends.robot_run();
      while (!there.done() && events_of(there).find("its controller has left") == std::string::npos)
        there.step(), result[1] = std::max(result[1], from_start(there));
      result[0] = from_start(there);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
    const bool is_told = ::write(pipe[1], result, sizeof result) == sizeof result;
    ::_exit(is_told ? 0 : 1);
  }
  double reached = 0;
  {
    Simulation here = ends.controller_run();
    // A slow computer's runs may end before the square does; the robot's ends later than this one's in any case.
    while (!here.done() && reached < 4) {
      here.step();
      reached = row<Command>(here, "instance/steer/progress").w;
    }
    here.close();
  }
  double result[2] = {-1, 0};
  ASSERT_EQ(::read(pipe[0], result, sizeof result), static_cast<ssize_t>(sizeof result));
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_EQ(status, 0);
  ASSERT_EQ(reached, 4) << "way points; the run of " << 150 / fast << " s was too short for this computer";
  EXPECT_GT(result[1], 2.5);
  EXPECT_LT(result[0], simulated_closing(ends) + speed * watchdog);
}

}  // namespace
}  // namespace muster::test
