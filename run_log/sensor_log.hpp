// Scans and pictures as messages of ROS 2 that viewers draw by themselves: /ROBOT/laserN/scan, /ROBOT/cameraN/depth and
// /ROBOT/cameraN/colour, and where lasers are mounted (/tf_static).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "kernel/simulation.hpp"
#include "mcap/sink.hpp"
#include "run_log/ros_types.hpp"

namespace muster::run_log {

class SensorLog {
 public:
  explicit SensorLog(mcap::Sink& sink) : sink_(sink) {}

  // Call before the first tick and after each.
  void write(const Simulation& run);

 private:
  struct Channel {
    std::uint16_t id = 0;
    std::uint32_t sent = 0;
  };
  void write_scans(const Simulation& run);
  void write_images(const Simulation& run);
  // True where the channel is new.
  bool send(const std::string& topic, const RosType& type, std::uint64_t now, bool is_still = false);

  mcap::Sink& sink_;
  std::map<std::string, Channel> channels_;  // by topic
  std::string message_;
};

}  // namespace muster::run_log
