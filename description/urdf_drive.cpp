#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <sstream>
#include <variant>

#include "description/file_text.hpp"
#include "description/urdf_check.hpp"

namespace muster::description {

using tinyxml2::XMLElement;

namespace {

std::size_t find_named(const Source& source, const XMLElement& element, const char* attribute, const std::string& name,
                       const Robot& robot) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    if (robot.joints[i].name == name) return i;
    names.push_back(robot.joints[i].name);
  }
  const auto of_link = std::find_if(robot.joints.begin(), robot.joints.end(),
                                    [&](const Joint& joint) { return robot.links.at(joint.child).name == name; });
  if (of_link != robot.joints.end())
    source.fail(element.GetLineNum(), tag(element) + attribute + ": '" + name +
                                          "' is a link, and a joint is meant; expected " + attribute + "=\"" +
                                          of_link->name + "\", the joint that holds it");
  source.fail(element.GetLineNum(),
              tag(element) + attribute + ": joint '" + name + "' is not known" + nearest(name, names));
}

// Turns a wheel that is declared about -y, as right wheels often are: only its angle's sign is another.
void turn_forward(const Source& source, const XMLElement& element, std::size_t index, Robot& robot) {
  Joint& joint = robot.joints[index];
  const auto carrier = frame_on_body(robot, joint.parent);
  if (joint.kind != JointKind::continuous || !carrier) return;  // refused later
  if (!(carrier->linear() * joint.origin.linear() * joint.axis + Eigen::Vector3d::UnitY()).isZero(axis_tolerance))
    return;
  joint.axis = Eigen::Vector3d::Zero() - joint.axis;  // without -0
  const Eigen::Vector3d& axis = joint.axis;
  robot.warnings.push_back(
      source.file + ":" + std::to_string(element.GetLineNum()) + ": " + tag(element) + "joint '" + joint.name +
      "' turns about the body's -y axis, and is taken to turn about +y; its angle has the other "
      "sign; write <axis xyz=\"" +
      print_exactly(axis.x()) + " " + print_exactly(axis.y()) + " " + print_exactly(axis.z()) + "\"/>");
}

// What a length given may have been meant as, where the robot has `real` metres; "" where it is merely another.
std::string doubt_of_length(const XMLElement& element, const char* attribute, double given, double real) {
  constexpr double alike = 0.02;  // of a length rounded to two digits
  for (const auto& [unit, parts] : {std::pair{"millimetres", 1000.0}, std::pair{"centimetres", 100.0}}) {
    if (!(std::abs(given - parts * real) < alike * given)) continue;
    const char* text = element.Attribute(attribute);
    return std::string("; is ") + attribute + "=\"" + (text ? text : print_number(given)) + "\" in " + unit +
           "? expected " + print_number(given / parts);
  }
  return "";
}

// What a radius is to be where the wheel has `real` metres: given in another unit, as a diameter, or merely another.
std::string doubt_of_radius(const XMLElement& element, double given, double real) {
  constexpr double alike = 0.02;
  if (std::string unit = doubt_of_length(element, "wheel_radius", given, real); !unit.empty()) return unit;
  for (const auto& [unit, parts] : {std::pair{"millimetres", 1000.0}, std::pair{"centimetres", 100.0}}) {
    if (std::abs(real - parts * given) < alike * real)
      return std::string("; is the shape in ") + unit + "? expected " + print_number(real / parts) + " there";
  }
  return std::string(std::abs(given - 2 * real) < alike * given ? "; is it the diameter? expected " : "; expected ") +
         "wheel_radius=\"" + print_number(real) + '"';
}

// Limits of a wheel [rad/s, rad/s2] that make the robot creep where they were meant in m/s and m/s2 of its rim.
void warn_of_creeping(const Source& source, const XMLElement& element, const DifferentialDrive& drive, Robot& robot) {
  const auto doubt = [&](const char* name, double limit, const char* of_rim, const char* of_wheel) -> std::string {
    if (!(limit * drive.wheel_radius < slowest_drive)) return "";
    const char* given = element.Attribute(name);
    const std::string what = given ? std::string(name) + "=\"" + given + "\" " + of_wheel
                                   : "the limit of its wheels' joints, " + print_number(limit) + ' ' + of_wheel + ',';
    return what + " of a wheel is " + print_number(limit * drive.wheel_radius) + ' ' + of_rim + " at its rim (radius " +
           print_number(drive.wheel_radius) + " m); is it in " + of_rim + "? " + print_number(limit) + ' ' + of_rim +
           " are " + print_number(limit / drive.wheel_radius) + ' ' + of_wheel;
  };
  for (const std::string& what : {doubt("max_speed", drive.max_speed, "m/s", "rad/s"),
                                  doubt("max_acceleration", drive.max_acceleration, "m/s2", "rad/s2")}) {
    if (!what.empty())
      robot.warnings.push_back(source.file + ":" + std::to_string(element.GetLineNum()) + ": " + tag(element) + what);
  }
}

// Checks that the axle is along the body's y axis, the left wheel on the left, and that positive rates turn forward.
Eigen::Vector3d check_wheel(const Source& source, const XMLElement& element, const Robot& robot, std::size_t index,
                            double y) {
  Eigen::Vector3d middle = place_of_turning(source, element, robot, index);
  if (std::abs(middle.y() - y) > placement_tolerance) {
    const bool is_base = std::string(element.Name()) != "ackermann" && std::string(element.Name()) != "mecanum";
    const char* width = is_base ? "wheel_base" : "wheel_separation";
    source.fail(element.GetLineNum(),
                tag(element) + "joint '" + robot.joints[index].name + "' is not half a " + width +
                    " from the body's x axis (left: +y, right: -y): it is at y = " + print_number(middle.y()) +
                    " m, expected " + print_number(y) + doubt_of_place(element, width, middle.y(), y));
  }
  return middle;
}

void check_radius(const Source& source, const XMLElement& element, const Robot& robot, std::size_t index,
                  double wheel_radius) {
  const Joint& joint = robot.joints[index];
  const double radius = round_about_axle(robot, joint);
  if (radius == 0 || std::abs(radius - wheel_radius) <= placement_tolerance) return;
  const char* given = element.Attribute("wheel_radius");
  source.fail(element.GetLineNum(), tag(element) + "wheel_radius=\"" + (given ? given : print_number(wheel_radius)) +
                                        "\" contradicts the wheel of joint '" + joint.name +
                                        "', whose collision shape has a radius of " + print_number(radius) +
                                        doubt_of_radius(element, wheel_radius, radius));
}

// Not an error: the world file may put the robot's frame above the ground.
void warn_of_height(const Source& source, const XMLElement& element, double height, double wheel_radius, Robot& robot) {
  if (std::abs(height - wheel_radius) <= placement_tolerance) return;
  robot.warnings.push_back(source.file + ":" + std::to_string(element.GetLineNum()) + ": " + tag(element) +
                           "the axle is at z = " + print_number(height) +
                           " of the robot's frame, which is to be on the ground; wheels of radius " +
                           print_number(wheel_radius) + " do not stand there");
}

// 0 where it is absent.
double share(const Source& source, const XMLElement& element, const char* attribute) {
  const char* text = element.Attribute(attribute);
  if (!text) return 0;
  const auto value = parse_number(text);
  if (!value || *value < 0 || *value > 1) {
    source.fail(element.GetLineNum(),
                tag(element) + attribute + "=\"" + text + "\" is wrong; expected a number from 0 to 1");
  }
  return *value;
}

// Indices of the joints that an attribute names, with blanks between.
std::vector<std::size_t> find_joints(const Source& source, const XMLElement& element, const char* attribute,
                                     const Robot& robot) {
  std::string text = required(source, element, attribute);
  const bool is_in_names = std::any_of(robot.joints.begin(), robot.joints.end(),
                                       [](const Joint& joint) { return joint.name.find(',') != joint.name.npos; });
  if (text.find(',') != text.npos && !is_in_names) {
    const std::string given = text;
    std::replace(text.begin(), text.end(), ',', ' ');
    std::string meant;
    std::istringstream parts(text);
    for (std::string name; parts >> name;) meant += (meant.empty() ? "" : " ") + name;
    source.fail(element.GetLineNum(), tag(element) + attribute + "=\"" + given +
                                          "\" has commas between its joints; expected blanks: " + attribute + "=\"" +
                                          meant + '"');
  }
  std::istringstream words(text);
  std::vector<std::size_t> result;
  for (std::string name; words >> name;) {
    result.push_back(find_named(source, element, attribute, name, robot));
    if (std::count(result.begin(), result.end(), result.back()) > 1)
      source.fail(element.GetLineNum(), tag(element) + attribute + " has joint '" + name + "' twice");
  }
  if (result.empty()) source.fail(element.GetLineNum(), tag(element) + attribute + " names no joint");
  return result;
}

// Of a joint in the file of the element; 0 where it is not there.
int line_of_joint(const XMLElement& element, const std::string& name) {
  const XMLElement* root = element.GetDocument()->RootElement();
  for (const auto* each = root->FirstChildElement("joint"); each; each = each->NextSiblingElement("joint")) {
    const char* own = each->Attribute("name");
    if (own && name == own) return each->GetLineNum();
  }
  return 0;
}

// What else is wrong with a wheel whose cylinder stands about the axis that it has and not about the one it needs.
std::string lying_flat(const Robot& robot, const Joint& joint, const Eigen::Vector3d& axis) {
  constexpr double across = 0.1;  // of a unit vector
  for (const Shape& shape : rigid_shapes(robot, joint.child)) {
    if (!std::holds_alternative<Cylinder>(shape.geometry)) continue;
    const Eigen::Vector3d own = shape.pose.linear().col(2);
    if (own.cross(axis).norm() < across) return "";
    const bool is_upright = own.cross(Eigen::Vector3d::UnitZ()).norm() < across;
    const bool is_about_y = axis.cross(Eigen::Vector3d::UnitY()).norm() < across;
    return std::string(", and its cylinder along that axis, for it lies flat") +
           (is_upright && is_about_y ? ": rpy=\"1.5708 0 0\" in the <origin> of its <collision> and <visual>" : "");
  }
  return "";
}

}  // namespace

std::string doubt_of_place(const XMLElement& element, const char* width, double is, double expected) {
  if (std::abs(is + expected) <= placement_tolerance) return "; are left and right exchanged?";
  const char* radius = element.Attribute("wheel_radius");
  const auto given = radius ? parse_number(radius) : std::nullopt;
  if (given && std::abs(*given - 2 * std::abs(is)) <= placement_tolerance)
    return std::string("; are wheel_radius and ") + width + " exchanged?";
  return doubt_of_length(element, width, 2 * std::abs(expected), 2 * std::abs(is));
}

void read_motors(const Source& source, const XMLElement& element, DifferentialDrive& drive) {
  drive.max_torque = positive(source, element, "max_torque");
  drive.max_speed = positive(source, element, "max_speed");
  if (element.Attribute("max_acceleration")) drive.max_acceleration = positive(source, element, "max_acceleration");
  drive.friction = positive(source, element, "friction");
}

DifferentialDrive read_differential(const Source& source, const XMLElement& element, Robot& robot) {
  only_attributes(source, element,
                  {"left", "right", "wheel_radius", "wheel_base", "max_torque", "max_speed", "max_acceleration",
                   "friction", "effective_base"});
  DifferentialDrive drive;
  take_wheels(find_joints(source, element, "left", robot), find_joints(source, element, "right", robot), drive);
  drive.wheel_radius = positive(source, element, "wheel_radius");
  drive.wheel_base = positive(source, element, "wheel_base");
  read_motors(source, element, drive);
  if (element.Attribute("effective_base")) drive.effective_base = positive(source, element, "effective_base");
  complete_drive(source, element, drive, robot);
  return drive;
}

double round_about_axle(const Robot& robot, const Joint& joint) {
  double result = 0;
  for (const Shape& shape : rigid_shapes(robot, joint.child)) {
    if (shape.pose.translation().cross(joint.axis).norm() > placement_tolerance) continue;
    if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) result = std::max(result, sphere->radius);
    const auto* cylinder = std::get_if<Cylinder>(&shape.geometry);
    constexpr double rounded = 1e-3;  // [rad]: a right angle in few digits
    if (cylinder && shape.pose.linear().col(2).cross(joint.axis).norm() < rounded)
      result = std::max(result, cylinder->radius);
  }
  return result;
}

void take_wheels(const std::vector<std::size_t>& left, const std::vector<std::size_t>& right,
                 DifferentialDrive& drive) {
  drive.left = left.front();
  drive.right = right.front();
  for (std::size_t i = 1; i < left.size(); ++i) drive.followers.push_back({left[i], 0});
  for (std::size_t i = 1; i < right.size(); ++i) drive.followers.push_back({right[i], 1});
}

void complete_drive(const Source& source, const XMLElement& element, DifferentialDrive& drive, Robot& robot) {
  const int line = element.GetLineNum();
  std::array<std::vector<Eigen::Vector3d>, 2> middles;
  for (const Follower& wheel : drive.wheels()) {
    turn_forward(source, element, wheel.joint, robot);
    const double y = (wheel.side == 0 ? 0.5 : -0.5) * drive.wheel_base;
    middles[static_cast<std::size_t>(wheel.side)].push_back(check_wheel(source, element, robot, wheel.joint, y));
  }
  auto& [left, right] = middles;
  if (left.size() != right.size()) {
    source.fail(line, tag(element) + "has " + std::to_string(left.size()) + " wheels on the left and " +
                          std::to_string(right.size()) + " on the right; expected as many");
  }
  for (auto& side : middles)
    std::sort(side.begin(), side.end(), [](const auto& a, const auto& b) { return a.x() > b.x(); });
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (std::hypot(left[i].x() - right[i].x(), left[i].z() - right[i].z()) > placement_tolerance)
      source.fail(line, tag(element) + (left.size() == 1 ? "the wheels are not on one axle"
                                                         : "the wheels of both sides are not on the same axles"));
    if (std::abs(left[i].z() - left[0].z()) > placement_tolerance)
      source.fail(line, tag(element) + "the axles are not at one height");
  }
  for (const Follower& wheel : drive.wheels()) {
    check_radius(source, element, robot, wheel.joint, drive.wheel_radius);
    balance_wheel(wheel.joint, robot);
  }
  if (drive.effective_base == 0) {
    std::vector<double> ways;
    for (const Eigen::Vector3d& middle : left) ways.push_back(middle.x());
    const double mean = std::accumulate(ways.begin(), ways.end(), 0.0) / static_cast<double>(ways.size());
    for (double& way : ways) way -= mean;
    drive.effective_base = effective_base(drive.wheel_base, ways);
  }
  warn_of_height(source, element, left[0].z(), drive.wheel_radius, robot);
  warn_of_creeping(source, element, drive, robot);
}

namespace {

// Of the joints from the robot's root to a link, the first that moves; there is one.
std::size_t first_moving(const Robot& robot, std::size_t link) {
  std::size_t result = 0;
  for (bool is_root = false; !is_root;) {
    is_root = true;
    for (std::size_t i = 0; i < robot.joints.size(); ++i) {
      if (robot.joints[i].child != link) continue;
      if (robot.joints[i].kind != JointKind::fixed) result = i;
      link = robot.joints[i].parent, is_root = false;
      break;
    }
  }
  return result;
}

// True where an attribute of the element names the joint.
bool is_named_in(const XMLElement& element, const std::string& joint) {
  for (const auto* attribute = element.FirstAttribute(); attribute; attribute = attribute->Next()) {
    std::istringstream names(attribute->Value());
    for (std::string name; names >> name;)
      if (name == joint) return true;
  }
  return false;
}

}  // namespace

std::size_t find_joint(const Source& source, const XMLElement& element, const char* attribute, const Robot& robot) {
  return find_named(source, element, attribute, required(source, element, attribute), robot);
}

Eigen::Vector3d place_of_turning(const Source& source, const XMLElement& element, const Robot& robot,
                                 std::size_t index) {
  const Joint& joint = robot.joints[index];
  int line = element.GetLineNum();
  std::string what = tag(element) + "joint '" + joint.name + "' ";
  if (const int own = line_of_joint(element, joint.name); own > 0) {  // else it is of another file
    what = "joint '" + joint.name + "', a wheel of " + tag(element) + "(line " + std::to_string(line) + "), ";
    line = own;
  }
  if (joint.kind != JointKind::continuous)
    source.fail(line, what + "is " + law_of(joint.kind).name + "; expected type=\"continuous\"");
  const auto carrier = frame_on_body(robot, joint.parent);
  if (!carrier) {
    const Joint& between = robot.joints[first_moving(robot, joint.parent)];
    const int own = line_of_joint(element, between.name);
    if (own > 0 && is_named_in(element, between.name))  // the body hangs on one of its wheels
      source.fail(own, "joint '" + between.name + "', a wheel of " + tag(element) + "(line " +
                           std::to_string(element.GetLineNum()) + "), carries link '" +
                           robot.links[between.child].name + "', on which is the wheel of joint '" + joint.name +
                           "'; are <parent> and <child> of '" + between.name + "' exchanged?");
    source.fail(line, what + "is not on the robot's body: joint '" + between.name + "' between them moves");
  }
  const Eigen::Isometry3d frame = *carrier * joint.origin;
  const Eigen::Vector3d axis = frame.linear() * joint.axis;
  if (!(axis - Eigen::Vector3d::UnitY()).isZero(axis_tolerance)) {
    refuse_degrees(source, *element.GetDocument()->RootElement(), robot, index);
    const double off = std::atan2(axis.cross(Eigen::Vector3d::UnitY()).norm(), axis.y()) * 180 / 3.141592653589793;
    const Eigen::Vector3d meant = frame.linear().transpose() * Eigen::Vector3d::UnitY();
    const auto clean = [](double v) { return print_exactly(std::abs(v) < 1e-4 ? 0 : std::round(v * 1e6) / 1e6 + 0.0); };
    source.fail(line, what + "does not turn about the body's +y axis: its own is " + print_number(off) +
                          " degrees off; expected <axis xyz=\"" + clean(meant.x()) + " " + clean(meant.y()) + " " +
                          clean(meant.z()) + "\"/>" + lying_flat(robot, joint, meant));
  }
  return frame.translation();
}

void read_muster(const Source& source, const XMLElement& muster, Robot& robot) {
  only_attributes(source, muster, {"restitution"});
  if (muster.Attribute("restitution")) robot.restitution = share(source, muster, "restitution");
  const std::vector<std::string> known = {"differential", "ackermann", "mecanum", "quadrotor", "legs", "ball", "laser"};
  for (const auto* child = muster.FirstChildElement(); child; child = child->NextSiblingElement()) {
    const std::string name = child->Name();
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      source.fail(child->GetLineNum(),
                  "<" + name +
                      "> is not known in <muster>; expected <differential>, <ackermann>, <mecanum>, "
                      "<quadrotor>, <legs>, <ball> or <laser>" +
                      nearest(name, known));
    }
    if (name == "ball") {
      read_ball(source, *child, robot);
      continue;
    }
    if (name == "laser") {
      read_laser(source, *child, robot);
      continue;
    }
    if (robot.drive || robot.quadrotor || robot.legs) source.fail(child->GetLineNum(), "has a second drive");
    if (name == "differential") robot.drive = read_differential(source, *child, robot);
    if (name == "ackermann") robot.drive = read_ackermann(source, *child, robot);
    if (name == "mecanum") robot.drive = read_mecanum(source, *child, robot);
    if (name == "quadrotor") robot.quadrotor = read_quadrotor(source, *child, robot);
    if (name == "legs") robot.legs = read_legs(source, *child, robot);
  }
}

}  // namespace muster::description
