// Definitions of the messages of ROS 2 that viewers draw by themselves, as their packages have them.
#pragma once

namespace muster::run_log {

struct RosType {
  const char* name;
  const char* definition;
};

extern const RosType tf_message;       // tf2_msgs: where each robot is
extern const RosType marker_array;     // visualization_msgs: walls, radios, robots
extern const RosType laser_scan;       // sensor_msgs
extern const RosType picture_message;  // sensor_msgs: Image
extern const RosType log_line;         // rcl_interfaces: events

}  // namespace muster::run_log
