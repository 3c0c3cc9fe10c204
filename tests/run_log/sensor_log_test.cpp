// Scans and pictures of a log, as others read them.
#include "run_log/sensor_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <muster/sets.hpp>

#include "run_log/tables/cdr.hpp"
#include "tests/folder.hpp"

namespace muster::test {
namespace {

struct Kept : mcap::Sink {
  std::uint16_t schema(mcap::Schema made) override {
    schemas.push_back(made);
    return static_cast<std::uint16_t>(schemas.size());
  }
  std::uint16_t channel(mcap::Channel made) override {
    channels.push_back(made);
    return static_cast<std::uint16_t>(channels.size());
  }
  void message(const mcap::Message& message) override {
    const mcap::Channel& of = channels[message.channel - 1u];
    by_topic[of.topic].push_back(std::string(message.data));
    types[of.topic] = schemas[of.schema - 1u].name;
  }
  std::vector<mcap::Schema> schemas;
  std::vector<mcap::Channel> channels;
  std::map<std::string, std::vector<std::string>> by_topic;
  std::map<std::string, std::string> types;
};

TEST(SensorLog, HasScansAndPicturesAsTheirMessages) {
  const Folder folder;
  Simulation run(read_world(folder.write("world.xml",
                                         "<world dt='0.05' until='5'><material name='brick' loss='4'/><wall name='w' "
                                         "from='2 -4' to='2 4' material='brick'/><robot name='r' at='0 0 0'/>"
                                         "<physics.planar through_walls='true'/><sensors.laser/><sensors.camera "
                                         "robot='r' width='32' height='24' z='1'/></world>"),
                            standard()),
                 standard(), {{MUSTER_PLUGINS_DIR}, 1, {}});
  Kept kept;
  run_log::SensorLog log(kept);
  log.write(run);
  for (int i = 0; i < 20; ++i) run.step(), log.write(run);
  EXPECT_THAT(kept.types, testing::UnorderedElementsAre(testing::Pair("/r/laser0/scan", "sensor_msgs/msg/LaserScan"),
                                                        testing::Pair("/tf_static", "tf2_msgs/msg/TFMessage"),
                                                        testing::Pair("/r/camera0/depth", "sensor_msgs/msg/Image"),
                                                        testing::Pair("/r/camera0/colour", "sensor_msgs/msg/Image")));
  EXPECT_EQ(kept.by_topic["/r/laser0/scan"].size(), 11u);  // 10 Hz, from the start
  EXPECT_EQ(kept.by_topic["/tf_static"].size(), 1u);
  run_log::CdrReader scan(kept.by_topic["/r/laser0/scan"].back());
  EXPECT_EQ(scan.number<std::int32_t>(), 1);
  EXPECT_EQ(scan.number<std::uint32_t>(), 0u);
  EXPECT_EQ(scan.text(), "r/laser0");
  const float least = scan.number<float>(), most = scan.number<float>(), step = scan.number<float>();
  for (int i = 0; i < 4; ++i) scan.number<float>();
  const std::uint32_t rays = scan.count();
  EXPECT_EQ(rays, 683u);
  EXPECT_NEAR(most, least + step * static_cast<float>(rays - 1), 1e-5);
  std::vector<float> ranges;
  for (std::uint32_t i = 0; i < rays; ++i) ranges.push_back(scan.number<float>());
  EXPECT_EQ(scan.count(), 0u);
  EXPECT_NEAR(ranges[rays / 2], 1.95, 0.1);  // from where the laser is on the robot
  run_log::CdrReader mounted(kept.by_topic["/tf_static"].front());
  EXPECT_EQ(mounted.count(), 1u);
  mounted.number<std::int32_t>(), mounted.number<std::uint32_t>();
  EXPECT_EQ(mounted.text(), "r");
  EXPECT_EQ(mounted.text(), "r/laser0");
  const Scan of_table = *reinterpret_cast<const Scan*>(run.table("scan/*/message").table->now().data.data());
  for (const double wanted :
       {of_table.at_x, of_table.at_y, of_table.at_z, of_table.qx, of_table.qy, of_table.qz, of_table.qw})
    EXPECT_EQ(mounted.real(), wanted);
  EXPECT_EQ(of_table.qw, 1);
  run_log::CdrReader depth(kept.by_topic["/r/camera0/depth"].back());
  depth.number<std::int32_t>(), depth.number<std::uint32_t>();
  EXPECT_EQ(depth.text(), "r/camera0");
  EXPECT_EQ(depth.number<std::uint32_t>(), 24u);
  EXPECT_EQ(depth.number<std::uint32_t>(), 32u);
  EXPECT_EQ(depth.text(), "32FC1");
  EXPECT_EQ(depth.number<std::uint8_t>(), 0);
  EXPECT_EQ(depth.number<std::uint32_t>(), 128u);
  EXPECT_EQ(depth.count(), 24u * 128u);
}

}  // namespace
}  // namespace muster::test
