// The controllers of worlds/connectivity know what was received, and nothing of the channel.
#include <set>

#include "chain.hpp"
#include "text/number.hpp"

namespace {

using namespace muster;
using namespace muster::test;

template <class Row>
std::string refusal(const std::string& table) {
  Folder folder;
  try {
    world_of(folder,
             "<robot name=\"a\" at=\"0 0 0\"/><robot name=\"b\" at=\"1 0 0\"/>\n<test.peeker robot=\"a\" table=\"" +
                 table + "\" columns=\"" + Row::columns + "\"/>");
  } catch (const Error& e) {
    const std::string what = e.what();
    return what.substr(what.rfind("world.xml"));
  }
  return "not refused";
}

TEST(Blind, AControllerThatClaimsTruthIsRefused) {
  EXPECT_EQ(refusal<Pose>("robot/a/pose"),
            "world.xml:2:1: test.peeker (test.peeker): claims \"robot/a/pose\", which is truth; a controller knows "
            "what its robot senses: "
            "expected in its place read<Odometry>(\"robot/{robot}/odometry\"), or "
            "read<Position3d>(\"robot/{robot}/position3d\") of what flies; or another of robot/command, "
            "robot/car_command, robot/goal2d, robot/odometry, robot/odometry_reset, "
            "robot/stall, robot/geometry, robot/attitude_thrust, robot/velocity3d, robot/position3d, robot/imu, "
            "robot/gps, scan/message, heard/peer, range/message, image/message, outbox/message, inbox/message");
}

TEST(Blind, AndSoIsOneThatReadsAnotherRobot) {
  EXPECT_EQ(refusal<Odometry>("robot/b/odometry"),
            "world.xml:2:1: test.peeker (test.peeker): claims \"robot/b/odometry\", but it is bound to the robot "
            "\"a\"; expected that "
            "robot's own row, read<Odometry>(\"robot/{robot}/odometry\") in its source");
}

TEST(Blind, OursClaimTheirOwnRobotAlone) {
  const Simulation run(connectivity(), standard(), options());
  int seen = 0;
  for (const auto& instance : run.instances()) {
    if (instance->declared().plugin != "control.connectivity") continue;
    ++seen;
    const std::string robot = run.board().find_set("robot")->names[static_cast<std::size_t>(instance->bound_row())];
    std::set<std::string> claimed;
    for (const Claim& claim : instance->claims()) {
      if (!claim.file) claimed.insert(claim.name.set + '/' + claim.name.row + '/' + claim.name.quantity);
    }
    EXPECT_EQ(claimed, (std::set<std::string>{"robot/" + robot + "/odometry", "robot/" + robot + "/command",
                                              "inbox/" + robot + "/message", "outbox/" + robot + "/message",
                                              "instance/" + instance->name() + "/*/state"}));
  }
  EXPECT_EQ(seen, 3);
}

// The same controllers, from the same library and with the same attributes, in another channel.
TEST(Blind, AnotherRadioModelNeedsNoOtherController) {
  World world = connectivity();
  auto& radio = instance_of(world, "radio.multiwall");
  radio.plugin = "test.slope";
  radio.attributes.clear();
  set(radio, "slope", "2");
  Simulation run(std::move(world), standard(), options());
  run_until(run, 500);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(chain_of(run)[i].rssi, -60, 1) << i;
    EXPECT_NEAR(chain_of(run)[i].distance, 15, 0.5) << i << ": where -30 dBm - 2 dB/m is -60 dBm, walls or not";
  }
}

std::vector<double> commands(const Simulation& run) {
  const Cells& cells = run.table("robot/*/command").table->now();
  return cells.data;
}

// A world without any radio, whose inboxes are filled from what another run received, drives the robots the same, bit
// for bit.
TEST(Blind, AForgedInboxDrivesThemTheSame) {
  constexpr int ticks = 3000;
  std::vector<std::vector<double>> real;
  std::string messages = "t[s],radio,from,rssi[dBm]\n";
  {
    Simulation run(connectivity(), standard(), options());
    const auto& names = run.board().find_set("radio")->names;
    for (int tick = 0; tick < ticks; ++tick) {
      run.step();
      real.push_back(commands(run));
      const Table& inbox = *run.table("inbox/*/message").table;
      for (std::size_t r = 0; r < inbox.now().rows; ++r) {
        if (inbox.now().appended[r] != run.tick()) continue;
        const auto* m = reinterpret_cast<const Incoming*>(&inbox.now().data[r * inbox.width()]);
        messages += print_real(m->t_received) + ',' + names[static_cast<std::size_t>(m->radio)] + ',' +
                    names[static_cast<std::size_t>(m->from)] + ',' + print_real(m->rssi) + '\n';
      }
    }
  }
  Folder folder;
  const auto file = folder.write("messages.csv", messages);
  World world = connectivity();
  std::erase_if(world.instances, [](const InstanceDeclaration& i) {
    return i.plugin == "radio.multiwall" || i.plugin == "observe.chain" || i.plugin == "control.beacon";
  });
  InstanceDeclaration forger{"test.forger", "forger", 1, {}, {}, {}, {"test"}};
  set(forger, "messages", file);
  world.instances.push_back(forger);
  Simulation run(std::move(world), standard(), options());
  EXPECT_EQ(run.board().find("link/*/level"), nullptr) << "there is no channel";
  for (int tick = 0; tick < ticks; ++tick) {
    run.step();
    ASSERT_EQ(commands(run), real[static_cast<std::size_t>(tick)]) << tick;
  }
  EXPECT_GT(row<Pose>(run, "robot/leader/pose").x, 25) << "and they did drive";
}

}  // namespace
