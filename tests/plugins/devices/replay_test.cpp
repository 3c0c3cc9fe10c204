// A controller on the log of its own run gives the same commands to the last bit.
#include <map>

#include "device_worlds.hpp"
#include "mcap/scan.hpp"
#include "mcap/writer.hpp"
#include "run_log/wide_table.hpp"

namespace muster::test {
namespace {

using testing::HasSubstr;

const std::string square = "x[m],y[m]\n1,0\n1,1\n0,1\n0,0\n";
const std::string records =
    "<record table=\"robot/*/odometry\"/><record table=\"robot/*/stall\"/><record table=\"robot/*/command\"/>";

std::string robot(const std::string& model) { return "<robot name=\"r\" model=\"" + model + "\" at=\"0 0 0\"/>"; }

const std::string steered =
    "<control.waypoint name=\"steer\" robot=\"r\" path=\"square.csv\" speed=\"0.2\" tolerance=\"0.02\"/>";

// A run of this robot with noisy odometry, into run.mcap; its last command.
Command logged(const Folder& folder, const std::string& model, const std::string& until = "30") {
  folder.write("square.csv", square);
  Simulation run = start_of(
      folder, "simulated.xml",
      world_text(robot(model) + "<physics.planar/><robots.odometry noise=\"0.02\"/>" + steered + records, until));
  log_run(run, folder / "run.mcap");
  return row<Command>(run, "robot/r/command");
}

struct Compared {
  double ticks, differing, since, most;
};

class Replayed : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Devices, Replayed, testing::Values("scarab", "waffle", "burger"));

TEST_P(Replayed, GivesTheCommandsOfItsOwnRunToTheLastBit) {
  const Folder folder;
  const std::string model = std::string(GetParam()) == "burger" ? burger_model() : GetParam();
  if (model.empty()) GTEST_SKIP() << "the Burger's URDF is not here";
  const Command there = logged(folder, model);
  run_log::write_wide(folder / "run.mcap", folder / "run.csv", {});
  for (const char* file : {"run.mcap", "run.csv"}) {
    Simulation run = start_of(
        folder, "replayed.xml",
        world_text(robot(model) + steered + "<device.replay name=\"log\" robot=\"r\" file=\"" + file + "\"/>", "30"));
    while (!run.done()) run.step();
    const auto compared = row<Compared>(run, "instance/log/compared_command");
    EXPECT_EQ(compared.ticks, 1500) << file;
    EXPECT_EQ(compared.differing, 0) << file;
    EXPECT_EQ(compared.most, 0) << file;
    const auto here = row<Command>(run, "robot/r/command");
    EXPECT_EQ(here.v, there.v);
    EXPECT_EQ(here.w, there.w);
    EXPECT_THAT(run.events().back().message, HasSubstr("1500 of 1500 commands are those of the log"));
  }
}

TEST(DeviceReplay, AnotherControllerIsToldWhereItDiffers) {
  const Folder folder;
  logged(folder, "scarab", "4");
  const std::string slower = "<control.waypoint robot=\"r\" path=\"square.csv\" speed=\"0.15\" tolerance=\"0.02\"/>";
  Simulation run = start_of(
      folder, "replayed.xml",
      world_text(robot("scarab") + slower + "<device.replay name=\"log\" robot=\"r\" file=\"run.mcap\"/>", "4"));
  while (!run.done()) run.step();
  const auto compared = row<Compared>(run, "instance/log/compared_command");
  EXPECT_EQ(compared.ticks, 200);
  EXPECT_EQ(compared.differing, 200);
  EXPECT_EQ(compared.since, 0.02);
  EXPECT_NEAR(compared.most, 0.05, 1e-3);  // at full speed; the cosine of the bearing makes both smaller
  EXPECT_THAT(run.events().front().message,
              HasSubstr("robot/r/command is not what the log has: v[m/s] 0.15 here, 0.2 there"));
}

// Every tenth tick is in the log: a sample stays until the next one, and its age says so.
TEST(DeviceReplay, TakesTheLatestSampleAndTellsItsAge) {
  const Folder folder;
  folder.write("log.csv",
               "t[s],robot/r/odometry/x[m],robot/r/odometry/y[m],robot/r/odometry/yaw[rad],robot/r/odometry/v[m/s],"
               "robot/r/odometry/w[rad/s]\n0.1,1,0,0,0,0\n0.2,,,,,\n0.3,2,0,0,0,0\n2,3,0,0,0,0\n");
  Simulation run = start_of(
      folder, "world.xml",
      world_text(robot("scarab") + "<control.steady robot=\"r\" v=\"0.1\"/><device.replay name=\"log\" "
                                   "robot=\"r\" file=\"log.csv\" writes=\"robot/{robot}/odometry\" reads=\"\"/>",
                 "4", "0.1"));
  std::vector<double> places, ages;
  while (!run.done()) {
    run.step();
    places.push_back(row<Odometry>(run, "robot/r/odometry").x);
    ages.push_back(row<Stall>(run, "instance/log/age").stalled);
  }
  EXPECT_EQ(places[0], 1);
  EXPECT_EQ(places[1], 1) << "an empty row is no sample";
  EXPECT_EQ(places[2], 2);
  EXPECT_EQ(places[18], 2) << "nothing is interpolated";
  EXPECT_EQ(places[19], 3);
  EXPECT_EQ(places.back(), 3);
  EXPECT_EQ(ages[0], 0);
  EXPECT_NEAR(ages[1], 0.1, 1e-9);
  EXPECT_NEAR(ages[18], 1.6, 1e-9);
  std::string told;
  for (const auto& event : run.events()) told += event.message + '\n';
  EXPECT_THAT(told, HasSubstr("robot/r/odometry has no sample in the log before 0.1 s: it has its initial values"));
  EXPECT_THAT(told, HasSubstr("robot/r/odometry has a gap in the log: no sample from 0.3 s to 2 s"));
}

// A laser's scans are messages with bytes: a stage that brakes before a wall does so on the log as it did in the run.
TEST(DeviceReplay, ScansComeBackToTheLastBit) {
  const Folder folder;
  const std::string inside =
      robot("scarab") + "<control.steady robot=\"r\" v=\"0.5\"/><control.keep_clear robot=\"r\" clearance=\"0.4\"/>";
  Simulation simulated = start_of(
      folder, "simulated.xml",
      world_text("<material name=\"brick\" loss=\"6\"/><wall name=\"w\" from=\"3 -2\" to=\"3 2\" material=\"brick\"/>" +
                     inside + "<physics.planar/>" + records + "<record table=\"scan/*/message\"/>",
                 "10"));
  log_run(simulated, folder / "run.mcap");
  ASSERT_LT(row<Command>(simulated, "robot/r/command").v, 0.1) << "the wall has not stopped it";
  Simulation run = start_of(folder, "replayed.xml",
                            world_text(inside + "<device.replay name=\"log\" robot=\"r\" file=\"run.mcap\" "
                                                "writes=\"robot/{robot}/odometry scan/{robot}/message\"/>",
                                       "10"));
  while (!run.done()) run.step();
  const auto compared = row<Compared>(run, "instance/log/compared_command");
  EXPECT_EQ(compared.ticks, 500);
  EXPECT_EQ(compared.differing, 0);
}

// A program of ROS 2 that records a topic anew keeps its definition, and none of muster's metadata; its clock is the
// computer's.
TEST(DeviceReplay, ReadsWhatAnotherProgramHasRecordedOfTheSameTopics) {
  struct Copy : mcap::Visitor {
    explicit Copy(const std::filesystem::path& file) : to(file, {"ros2", "libmcap 1.0"}) {}
    void schema(const mcap::Schema& schema) override { schemas[schema.id] = to.schema(schema); }
    void channel(const mcap::Channel& channel) override {
      channels[channel.id] = to.channel({0, schemas[channel.schema], channel.topic, channel.encoding, {}});
    }
    void message(const mcap::Message& m, const std::string&) override {
      constexpr std::uint64_t epoch = 1'700'000'000'000'000'000;
      to.message({channels[m.channel], m.sequence, epoch + m.log_time, epoch + m.log_time, m.data});
    }
    mcap::Writer to;
    std::map<std::uint16_t, std::uint16_t> schemas, channels;
  };
  const Folder folder;
  logged(folder, "scarab", "10");
  Copy copy(folder / "bag.mcap");
  mcap::scan(folder / "run.mcap", copy, mcap::Damage::refused);
  copy.to.close();
  Simulation run = start_of(
      folder, "replayed.xml",
      world_text(robot("scarab") + steered + "<device.replay name=\"log\" robot=\"r\" file=\"bag.mcap\"/>", "10"));
  while (!run.done()) run.step();
  EXPECT_EQ(row<Compared>(run, "instance/log/compared_command").ticks, 500);
  EXPECT_EQ(row<Compared>(run, "instance/log/compared_command").differing, 0);
}

TEST(DeviceReplay, MadeAgainInMidRunItGoesOnAsBefore) {
  const Folder folder;
  logged(folder, "scarab", "10");
  const auto text =
      world_text(robot("scarab") + steered + "<device.replay name=\"log\" robot=\"r\" file=\"run.mcap\"/>", "10");
  Simulation straight = start_of(folder, "replayed.xml", text), remade = start_of(folder, "replayed.xml", text);
  while (!straight.done()) straight.step();
  while (!remade.done()) {
    if (remade.tick() == 123) remade.remake("log");
    remade.step();
  }
  EXPECT_EQ(straight.digest(), remade.digest());
}

TEST(DeviceReplay, WhatIsWrongIsToldWithThePlaceOfTheElement) {
  const Folder folder;
  logged(folder, "scarab", "1");
  const auto refused = [&](const std::string& attributes) {
    return refusal_of(folder, world_text(robot("scarab") + "\n" + steered +
                                             "\n<device.replay name=\"log\" robot=\"r\" " + attributes + "/>",
                                         "1"));
  };
  EXPECT_THAT(refused(""), HasSubstr("world.xml:3:1: "));
  EXPECT_THAT(refused(""), HasSubstr("has no attribute \"file\", which it needs"));
  EXPECT_THAT(refused("file=\"no.mcap\""), HasSubstr("no.mcap\" is not there; expected an MCAP file"));
  EXPECT_THAT(refused("file=\"run.mcap\" logged_as=\"rr\""),
              HasSubstr("run.mcap\" has no robot/rr/odometry; expected one of "));
  EXPECT_THAT(refused("file=\"run.mcap\" logged_as=\"rr\""), HasSubstr("did you mean \"robot/r/odometry\"?"));
  EXPECT_THAT(
      refused("file=\"run.mcap\" writes=\"robot/*/odometry\""),
      HasSubstr("\"robot/*/odometry\" has all rows; expected those of one robot, such as robot/{robot}/odometry"));
  EXPECT_THAT(refused("file=\"run.mcap\" writes=\"\""), HasSubstr("fills no table"));
  EXPECT_THAT(
      refused("file=\"run.mcap\" topics=\"robot/r/odometry\""),
      HasSubstr("\"robot/r/odometry\" is no pair; expected TABLE=/TOPIC, such as robot/{robot}/odometry=/odom"));
  EXPECT_THAT(refused("file=\"square.csv\""), HasSubstr("square.csv"));
  folder.write("scans.csv", "t[s],x\n0,1\n");
  EXPECT_THAT(refused("file=\"scans.csv\" writes=\"scan/{robot}/message\" reads=\"\""),
              HasSubstr("is a CSV file, which has no scan/r/message: messages have bytes; expected the MCAP file"));
  const std::string whole = folder.read("run.mcap");
  folder.write("cut.mcap", whole.substr(0, whole.size() / 2));
  EXPECT_THAT(refused("file=\"cut.mcap\""), HasSubstr("cut.mcap"));
}

// What had been scanned before `begin` came in the first tick, all at once.
TEST(DeviceReplay, ScansBeforeItsBeginningAreLeftOut) {
  const Folder folder;
  const std::string inside =
      robot("scarab") + "<control.steady robot=\"r\" v=\"0.1\"/><control.keep_clear robot=\"r\" clearance=\"0.4\"/>";
  Simulation simulated =
      start_of(folder, "simulated.xml",
               world_text(inside + "<physics.planar/>" + records + "<record table=\"scan/*/message\"/>", "6"));
  log_run(simulated, folder / "run.mcap");
  Simulation run = start_of(folder, "replayed.xml",
                            world_text(inside + "<device.replay robot=\"r\" file=\"run.mcap\" begin=\"5\" reads=\"\" "
                                                "writes=\"robot/{robot}/odometry scan/{robot}/message\"/>",
                                       "1"));
  const auto scans = [&] { return run.table("scan/*/message").rows(); };
  std::size_t most = scans(), seen = 0;
  while (!run.done()) {
    run.step();
    most = std::max(most, scans());
    seen += scans();
  }
  EXPECT_LE(most, 5u) << "those of the ticks that a queue keeps";
  EXPECT_GT(seen, 3u);
}

}  // namespace
}  // namespace muster::test
