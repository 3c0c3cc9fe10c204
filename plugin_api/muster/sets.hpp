// The standard sets: the meaning of a world file's elements that are not plugins. To the kernel this is data; its code
// has no robot, radio or wall.
#pragma once

#include <cmath>
#include <functional>
#include <muster/floors.hpp>
#include <muster/meshes.hpp>
#include <muster/plugin.hpp>
#include <muster/senses.hpp>
#include <vector>

namespace muster {

enum class SetKind {
  fixed = 1,  // rows as the world file has them
  live,       // rows join and leave, and keep their numbers
  queue,      // rows appended in a step, gone when every reader has seen them
  listed      // rows listed anew by the writer of the set's first quantity; the other quantities follow it
};

struct Quantity {
  const char* name;
  const char* columns;
  const char* initial;      // numbers, one a column; "" means zeros, or null where nullable
  bool sensed;              // a robot's own controller may read it
  const char* provider;     // the plugin that writes it where a world names none; "" for none
  const char* user = "";    // a plugin that makes it have an effect, for the message where nobody reads it
  const char* writer = "";  // an element that writes it, for the message where nobody does; "" for none of muster's own
  const char* also = "";    // other words for it, with blanks between: what a misspelt table may mean
  const char* felt = "";    // of truth: what a controller reads in its place, for the message where it asks for it
};

struct SetDeclaration {
  const char* name;
  SetKind kind;
  const char* owner;  // queue: the owning set, whose row number is in column 0; else ""
  const char* help;
  std::vector<Quantity> quantities;
  bool on_demand = false;  // the set exists only in worlds in which a plugin claims it, so that no other world changes
};

// One attribute of an element: `count` numbers that go into a table, or a text that plugins read by its path.
struct Attribute {
  Param param;
  int count;
  const char* table;  // "set/quantity"; "" for a text
  // Puts the values into the table's row.
  void (*store)(const double* values, double* row);
};

// The cells of a table's row, as the world file gives them.
using CellsOf = std::function<std::vector<double>(const char* table, double row)>;

struct Element {
  const char* name;
  const char* set;  // an element adds one row to this set and to each that an attribute's table names
  const char* help;
  const char* file_of;  // "walls": its `file` attribute lists rows of this set, by column name; else ""
  std::vector<Attribute> attributes;
  const char* own_row;  // "set/quantity" whose first column is this element's row in `set`; else ""
  // Fault of a row whose attributes are each within bounds; "" if there is none. Null: no such check.
  const char* (*fault)(double row, const CellsOf& cells) = nullptr;
};

struct Standard {
  std::vector<SetDeclaration> sets;
  std::vector<Element> elements;
};

namespace detail {
template <int first, int count>
void store_at(const double* values, double* row) {
  for (int i = 0; i < count; ++i) row[first + i] = values[i];
}
template <int count>
void store_yaw(const double* yaw, double* row) {
  row[count] = std::cos(*yaw / 2);
  row[count + 3] = std::sin(*yaw / 2);
}
inline Wall wall_of(double row, const CellsOf& cells) {
  const auto c = cells("wall/shape", row);
  return {c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]};
}
constexpr double lattice = 1.0 / 4096;  // [m] grid to which places of walls and doors are rounded
inline const char* fault_of_wall(double row, const CellsOf& cells) {
  const Wall wall = wall_of(row, cells);
  if (std::hypot(wall.x1 - wall.x0, wall.y1 - wall.y0) >= lattice) return "";
  return "has no length; expected ends at least 2^-12 m apart";
}
inline const char* fault_of_door(double row, const CellsOf& cells) {
  const auto door = cells("door/shape", row);
  const Wall wall = wall_of(door[0], cells);
  const double ends = door[1] + door[2], length = std::hypot(wall.x1 - wall.x0, wall.y1 - wall.y0);
  return ends <= length + 3 * lattice ? "" : "ends beyond its wall; expected at + width within the wall's length";
}
}  // namespace detail

inline const Standard& standard() {
  using detail::store_at;
  constexpr double far = 1e6;  // [m] larger coordinates are taken for a mistake of units
  static const Standard result{
      {
          {"material",
           SetKind::fixed,
           "",
           "what walls, doors, floors and meshes are made of",
           {{"loss", Loss::columns, "", false, ""}, {"colour", Colouring::columns, "", false, ""}}},
          {"wall", SetKind::fixed, "", "upright walls, straight in plan", {{"shape", Wall::columns, "", false, ""}}},
          {"door",
           SetKind::fixed,
           "",
           "gaps in walls that open and close",
           {{"shape", Door::columns, "", false, ""}, {"state", DoorState::columns, "", false, ""}}},
          {"floor", SetKind::fixed, "", "level floors and ceilings", {{"shape", FloorShape::columns, "", false, ""}}},
          {"mesh",
           SetKind::fixed,
           "",
           "bodies and surfaces from files",
           {{"shape", MeshShape::columns, "", false, ""}}},
          {"robot",
           SetKind::live,
           "",
           "bodies that move",
           {{"pose", Pose::columns, "0 0 0 1 0 0 0", false, "physics.simbody", "", "physics.simbody",
             "position place location at state xy xyz",
             "read<Odometry>(\"robot/{robot}/odometry\"), or read<Position3d>(\"robot/{robot}/position3d\") of what "
             "flies"},
            {"twist", Twist::columns, "", false, "physics.simbody", "", "physics.simbody", "velocity speed vel",
             "read<Odometry>(\"robot/{robot}/odometry\"), or read<Position3d>(\"robot/{robot}/position3d\") of what "
             "flies"},
            {"wheels", Wheels::columns, "", false, "physics.simbody", "", "", "",
             "read<Odometry>(\"robot/{robot}/odometry\")"},
            {"command", Command::columns, "", true, "", "physics.simbody", "control.steady robot=\"...\"", "cmd_vel"},
            {"car_command", CarCommand::columns, "", true, "", "control.car"},
            {"goal2d", Goal2d::columns, "", true, "", "control.goal2d", "control.mission robot=\"...\" mission=\"...\"",
             "goal"},
            {"drive", Drive::columns, "", false, "robots.drive"},
            {"gait", Gait::columns, "", false, "robots.gait"},
            {"legs", Legs::columns, "", false, "physics.simbody"},
            {"odometry", Odometry::columns, "", true, "robots.odometry", "", "", "odom"},
            {"odometry_reset", OdometryReset::columns, "", true, ""},
            {"stall", Stall::columns, "", true, "robots.odometry"},
            {"geometry", Geometry::columns, "", true, "robots.geometry"},
            {"attitude_thrust", AttitudeThrust::columns, "", true, "", "physics.simbody",
             "control.velocity3d robot=\"...\""},
            {"velocity3d", Velocity3d::columns, "", true, "", "control.velocity3d",
             "control.path3d robot=\"...\" path=\"FILE.csv\""},
            {"position3d", Position3d::columns, "", true, "robots.mocap"},
            {"imu", Imu::columns, "", true, "sensors.imu", "", "", "acceleration gyro gyroscope accelerometer"},
            {"gps", Gps::columns, "", true, "sensors.gps", "", "", "gnss latitude longitude navsat"},
            {"rotor_drive", RotorDrive::columns, "", false, "robots.attitude"},
            {"rotors", Rotors::columns, "", false, "physics.simbody"}}},
          {"radio",
           SetKind::live,
           "",
           "devices that send and receive",
           {{"mount", Mount::columns, "", false, ""}, {"traffic", Traffic::columns, "", false, "network.ideal"}}},
          {"endpoint",
           SetKind::listed,
           "",
           "radios at places and times",
           {{"radio", Endpoint::columns, "", false, "radio.links"}, {"pose", Pose::columns, "", false, "radio.links"}}},
          {"link",
           SetKind::listed,
           "",
           "pairs of endpoints that may hear each other",
           {{"ends", Ends::columns, "", false, "radio.links"},
            {"level", Level::columns, "", false, "", "", "radio.multiwall", "power",
             "the rssi of messages, read<Incoming>(\"inbox/{robot}/message\")"},
            {"fading", Fading::columns, "", false, "", "", "radio.fading"},
            {"rssi", Rssi::columns, "", false, "radio.receiver", "", "", "signal strength",
             "the rssi of messages, read<Incoming>(\"inbox/{robot}/message\")"}}},
          {"scan", SetKind::queue, "robot", "what lasers saw", {{"message", Scan::columns, "", true, "sensors.laser"}}},
          {"heard",
           SetKind::queue,
           "robot",
           "what radios know of the peers that they heard",
           {{"peer", Heard::columns, "", true, "sensors.links", "", "", "links neighbours"}},
           true},
          {"range",
           SetKind::queue,
           "robot",
           "distances to other radios, as measured",
           {{"message", Range::columns, "", true, "sensors.range", "", "", "uwb distance"}},
           true},
          {"image",
           SetKind::queue,
           "robot",
           "what cameras saw",
           {{"message", Image::columns, "", true, "", "", "sensors.camera robot=\"...\"", "camera picture depth"}},
           true},
          {"outbox",
           SetKind::queue,
           "radio",
           "requests to send",
           {{"message", Outgoing::columns, "", true, "", "network.ideal", "control.beacon radio=\"...\""}}},
          {"inbox",
           SetKind::queue,
           "radio",
           "messages received",
           {{"message", Incoming::columns, "", true, "network.ideal"}}},
      },
      {
          {"material",
           "material",
           "a kind of wall",
           "",
           {{real("loss", 0, 0, 100, "dB", "loss of a wall at the world's radio frequency").free().required(), 1,
             "material/loss", store_at<0, 1>},
            {real("colour", 0.75, 0, 1, "", "as a camera sees it: red green blue"), 3, "material/colour",
             store_at<0, 3>}},
           ""},
          {"wall",
           "wall",
           "an upright wall",
           "",
           {{real("from", 0, -far, far, "m", "first end: x y").required(), 2, "wall/shape", store_at<0, 2>},
            {real("to", 0, -far, far, "m", "second end: x y").required(), 2, "wall/shape", store_at<2, 2>},
            {real("base", 0, -far, far, "m", "height of its foot"), 1, "wall/shape", store_at<4, 1>},
            {real("height", 2.7, 0.001, far, "m", "height above its foot"), 1, "wall/shape", store_at<5, 1>},
            {real("thickness", 0.1, 0, 100, "m", "thickness, half to each side"), 1, "wall/shape", store_at<6, 1>},
            {reference("material", "material", "what it is made of").required(), 1, "wall/shape", store_at<7, 1>}},
           "",
           detail::fault_of_wall},
          {"walls",
           "wall",
           "walls from a table",
           "wall",
           {{file("file",
                  "a table with columns name, x0[m], y0[m], x1[m], y1[m], material, and base[m], height[m], "
                  "thickness[m] where they are not the defaults")
                 .required(),
             0, "", nullptr}},
           ""},
          {"door",
           "door",
           "a gap in a wall",
           "",
           {{reference("wall", "wall", "the wall it is in").required(), 1, "door/shape", store_at<0, 1>},
            {real("at", 0, 0, far, "m", "where it begins, from the wall's first end").required(), 1, "door/shape",
             store_at<1, 1>},
            {real("width", 0.9, 0.001, far, "m", "width"), 1, "door/shape", store_at<2, 1>},
            {real("height", 2.0, 0.001, far, "m", "height above the wall's foot"), 1, "door/shape", store_at<3, 1>},
            {reference("material", "material", "what it is made of; by default its wall's"), 1, "door/shape",
             store_at<4, 1>},
            {choice("state", "closed|open", "how it stands at the start"), 1, "door/state", store_at<0, 1>}},
           "",
           detail::fault_of_door},
          {"floor",
           "floor",
           "a level floor or ceiling",
           "",
           {{real("corners", 0, -far, far, "m", "its four corners in turn: x y of each").required(), 8, "floor/shape",
             store_at<0, 8>},
            {real("z", 0, -far, far, "m", "its height").required(), 1, "floor/shape", store_at<8, 1>},
            {reference("material", "material", "what it is made of").required(), 1, "floor/shape", store_at<9, 1>}},
           ""},
          {"mesh",
           "mesh",
           "a body or a surface from a file",
           "",
           {{text("file", "", ".stl, .obj or .dae, in the world's folder").required(), 0, "", nullptr},
            {reference("material", "material", "what it is made of").required(), 1, "mesh/shape", store_at<5, 1>},
            {real("at", 0, -far, far, "m", "where its origin is: x y z"), 3, "mesh/shape", store_at<0, 3>},
            {real("yaw", 0, -far, far, "rad", "how it is turned about the upright"), 1, "mesh/shape", store_at<3, 1>},
            {real("scale", 1, 1e-6, 1e6, "", "metres a unit of the file"), 1, "mesh/shape", store_at<4, 1>},
            {choice("kind", "solid|sheet", "a closed body, which counts once, or a surface"), 1, "mesh/shape",
             store_at<6, 1>}},
           ""},
          {"station",
           "radio",
           "a radio that does not move",
           "",
           {{real("at", 0, -far, far, "m", "place: x y z").required(), 3, "radio/mount", store_at<1, 3>},
            {real("yaw", 0, -far, far, "rad", "heading of its antenna"), 1, "radio/mount", store_at<4, 1>}},
           ""},
          {"robot",
           "robot",
           "a robot, with its radio",
           "",
           {{text("model", "scarab", "a description among the models, or a URDF file"), 0, "", nullptr},
            {text("packages", "", "the folder that holds ROS packages, for package:// in its URDF"), 0, "", nullptr},
            {text("fittings", "", "a file with the <muster>, <sensor> and <gazebo> that its URDF lacks"), 0, "",
             nullptr},
            {real("at", 0, -far, far, "m", "place: x y z").required(), 3, "robot/pose", store_at<0, 3>},
            {real("heading", 0, -far, far, "rad", "heading, from east to north"), 1, "robot/pose",
             detail::store_yaw<3>},
            {real("antenna", 0, -far, far, "m", "place of its radio in its own frame: x y z"), 3, "radio/mount",
             store_at<1, 3>}},
           "radio/mount"},
      }};
  return result;
}

}  // namespace muster
