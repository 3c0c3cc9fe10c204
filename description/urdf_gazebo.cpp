// What Gazebo's elements say of sensors and drives, as ROS packages keep it beside a URDF.
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "description/file_text.hpp"
#include "description/urdf_check.hpp"
#include "description/urdf_guess.hpp"

namespace muster::description {

using tinyxml2::XMLElement;

namespace {

constexpr double whole_turn = 6.283185307179586;

class Reader {
 public:
  Reader(const Source& source, std::string what) : source_(source), what_(std::move(what)) {}

  // The numbers of an element's text: `count` of them, or the message.
  std::vector<double> numbers(const XMLElement& element, std::size_t count) const {
    const std::string text = element.GetText() ? element.GetText() : "";
    const auto values = parse_numbers(text);
    if (!values || values->size() != count) {
      source_.fail(element.GetLineNum(), what_ + ": <" + element.Name() + "> \"" + text + "\" is wrong; expected " +
                                             (count == 1 ? "a number" : std::to_string(count) + " numbers"));
    }
    return *values;
  }
  double number(const XMLElement& in, const char* name, double otherwise) const {
    const XMLElement* element = in.FirstChildElement(name);
    return element ? numbers(*element, 1)[0] : otherwise;
  }
  double number(const XMLElement& in, std::initializer_list<const char*> names, double otherwise) const {
    for (const char* name : names) {
      if (in.FirstChildElement(name)) return number(in, name, otherwise);
    }
    return otherwise;
  }
  double above_0(const XMLElement& in, const char* name) const {
    const XMLElement* element = in.FirstChildElement(name);
    if (!element) source_.fail(in.GetLineNum(), what_ + ": <" + in.Name() + "> has no <" + name + ">");
    const double value = numbers(*element, 1)[0];
    if (!(value > 0)) fail(*element, std::string("<") + name + "> is not above 0");
    return value;
  }
  const XMLElement& child(const XMLElement& in, const char* name) const {
    const XMLElement* element = in.FirstChildElement(name);
    if (!element) fail(in, std::string("<") + in.Name() + "> has no <" + name + ">");
    return *element;
  }
  [[noreturn]] void fail(const XMLElement& at, const std::string& message) const {
    source_.fail(at.GetLineNum(), what_ + ": " + message);
  }

 private:
  const Source& source_;
  std::string what_;
};

// Of a sweep that is none in radians, and one in degrees.
std::string in_degrees(const Laser& laser) {
  constexpr double degree = whole_turn / 360;
  const double sweep = laser.max_angle - laser.min_angle;
  if (sweep <= 2 * whole_turn || sweep * degree > whole_turn * (1 + 1e-9)) return "";
  return "; are these degrees? expected <min_angle>" + print_number(laser.min_angle * degree) +
         "</min_angle> and <max_angle>" + print_number(laser.max_angle * degree) + "</max_angle>";
}

// Gazebo's <scan> and <range>. A sweep that figures cut short put beyond a whole turn is a whole turn.
Laser laser_of(const Reader& read, const XMLElement& ray) {
  const XMLElement& horizontal = read.child(read.child(ray, "scan"), "horizontal");
  const XMLElement& range = read.child(ray, "range");
  Laser laser;
  const double samples = read.above_0(horizontal, "samples");
  if (samples != std::floor(samples) || samples > 100000) read.fail(horizontal, "expected 1 to 100000 <samples>");
  laser.samples = static_cast<int>(samples);
  laser.min_angle = read.number(horizontal, "min_angle", 0);
  laser.max_angle = read.number(horizontal, "max_angle", 0);
  constexpr double rounded = 1e-4;  // [rad]
  if (laser.max_angle - laser.min_angle > whole_turn + rounded)
    read.fail(horizontal, "sweeps more than a whole turn, from " + print_number(laser.min_angle) + " to " +
                              print_number(laser.max_angle) + " rad" + in_degrees(laser));
  laser.max_angle = std::min(laser.max_angle, laser.min_angle + whole_turn);
  if (laser.samples > 1 && !(laser.max_angle > laser.min_angle))
    read.fail(horizontal, "<max_angle> is not above <min_angle>");
  if (laser.samples == 1) laser.max_angle = laser.min_angle;
  const XMLElement* vertical = read.child(ray, "scan").FirstChildElement("vertical");
  if (vertical && read.number(*vertical, "samples", 1) != 1)
    read.fail(*vertical, "has more than one plane of rays; a laser's rays lie in one plane");
  laser.max_range = read.above_0(range, "max");
  laser.min_range = read.number(range, "min", 0);
  laser.resolution = read.number(range, "resolution", 0);
  if (laser.min_range < 0 || laser.min_range >= laser.max_range)
    read.fail(range, "<min> is not from 0 to below <max>: it is " + print_number(laser.min_range) + ", and <max> " +
                         print_number(laser.max_range));
  if (laser.resolution < 0 || laser.resolution >= laser.max_range)
    read.fail(range, "<resolution> is not from 0 to below <max>");
  return laser;
}

Eigen::Isometry3d pose_of(const Reader& read, const XMLElement& sensor) {
  const XMLElement* element = sensor.FirstChildElement("pose");
  if (!element || !element->GetText()) return Eigen::Isometry3d::Identity();
  const auto p = read.numbers(*element, 6);
  return Eigen::Translation3d(p[0], p[1], p[2]) * Eigen::AngleAxisd(p[5], Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(p[4], Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(p[3], Eigen::Vector3d::UnitX());
}

class Gazebo {
 public:
  Gazebo(const Source& source, Robot& robot) : source_(source), robot_(robot) {}

  void read(const XMLElement& root) {
    for (const auto* element = root.FirstChildElement("gazebo"); element;
         element = element->NextSiblingElement("gazebo")) {
      for (const auto* child = element->FirstChildElement(); child; child = child->NextSiblingElement())
        read_child(*element, *child);
    }
    for (const auto* control = root.FirstChildElement("ros2_control"); control;
         control = control->NextSiblingElement("ros2_control"))
      ignore(*control, "<ros2_control>");
    if (ignored_.empty()) return;
    robot_.warnings.push_back(source_.file + ":" + std::to_string(line_) +
                              ": muster has no part for these, and ignores them: " + ignored_);
  }

 private:
  void read_child(const XMLElement& gazebo, const XMLElement& child) {
    const std::string kind = child.Name();
    const char* name = child.Attribute("name");
    if (kind == "sensor") {
      read_sensor(gazebo, child, name ? name : "");
    } else if (kind == "plugin") {
      if (!read_drive(child)) ignore(child, std::string("plugin '") + (name ? name : "") + "'");
    }  // others are colours, contact parameters and the like of Gazebo's own engines
  }

  void ignore(const XMLElement& element, const std::string& what) {
    if (ignored_.empty()) line_ = element.GetLineNum();
    ignored_ += (ignored_.empty() ? "" : ", ") + what;
  }

  void read_sensor(const XMLElement& gazebo, const XMLElement& element, const std::string& name) {
    const std::string type = element.Attribute("type") ? element.Attribute("type") : "";
    const std::vector<std::string> lasers = {"ray", "gpu_ray", "lidar", "gpu_lidar"};
    if (std::find(lasers.begin(), lasers.end(), type) == lasers.end())
      return ignore(element, "sensor '" + name + "' (" + type + ")");
    for (const Sensor& other : robot_.sensors) {
      if (other.name == name) return;  // <sensor> has it already
    }
    const Reader read(source_, "sensor '" + name + "'");
    const XMLElement* ray = element.FirstChildElement("ray");
    if (!ray) ray = &read.child(element, "lidar");
    const std::string link = required(source_, gazebo, "reference");
    Sensor sensor{name, frame_of(gazebo, link, name) * pose_of(read, element), read.above_0(element, "update_rate"),
                  laser_of(read, *ray)};
    robot_.sensors.push_back(sensor);
    const XMLElement* noise = ray->FirstChildElement("noise");
    const double deviation = noise ? read.number(*noise, "stddev", 0) : 0;
    if (deviation > 0)
      robot_.warnings.push_back(source_.file + ":" + std::to_string(noise->GetLineNum()) + ": sensor '" + name +
                                "': its <noise> of " + print_number(deviation) +
                                " m is not taken; expected <sensors.laser noise=\"" + print_number(deviation) +
                                "\"/> in the world");
  }

  Eigen::Isometry3d frame_of(const XMLElement& gazebo, const std::string& link, const std::string& sensor) const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < robot_.links.size(); ++i) {
      names.push_back(robot_.links[i].name);
      if (names.back() != link) continue;
      const auto frame = frame_on_body(robot_, i);
      if (frame) return *frame;
      source_.fail(gazebo.GetLineNum(),
                   "sensor '" + sensor + "' is not on the robot's body: a joint between them moves");
    }
    source_.fail(gazebo.GetLineNum(), "<gazebo> reference: link '" + link + "' is not known" + nearest(link, names));
  }

  // A differential drive, by the names of its two versions; false for another plugin, and where <muster> has a drive.
  bool read_drive(const XMLElement& plugin) {
    std::array<std::vector<std::size_t>, 2> wheels;
    const char* const names[2][2] = {{"left_joint", "leftJoint"}, {"right_joint", "rightJoint"}};
    for (std::size_t side = 0; side < 2; ++side) {
      for (const char* name : names[side]) {
        for (const auto* joint = plugin.FirstChildElement(name); joint; joint = joint->NextSiblingElement(name))
          wheels[side].push_back(joint_of(*joint));
      }
    }
    if (wheels[0].empty() || wheels[1].empty()) return false;
    if (robot_.is_driven()) return true;
    const Reader read(source_, "the drive in <gazebo>");
    DriveGuess guess{wheels[0], wheels[1]};
    guess.wheel_radius =
        read.number(plugin, "wheel_radius", read.number(plugin, {"wheel_diameter", "wheelDiameter"}, 0) / 2);
    guess.effective_base = read.number(plugin, {"wheel_separation", "wheelSeparation"}, 0);
    check_diameter(plugin, guess);
    guess.max_torque = read.number(plugin, {"max_wheel_torque", "torque", "wheelTorque"}, 0);
    guess.take(source_, plugin, "is taken from <gazebo>", robot_);
    return true;
  }

  // The wheels' size at the tag that gives it, in that tag's own terms: a radius or a diameter.
  void check_diameter(const XMLElement& plugin, const DriveGuess& guess) const {
    const XMLElement* given = nullptr;
    for (const char* name : {"wheelDiameter", "wheel_diameter", "wheel_radius"})
      if (const XMLElement* one = plugin.FirstChildElement(name)) given = one;  // the last is the one that counts
    if (!given || !(guess.wheel_radius > 0)) return;
    for (const auto* side : {&guess.left, &guess.right})
      for (const std::size_t joint : *side) check_size(*given, guess.wheel_radius, robot_.joints[joint]);
  }

  void check_size(const XMLElement& given, double radius, const Joint& joint) const {
    const double real = round_about_axle(robot_, joint);
    if (real == 0 || std::abs(real - radius) <= placement_tolerance) return;
    const std::string name = given.Name();
    const bool is_radius = name == "wheel_radius";
    const std::string own = is_radius ? "radius" : "diameter", other = is_radius ? "diameter" : "radius";
    const std::string meant = print_number(is_radius ? real : 2 * real);
    const std::string shape = " of the collision shape of the wheel of joint '" + joint.name + "'";
    constexpr double alike = 0.02;  // of a length rounded to two digits
    const auto is_times = [&](double factor) { return std::abs(radius - factor * real) < alike * factor * real; };
    const std::string what = is_times(is_radius ? 2 : 0.5) ? " is the " + other + shape + ", and not its " + own
                                                           : " contradicts the " + own + shape + ", which is " + meant;
    std::string expected = "; expected ";
    for (const auto& [unit, parts] : {std::pair{"millimetres", 1000.0}, std::pair{"centimetres", 100.0}})
      if (is_times(parts)) expected = std::string("; is it in ") + unit + "? expected ";
    source_.fail(given.GetLineNum(), tag(given) + print_number(is_radius ? radius : 2 * radius) + what + expected +
                                         "<" + name + ">" + meant + "</" + name + ">");
  }

  std::size_t joint_of(const XMLElement& element) const {
    std::istringstream words(element.GetText() ? element.GetText() : "");
    std::string name;
    words >> name;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < robot_.joints.size(); ++i) {
      if (robot_.joints[i].name == name) return i;
      names.push_back(robot_.joints[i].name);
    }
    source_.fail(element.GetLineNum(), tag(element) + "joint '" + name + "' is not known" + nearest(name, names));
  }

  const Source& source_;
  Robot& robot_;
  std::string ignored_;
  int line_ = 0;
};

}  // namespace

void read_gazebo(const Source& source, const XMLElement& root, Robot& robot) { Gazebo(source, robot).read(root); }

}  // namespace muster::description
