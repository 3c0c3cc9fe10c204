// Tables that an attribute of the world file lists: claimed like those of any plugin, written into frames and read from
// them.
#pragma once

#include <muster/plugin.hpp>
#include <string>
#include <vector>

#include "ports/frame.hpp"

namespace muster::ports {

struct PortColumn {
  std::string name, unit, reference;  // reference: the set whose row numbers it holds
  bool nullable = false, infinite = false, bytes = false;
  std::string title() const { return unit.empty() ? name : name + '[' + unit + ']'; }
};

struct Port {
  std::string table;    // "robot/leader/command", without {robot}
  std::string general;  // "robot/{robot}/command", where the row is the robot that the plugin is bound to; else `table`
  std::vector<PortColumn> columns;
  std::string set;  // of a table of all rows, whose names are those of its rows; else ""
  bool is_written = false, is_queue = false, has_one_owner = false;
  int claim = -1;
};

// What a plugin does with the tables that an attribute lists.
struct Asked {
  const char* attribute;
  bool is_written;
  const char* example;  // of a quantity of robots, for messages: "command"
  uint32_t flags = 0;   // of its claims
};

// Claims each table of the attribute: standard ones by name, others with their columns in parentheses. Throws BadInput
// for a word that is no table; the kernel refuses what a controller may not see.
std::vector<Port> claimed_ports(const muster_host* host, const Asked& asked, int robot);

// True where the environment has MUSTER_BRIDGE=off: nobody outside is waited for, as in `muster check`.
bool is_off();

// Sets whose row names a client needs, in the order of first use.
std::vector<std::string> sets_of(const std::vector<Port>& ports);

// How a frame says which row of another set a cell means: by its number there, where both ends have the same world, or
// by its name.
enum class References { numbers, names };

// Rows of a table as it was read, with the bytes of its cells.
void write_rows(FrameWriter& frame, const Port& port, const muster_host* host, const muster_in& in,
                References references = References::numbers);

// Rows of one table, checked; `set` fills what the kernel is given. Throws Malformed. Rows of a queue with a name that
// this world does not have are left out.
class GivenRows {
 public:
  GivenRows(FrameReader& frame, const Port& port, const muster_host* host, uint32_t rows_expected,
            References references = References::numbers);
  // Of a reader that has checked them itself.
  GivenRows(const Port& port, std::vector<double> cells, std::vector<std::string> bytes)
      : port_(&port),
        rows_(static_cast<uint32_t>(cells.size() / port.columns.size())),
        cells_(std::move(cells)),
        bytes_(std::move(bytes)) {}
  // `first`: rows that this step has appended to a queue before.
  void set(const muster_host* host, const muster_out& out, uint32_t first = 0) const;
  uint32_t rows() const { return rows_; }
  uint32_t left_out() const { return left_out_; }
  const std::vector<double>& cells() const { return cells_; }

 private:
  void name_rows(FrameReader& frame, const muster_host* host);
  void leave_out(uint32_t row);
  void check(const muster_host* host) const;

  const Port* port_;
  uint32_t rows_, left_out_ = 0;
  std::vector<double> cells_;
  std::vector<std::string> bytes_;  // row by row, of each column of bytes
};

// Where nobody gives commands: rest, or what was commanded last.
void set_rest(const Port& port, const muster_out& out);
void set_last(const Port& port, const muster_in& last, const muster_out& out);

// "0.5 s"
std::string seconds_text(double seconds);

}  // namespace muster::ports
