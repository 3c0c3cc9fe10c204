// What viewers draw by themselves: where robots are (/tf), walls, doors, radios and bodies (/scene), and events.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernel/simulation.hpp"
#include "mcap/sink.hpp"

namespace muster::run_log {

class SceneLog {
 public:
  SceneLog(const Simulation& run, mcap::Sink& sink);

  // Call before the first tick and after each.
  void write(const Simulation& run);

 private:
  void write_transforms(const Simulation& run);
  void write_building(const Simulation& run);
  void write_robots(const Simulation& run);
  void write_events(const Simulation& run);
  void send(std::uint16_t channel, std::uint32_t sequence, std::uint64_t now);

  mcap::Sink& sink_;
  std::uint64_t every_ = 1;  // ticks, of transforms
  std::optional<std::uint16_t> transforms_, scene_, events_;
  std::uint32_t transforms_sent_ = 0, scenes_sent_ = 0;
  std::size_t robots_drawn_ = 0, events_sent_ = 0;
  std::int32_t next_marker_ = 0;
  std::string message_;
};

}  // namespace muster::run_log
