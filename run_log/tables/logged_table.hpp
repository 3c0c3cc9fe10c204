// A table as a channel of a log: its fields, as a definition that readers of ROS 2 understand, and as metadata by which
// muster reads it back.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mcap/records.hpp"

namespace muster::run_log {

struct Field {
  enum class Kind { real, text, bytes };
  std::string name, unit;
  Kind kind = Kind::real;

  // "x[m]"
  std::string title() const { return unit.empty() ? name : name + '[' + unit + ']'; }
  bool operator==(const Field&) const = default;
};

enum class Layout {
  row,     // a channel a named row: a message has its fields
  rows,    // a message has all rows of a time
  message  // a row of a queue a message
};

struct LoggedTable {
  std::string table;  // "robot/*/pose"
  std::string row;    // "leader"; for Layout::row
  Layout layout = Layout::row;
  std::vector<Field> fields;

  bool operator==(const LoggedTable&) const = default;
};

// The table with the row's name in place of the star: "robot/leader/pose".
std::string with_names(const std::string& table, const std::string& names);

// "/robot/leader/pose", "/link/rssi"
std::string topic_of(const LoggedTable& table);
// "muster/msg/RobotPose"
std::string type_of(const LoggedTable& table);
// Of encoding ros2msg.
std::string definition_of(const LoggedTable& table);
mcap::Texts metadata_of(const LoggedTable& table);

// Null where the channel is none of muster's tables. Throws mcap::Malformed where its metadata are damaged.
std::optional<LoggedTable> table_of(const mcap::Channel& channel);
// As above where a program of ROS 2 has recorded the topic anew, and kept of muster's metadata the definition alone.
std::optional<LoggedTable> table_of(const mcap::Channel& channel, const mcap::Schema& schema);

// A field of one message: the number, or a name, or bytes. The text is a view of the message.
struct FieldValue {
  double real = 0;
  std::string_view text;
};
// Of a message of one row (Layout::row or Layout::message), in the order of the fields. Throws mcap::Malformed.
std::vector<FieldValue> values_of(const LoggedTable& table, std::string_view data);

// One row's numbers: `name` is the table with the row's names in place of the star, "link/base/rover/rssi".
using TakeReal = std::function<void(const std::string& name, const Field& field, double value)>;
// Throws mcap::Malformed where the message is not what the fields say.
void read_message(const LoggedTable& table, std::string_view data, const TakeReal& take);

}  // namespace muster::run_log
