#include "run_log/sensor_log.hpp"

#include <cmath>
#include <cstring>
#include <muster/senses.hpp>
#include <muster/tables.hpp>
#include <vector>

#include "run_log/table_log.hpp"
#include "run_log/tables/cdr.hpp"

namespace muster::run_log {
namespace {

void put_header(CdrWriter& to, std::uint64_t now, const std::string& frame) {
  to.put(static_cast<std::int32_t>(now / 1'000'000'000)).put(static_cast<std::uint32_t>(now % 1'000'000'000));
  to.text(frame);
}

// Calls `visit(row, robot's name, bytes of a column)` for the messages of the last tick.
template <class Row, class Visit>
void each_new(const Simulation& run, const std::string& queue, const Visit& visit) {
  const Table* table = run.board().find(queue);
  if (!table) return;
  const Cells& cells = table->now();
  for (std::size_t i = 0; i < cells.rows; ++i) {
    if (cells.appended[i] != run.tick()) continue;
    Row row;
    std::memcpy(&row, cells.data.data() + i * table->width(), sizeof row);
    static const std::vector<std::uint8_t> none;
    const auto bytes = [&](double cell) -> const std::vector<std::uint8_t>& {
      return cell == 0 ? none : *cells.blobs[static_cast<std::size_t>(cell) - 1];
    };
    visit(row, run.board().find_set("robot")->names[static_cast<std::size_t>(row.robot)], bytes);
  }
}

std::string part_of(const std::string& robot, const char* kind, double number) {
  return robot + '/' + kind + std::to_string(static_cast<int>(number));
}

}  // namespace

void SensorLog::write(const Simulation& run) {
  write_scans(run);
  write_images(run);
}

bool SensorLog::send(const std::string& topic, const RosType& type, std::uint64_t now, bool is_still) {
  const auto [found, is_new] = channels_.try_emplace(topic);
  Channel& channel = found->second;
  if (is_new) {
    mcap::Channel made{0, sink_.schema({0, type.name, "ros2msg", type.definition}), topic, "cdr", {}};
    if (is_still) made.metadata = {{mcap::still, "true"}};
    channel.id = sink_.channel(made);
  }
  sink_.message({channel.id, channel.sent++, now, now, message_});
  return is_new;
}

void SensorLog::write_scans(const Simulation& run) {
  const std::uint64_t now = log_time(run.time());
  each_new<Scan>(run, "scan/*/message", [&](const Scan& scan, const std::string& robot, const auto& bytes) {
    const auto& ranges = bytes(scan.ranges);
    const std::size_t rays = ranges.size() / sizeof(double);
    const std::string frame = part_of(robot, "laser", scan.sensor);
    CdrWriter to(message_);
    put_header(to, now, frame);
    const double last = scan.min_angle + (rays > 1 ? static_cast<double>(rays - 1) : 0) * scan.step;
    for (const double value : {scan.min_angle, last, scan.step, 0.0, 0.0, scan.min_range, scan.max_range})
      to.put(static_cast<float>(value));
    to.count(rays);
    for (std::size_t i = 0; i < rays; ++i) {
      double range;
      std::memcpy(&range, ranges.data() + i * sizeof range, sizeof range);
      to.put(static_cast<float>(range));
    }
    to.count(0);  // intensities
    if (!send('/' + frame + "/scan", laser_scan, now)) return;
    CdrWriter mounting(message_);
    mounting.count(1);
    put_header(mounting, now, robot);
    mounting.text(frame);
    for (const double value : {scan.at_x, scan.at_y, scan.at_z, scan.qx, scan.qy, scan.qz, scan.qw})
      mounting.put(value);
    send("/tf_static", tf_message, now, true);
  });
}

void SensorLog::write_images(const Simulation& run) {
  const std::uint64_t now = log_time(run.time());
  each_new<Image>(run, "image/*/message", [&](const Image& image, const std::string& robot, const auto& bytes) {
    const std::string frame = part_of(robot, "camera", image.camera);
    const auto picture = [&](const char* name, const char* encoding, std::uint32_t pixel, const auto& data) {
      CdrWriter to(message_);
      put_header(to, now, frame);
      const auto width = static_cast<std::uint32_t>(image.width);
      to.put(static_cast<std::uint32_t>(image.height)).put(width).text(encoding).put(std::uint8_t{0});
      to.put(pixel * width).bytes(data.data(), data.size());
      send('/' + frame + '/' + name, picture_message, now);
    };
    picture("depth", "32FC1", sizeof(float), bytes(image.depth));
    picture("colour", "rgb8", 3, bytes(image.colour));
  });
}

}  // namespace muster::run_log
