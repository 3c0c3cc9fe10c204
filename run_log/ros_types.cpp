#include "run_log/ros_types.hpp"

namespace muster::run_log {

#define MUSTER_NEXT "================================================================================\n"
#define MUSTER_HEADER               \
  MUSTER_NEXT                       \
  "MSG: std_msgs/Header\n"          \
  "builtin_interfaces/Time stamp\n" \
  "string frame_id\n" MUSTER_NEXT   \
  "MSG: builtin_interfaces/Time\n"  \
  "int32 sec\n"                     \
  "uint32 nanosec\n"
#define MUSTER_THREE(name) MUSTER_NEXT "MSG: geometry_msgs/" name "\nfloat64 x\nfloat64 y\nfloat64 z\n"
#define MUSTER_QUATERNION MUSTER_NEXT "MSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"

const RosType tf_message{"tf2_msgs/msg/TFMessage",
                         "geometry_msgs/TransformStamped[] transforms\n" MUSTER_NEXT
                         "MSG: geometry_msgs/TransformStamped\n"
                         "std_msgs/Header header\n"
                         "string child_frame_id\n"
                         "geometry_msgs/Transform transform\n" MUSTER_HEADER MUSTER_NEXT
                         "MSG: geometry_msgs/Transform\n"
                         "geometry_msgs/Vector3 translation\n"
                         "geometry_msgs/Quaternion rotation\n" MUSTER_THREE("Vector3") MUSTER_QUATERNION};

const RosType marker_array{"visualization_msgs/msg/MarkerArray",
                           "visualization_msgs/Marker[] markers\n" MUSTER_NEXT
                           "MSG: visualization_msgs/Marker\n"
                           "std_msgs/Header header\n"
                           "string ns\n"
                           "int32 id\n"
                           "int32 type\n"
                           "int32 action\n"
                           "geometry_msgs/Pose pose\n"
                           "geometry_msgs/Vector3 scale\n"
                           "std_msgs/ColorRGBA color\n"
                           "builtin_interfaces/Duration lifetime\n"
                           "bool frame_locked\n"
                           "geometry_msgs/Point[] points\n"
                           "std_msgs/ColorRGBA[] colors\n"
                           "string texture_resource\n"
                           "sensor_msgs/CompressedImage texture\n"
                           "visualization_msgs/UVCoordinate[] uv_coordinates\n"
                           "string text\n"
                           "string mesh_resource\n"
                           "visualization_msgs/MeshFile mesh_file\n"
                           "bool mesh_use_embedded_materials\n" MUSTER_HEADER MUSTER_NEXT
                           "MSG: geometry_msgs/Pose\n"
                           "geometry_msgs/Point position\n"
                           "geometry_msgs/Quaternion orientation\n" MUSTER_THREE("Vector3") MUSTER_THREE("Point")
                               MUSTER_QUATERNION MUSTER_NEXT
                           "MSG: std_msgs/ColorRGBA\n"
                           "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n" MUSTER_NEXT
                           "MSG: builtin_interfaces/Duration\n"
                           "int32 sec\nuint32 nanosec\n" MUSTER_NEXT
                           "MSG: sensor_msgs/CompressedImage\n"
                           "std_msgs/Header header\nstring format\nuint8[] data\n" MUSTER_NEXT
                           "MSG: visualization_msgs/UVCoordinate\n"
                           "float32 u\nfloat32 v\n" MUSTER_NEXT
                           "MSG: visualization_msgs/MeshFile\n"
                           "string filename\nuint8[] data\n"};

const RosType laser_scan{"sensor_msgs/msg/LaserScan",
                         "std_msgs/Header header\n"
                         "float32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\n"
                         "float32 time_increment\nfloat32 scan_time\n"
                         "float32 range_min\nfloat32 range_max\n"
                         "float32[] ranges\nfloat32[] intensities\n" MUSTER_HEADER};

const RosType picture_message{"sensor_msgs/msg/Image",
                              "std_msgs/Header header\n"
                              "uint32 height\nuint32 width\n"
                              "string encoding\nuint8 is_bigendian\nuint32 step\nuint8[] data\n" MUSTER_HEADER};

const RosType log_line{"rcl_interfaces/msg/Log",
                       "builtin_interfaces/Time stamp\n"
                       "uint8 level\n"
                       "string name\n"
                       "string msg\n"
                       "string file\n"
                       "string function\n"
                       "uint32 line\n" MUSTER_NEXT
                       "MSG: builtin_interfaces/Time\n"
                       "int32 sec\n"
                       "uint32 nanosec\n"};

}  // namespace muster::run_log
