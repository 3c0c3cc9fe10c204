// Messages that robots of ROS 2 record of what they sense, as rows of the standard tables.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "run_log/tables/logged_table.hpp"

namespace muster::devices {

struct ForeignMessage {
  const char* type;
  std::vector<run_log::Field> fields;
  // A message's values in the order of the fields. `time` [s] and `count` are those of the message in the log;
  // `storage` holds bytes that the values are views of. Throws mcap::Malformed.
  std::vector<run_log::FieldValue> (*values)(std::string_view data, double time, double count, std::string& storage);
};

// Null where it is not known: nav_msgs/msg/Odometry and sensor_msgs/msg/LaserScan are.
const ForeignMessage* foreign_message(const std::string& type);

}  // namespace muster::devices
