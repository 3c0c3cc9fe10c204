// What a log holds of a plugin's tables: each sample with its time, as a run or a robot has recorded it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ports/ports.hpp"

namespace muster::devices {

// Samples of one table in the order of their times; a row of cells each.
struct Track {
  std::vector<std::int64_t> times;  // [ns] of the world
  std::vector<double> cells;
  std::vector<std::string> bytes;  // row by row, of each column of bytes
  std::size_t strangers = 0;       // messages about a row that this world does not have, left out

  // Samples at or before this time: their number, so that the last one's place is one less.
  std::size_t until(std::int64_t time) const;
};

// Tables and the topics under which a robot of ROS 2 has them: "robot/{robot}/odometry", "/odom".
using Topics = std::vector<std::pair<std::string, std::string>>;

// How the log is to be read.
struct Source {
  std::filesystem::path file;  // .csv: one wide table; else MCAP
  std::string robot;           // what the log calls it
  double begin = 0;            // [s] after the log's start, when the world begins
  Topics topics;
};

// A track a port. Throws BadInput: a file that cannot be read, a table that the log does not have.
std::vector<Track> recording(const muster_host* host, const std::vector<ports::Port>& ports, const Source& source);

// Nanoseconds of a time of the run, as a log has them.
std::int64_t nanoseconds(double seconds);

}  // namespace muster::devices
