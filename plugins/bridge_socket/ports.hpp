// The tables that a bridge declares: claimed like those of any controller, written into frames and read from them.
#pragma once

#include <muster/plugin.hpp>
#include <string>
#include <vector>

#include "frame.hpp"

namespace muster::bridge {

struct PortColumn {
  std::string name, unit, reference;  // reference: the set whose row numbers it holds
  bool nullable = false, infinite = false, bytes = false;
  std::string title() const { return unit.empty() ? name : name + '[' + unit + ']'; }
};

struct Port {
  std::string table;  // "robot/leader/command", without {robot}
  std::vector<PortColumn> columns;
  std::string set;  // of a table of all rows, whose names are those of its rows; else ""
  bool is_command = false, is_queue = false, has_one_owner = false;
  int claim = -1;
};

// Claims each table of the attribute: standard ones by name, others with their columns in parentheses. Throws BadInput
// for a word that is no table; the kernel refuses what a controller may not see.
std::vector<Port> claimed_ports(const muster_host* host, const char* attribute, bool is_command, int robot);

// Sets whose row names a client needs, in the order of first use.
std::vector<std::string> sets_of(const std::vector<Port>& ports);

// Rows of a table as it was read, with the bytes of its cells.
void write_rows(FrameWriter& frame, const Port& port, const muster_host* host, const muster_in& in);

// Commands of one table, checked; `set` fills what the kernel is given. Throws Malformed.
class GivenRows {
 public:
  GivenRows(FrameReader& frame, const Port& port, const muster_host* host, const muster_out& out);
  void set(const muster_host* host, const muster_out& out) const;

 private:
  void check(const muster_host* host) const;

  const Port* port_;
  uint32_t rows_;
  std::vector<double> cells_;
  std::vector<std::string> bytes_;  // row by row, of each column of bytes
};

// Where nobody gives commands: rest, or what was commanded last.
void set_rest(const Port& port, const muster_out& out);
void set_last(const Port& port, const muster_in& last, const muster_out& out);

}  // namespace muster::bridge
