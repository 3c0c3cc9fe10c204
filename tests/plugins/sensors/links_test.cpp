// The table of links: what was received and no more.
#include <map>

#include "sense_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

const std::string air =
    "<physics.planar/><robots.drive/><radio.multiwall l0=\"40\" n=\"2.5\"/><radio.fading shadowing=\"3\"/>"
    "<radio.receiver sensitivity=\"-62\"/><radio.rssi_steps step=\"2\" least=\"-58\"/><network.ideal/>";
const std::string three =
    "<station name=\"base\" at=\"0 0 1\"/><robot name=\"r\" at=\"2 0 0\"/><robot name=\"s\" at=\"4 3 0\"/>";

// All that has arrived, by radio and peer.
using Arrived = std::map<std::pair<double, double>, Incoming>;
void add_arrivals(const Simulation& run, Arrived& arrived) {
  const TableView queue = run.table("inbox/*/message");
  for (std::size_t i = 0; i < queue.rows(); ++i) {
    Incoming one;
    std::memcpy(&one, queue.table->now().data.data() + i * queue.cols(), sizeof one);
    Incoming& last = arrived[{one.radio, one.from}];
    if (one.t_received >= last.t_received) last = one;
  }
}

TEST(Links, AreWhatWasReceivedToTheBit) {
  Folder folder;
  Simulation run = world_of(folder, three + air +
                                        "<control.wander/><control.beacon name=\"a\" radio=\"base\" period=\"0.3\"/>"
                                        "<control.beacon name=\"b\" radio=\"s\" period=\"0.2\"/>"
                                        "<sensors.links memory=\"0.5\"/>");
  Arrived arrived;
  int fresh = 0, old = 0;
  while (run.tick() < 600) {
    run.step();
    add_arrivals(run, arrived);
    const auto rows = told_now<Heard>(run, "heard/*/peer", time_of(run));
    std::size_t at_robots = 0;
    for (const auto& [key, message] : arrived) at_robots += key.first != 0;  // the base has no robot
    ASSERT_EQ(rows.size(), at_robots);
    for (const Heard& row : rows) {
      const Incoming& last = arrived.at({row.radio, row.peer});
      EXPECT_EQ(row.robot, row.radio - 1);
      EXPECT_EQ(row.last_seen, last.t_received);
      EXPECT_TRUE(is_null(row.noise)) << "nobody states any";
      if (time_of(run) - last.t_received <= 0.5) {
        EXPECT_EQ(row.rssi, last.rssi);
        EXPECT_TRUE(row.rssi >= -58 && std::fmod(row.rssi, 2) == 0) << row.rssi;
        ++fresh;
      } else {
        EXPECT_TRUE(is_null(row.rssi));
        ++old;
      }
    }
  }
  EXPECT_GT(fresh, 1000);
  EXPECT_GT(old, 0);
}

TEST(Links, KnowNothingOfAPeerThatIsSilent) {
  Folder folder;
  Simulation run = world_of(folder, three + air + "<control.beacon radio=\"base\" period=\"0.2\"/><sensors.links/>");
  run_ticks(run, 100);
  EXPECT_EQ(run.table("link/*/ends").rows(), 6u) << "all hear each other";
  const auto rows = told_now<Heard>(run, "heard/*/peer", time_of(run));
  ASSERT_EQ(rows.size(), 2u);
  for (const Heard& row : rows) EXPECT_EQ(row.peer, 0);
}

TEST(Links, ReadNoChannel) {
  Folder folder;
  Simulation run = world_of(folder, three + air + "<control.beacon radio=\"base\"/><sensors.links name=\"l\"/>");
  int seen = 0;
  for (const auto& instance : run.instances()) {
    if (instance->name() != "l") continue;
    ++seen;
    EXPECT_FALSE(instance->claims().empty());
    for (const auto& claim : instance->claims()) {
      EXPECT_NE(claim.name.set, "link");
      EXPECT_NE(claim.name.set, "endpoint");
      EXPECT_NE(claim.name.quantity, "pose");
    }
  }
  EXPECT_EQ(seen, 1);
}

TEST(Links, SmoothAsDriversDo) {
  Folder folder;
  Simulation run = world_of(folder, three + air +
                                        "<control.wander/><control.beacon radio=\"base\" period=\"0.05\"/>"
                                        "<sensors.links smoothing=\"0.75\"/>");
  double expected = null(), seen = -1;
  for (int i = 0; i < 200; ++i) {
    run.step();
    Arrived arrived;
    add_arrivals(run, arrived);
    const auto found = arrived.find({1, 0});
    if (found != arrived.end() && found->second.t_received > seen) {
      seen = found->second.t_received;
      const double rssi = found->second.rssi;
      expected = is_null(expected) ? rssi : 0.75 * expected + 0.25 * rssi;
    }
    for (const Heard& row : told_now<Heard>(run, "heard/*/peer", time_of(run)))
      if (row.radio == 1) {
        EXPECT_EQ(row.rssi, expected);
      }
  }
  EXPECT_FALSE(is_null(expected));
}

// -40 dBm at 1 m, 2 m away, 10 dB more than messages over 10 MHz, half of them in the band, a quarter of the time.
TEST(Links, TellTheNoiseOfAJammerInTheirBand) {
  Folder folder;
  const std::string still =
      "<station name=\"base\" at=\"1 0 0\"/><station name=\"jam\" at=\"0 2 0\"/><robot name=\"r\" at=\"0 0 0\"/>"
      "<physics.planar/><radio.multiwall l0=\"40\" n=\"2\"/><network.ideal/><control.beacon radio=\"base\"/>"
      "<radio.jammer radio=\"jam\" excess=\"10\" frequency=\"2.44e9\" bandwidth=\"10e6\" period=\"0.01\" "
      "duty=\"0.25\"/>";
  const auto noise = [&](const std::string& attributes) {
    Simulation run = world_of(folder, still + "<sensors.links " + attributes + "/>");
    run_ticks(run, 100);
    const auto rows = told_now<Heard>(run, "heard/*/peer", time_of(run));
    return rows.empty() ? 0 : rows[0].noise;
  };
  const double jamming = -40 + 10 - 20 * std::log10(2.0) + 10 * std::log10(0.5 * 0.25);
  EXPECT_NEAR(noise("jammers=\"true\" noise_step=\"0\""), jamming, 1e-9);
  EXPECT_EQ(noise("jammers=\"true\""), std::round(jamming));
  EXPECT_NEAR(noise("jammers=\"true\" noise=\"-40\" noise_step=\"0\""),
              10 * std::log10(std::pow(10, jamming / 10) + 1e-4), 1e-9);
  EXPECT_EQ(noise("noise=\"-95.2\""), -95);
  EXPECT_TRUE(is_null(noise("jammers=\"true\" frequency=\"2.48e9\""))) << "in another band";
  EXPECT_TRUE(is_null(noise("")));
}

TEST(Links, SteerARobot) {
  Folder folder;
  const std::string inside =
      "<station name=\"base\" at=\"0 0 0\"/><robot name=\"r\" at=\"1 0 0\"/><physics.planar/><robots.drive/>"
      "<radio.multiwall l0=\"40\" n=\"2\"/><network.ideal/><control.beacon radio=\"base\" period=\"0.05\"/>"
      "<test.homing robot=\"r\" base=\"base\" least=\"-60\"/>";
  folder.write("world.xml", "<world name=\"test\" dt=\"0.05\" until=\"90\" seed=\"1\">" + inside + "</world>");
  auto with = options();
  with.search_path.push_back(MUSTER_ACTORS_DIR);
  Simulation run(read_world(folder / "world.xml", standard()), standard(), with);
  while (!run.done()) run.step();
  // -60 dBm is 10 m from the base. It waits there, and never sees where it is.
  EXPECT_NEAR(row<Pose>(run, "robot/r/pose").x, 10, 0.1);
}

TEST(Links, AreTheSameRun) {
  Folder folder;
  expect_one_run(
      [&] {
        return world_in(folder, three + air +
                                    "<control.wander/><control.beacon radio=\"base\" period=\"0.2\"/>"
                                    "<sensors.links name=\"l\" smoothing=\"0.5\" period=\"0.15\" jammers=\"true\"/>");
      },
      "l");
}

TEST(Links, ForgetAPeerThatIsGone) {
  Folder folder;
  Simulation run =
      world_of(folder, three + air + "<control.beacon radio=\"base\" period=\"0.6\"/><sensors.links forget=\"0.3\"/>");
  for (const auto& [until, is_known] : {std::pair{15u, true}, {20u, false}, {25u, true}}) {
    while (run.tick() < until) run.step();
    EXPECT_NE(told_now<Heard>(run, "heard/*/peer", time_of(run)).empty(), is_known) << until;
  }
}

}  // namespace
