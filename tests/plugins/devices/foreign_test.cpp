// What a robot of ROS 2 records: nav_msgs/msg/Odometry and sensor_msgs/msg/LaserScan, by the bytes that their
// definitions ask for.
#include <cmath>
#include <limits>

#include "device_worlds.hpp"
#include "mcap/writer.hpp"
#include "run_log/tables/cdr.hpp"

namespace muster::test {
namespace {

using run_log::CdrWriter;

void put_header(CdrWriter& to) {
  to.put(std::int32_t{1'700'000'000}).put(std::uint32_t{5});
  to.text("odom");
}

std::string odometry(double x, double y, double yaw, double v, double w) {
  std::string result;
  CdrWriter to(result);
  put_header(to);
  to.text("base_footprint");
  const double pose[] = {x, y, 0, 0, 0, std::sin(yaw / 2), std::cos(yaw / 2)}, twist[] = {v, 0, 0, 0, 0, w};
  const double none[36] = {};
  to.reals(pose, 7).reals(none, 36).reals(twist, 6).reals(none, 36);
  return result;
}

std::string scan(const std::vector<float>& ranges) {
  std::string result;
  CdrWriter to(result);
  put_header(to);
  for (const float value : {0.f, 6.25f, 0.0174533f, 0.f, 0.2f, 0.12f, 3.5f}) to.put(value);
  to.count(ranges.size());
  for (const float range : ranges) to.put(range);
  to.count(0);  // intensities
  return result;
}

// A bag of three messages of each, from a moment of 2023 on.
void write_bag(const std::filesystem::path& file) {
  mcap::Writer to(file, {"ros2", "libmcap 1.0"});
  const auto first = to.schema({0, "nav_msgs/msg/Odometry", "ros2msg", "# as the package has it\n"});
  const auto second = to.schema({0, "sensor_msgs/msg/LaserScan", "ros2msg", "# as the package has it\n"});
  const auto odom = to.channel({0, first, "/odom", "cdr", {{"offered_qos_profiles", ""}}});
  const auto laser = to.channel({0, second, "/scan", "cdr", {}});
  for (std::uint64_t i = 0; i < 3; ++i) {
    const std::uint64_t time = 1'700'000'000'000'000'000 + i * 100'000'000;
    const auto number = static_cast<double>(i);
    const std::string where = odometry(number, -number, 3 - number, 0.2, 0.1 * number);
    const std::string seen = scan({1.5f, 0.f, 0.05f, 3.6f, std::numeric_limits<float>::infinity()});
    to.message({odom, 0, time, time, where});
    to.message({laser, 0, time, time, seen});
  }
  to.close();
}

const std::string attributes =
    " name=\"log\" robot=\"r\" file=\"bag.mcap\" reads=\"\" topics=\"robot/{robot}/odometry=/odom "
    "scan/{robot}/message=/scan\"";

TEST(ForeignMessages, ARobotsOdometryAndScansAreRead) {
  const Folder folder;
  write_bag(folder / "bag.mcap");
  Simulation run = start_of(
      folder, "world.xml",
      world_text("<robot name=\"r\" at=\"0 0 0\"/><control.steady robot=\"r\"/><control.keep_clear robot=\"r\"/>"
                 "<device.replay" +
                     attributes + " writes=\"robot/{robot}/odometry scan/{robot}/message\"/>",
                 "0.4", "0.1"));
  for (int tick = 0; tick <= 2; ++tick) {
    if (tick > 0) run.step();
    const auto at = row<Odometry>(run, "robot/r/odometry");
    EXPECT_EQ(at.x, tick);
    EXPECT_EQ(at.y, -tick);
    EXPECT_NEAR(at.yaw, 3 - tick, 1e-12);
    EXPECT_EQ(at.v, 0.2);
    EXPECT_EQ(at.w, 0.1 * tick);
    const TableView view = run.table("scan/*/message");
    const Cells& cells = view.table->now();
    ASSERT_GE(cells.rows, 1u);
    const double* last = cells.data.data() + (cells.rows - 1) * view.table->width();
    const auto& made = *reinterpret_cast<const Scan*>(last);
    EXPECT_EQ(made.id, tick);
    EXPECT_NEAR(made.t, 0.1 * tick, 1e-9);
    EXPECT_TRUE(is_null(made.x));
    EXPECT_EQ(made.max_range, 3.5);
    const auto& bytes = *cells.blobs[static_cast<std::size_t>(made.ranges) - 1];
    ASSERT_EQ(bytes.size(), 5 * sizeof(double));
    double ranges[5];
    std::memcpy(ranges, bytes.data(), sizeof ranges);
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(ranges[0], 1.5);
    EXPECT_EQ(ranges[1], infinity) << "0: nothing came back";
    EXPECT_EQ(ranges[2], -infinity) << "nearer than the laser measures";
    EXPECT_EQ(ranges[3], infinity) << "farther";
    EXPECT_EQ(ranges[4], infinity);
  }
}

TEST(ForeignMessages, ATopicThatTheBagLacksIsNamedWithTheNearest) {
  const Folder folder;
  write_bag(folder / "bag.mcap");
  const auto told = refusal_of(
      folder, world_text("<robot name=\"r\" at=\"0 0 0\"/><device.replay robot=\"r\" file=\"bag.mcap\" reads=\"\" "
                         "writes=\"robot/{robot}/odometry\" topics=\"robot/{robot}/odometry=/odm\"/>",
                         "1"));
  EXPECT_THAT(told, testing::HasSubstr("has no /odm; expected one of /odom, /scan; did you mean \"/odom\"?"));
}

}  // namespace
}  // namespace muster::test
