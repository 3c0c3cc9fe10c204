// Datagrams between a controller's run and the robot that it drives: docs/reference/datagram_format.md. One frame each,
// with a stamp behind its kind.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ports/ports.hpp"

namespace muster::devices {

constexpr std::string_view datagram_magic = "MUSTERD1";  // of the format, with its revision
constexpr std::size_t most_datagram_bytes = 65507;       // that UDP carries

// Whose datagram it is and which one.
struct Stamp {
  std::uint64_t session = 0;   // of the sender, larger each time that it starts
  std::uint64_t sequence = 0;  // from 1 on
  std::uint64_t echo = 0;      // the last sequence that the sender took from the other end; 0: none
  double time = 0;             // [s] of the sender's run
};

ports::FrameWriter begun_datagram(ports::Kind kind, const Stamp& stamp);

struct Datagram {
  ports::Kind kind;
  Stamp stamp;
  std::string_view body;
};
// Throws ports::Malformed: no frame, another length, another revision, a kind that no datagram has.
Datagram parsed_datagram(std::string_view bytes);

// A table that both ends exchange, as each tells the other.
struct TableShape {
  std::string name;       // "robot/{robot}/odometry"
  std::string columns;    // "x[m] y[m]"
  bool is_given = false;  // by the robot: sensed. Else a command
  bool operator==(const TableShape& other) const {
    return name == other.name && columns == other.columns && is_given == other.is_given;
  }
};
// `gives_written`: at the controller's end what is written is what the robot gives; at the robot's end it is the
// command.
std::vector<TableShape> shapes_of(const std::vector<ports::Port>& ports, bool gives_written);
void write_tables(ports::FrameWriter& frame, const std::vector<TableShape>& shapes);
std::vector<TableShape> read_tables(std::string_view body);
// What the other end has otherwise, in words; empty where both exchange the same.
std::string disagreement(const std::vector<TableShape>& ours, const std::vector<TableShape>& theirs,
                         const std::string& their_name);

// Takes each datagram of one session at most once and in the order of its sending, and counts the others.
class Sequence {
 public:
  enum class Taken { fresh, late, duplicate };
  struct Counts {
    std::uint64_t received = 0, late = 0, duplicate = 0, lost = 0;  // lost: not come until now
  };
  // Begins a session anew.
  void restart(std::uint64_t session);
  Taken take(std::uint64_t sequence);
  std::uint64_t session() const { return session_; }
  std::uint64_t last() const { return last_; }
  const Counts& counts() const { return counts_; }

 private:
  static constexpr std::uint64_t window = 64;                    // of late ones that are told from duplicates
  std::uint64_t session_ = 0, first_ = 0, last_ = 0, seen_ = 0;  // seen_: bit i: last_ - i has come
  Counts counts_;
};

}  // namespace muster::devices
