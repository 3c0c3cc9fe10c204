#include <algorithm>
#include <cmath>

#include "description/file_text.hpp"
#include "description/urdf_check.hpp"

namespace muster::description {

using tinyxml2::XMLElement;

namespace {

constexpr double turn = 6.283185307179586;
constexpr int max_samples = 100000;
constexpr double max_rate = 1e6;  // [Hz]

// Reads a <sensor>, with the place for messages.
class Reader {
 public:
  Reader(const Source& source, const XMLElement& element, const std::string& name)
      : source_(source), element_(element), what_("sensor '" + name + "': <" + element.Name() + "> ") {}

  double number(const char* attribute) const { return numbers(attribute, 1)[0]; }
  double number(const char* attribute, double otherwise) const {
    return element_.Attribute(attribute) ? number(attribute) : otherwise;
  }
  double from_0(const char* attribute) const {
    const double value = number(attribute, 0);
    if (value < 0) fail(attribute + std::string("=\"") + element_.Attribute(attribute) + "\" is below 0");
    return value;
  }
  Eigen::Vector3d vector(const char* attribute) const {
    if (!element_.Attribute(attribute)) return Eigen::Vector3d::Zero();
    const auto values = numbers(attribute, 3);
    return {values[0], values[1], values[2]};
  }
  [[noreturn]] void fail(const std::string& message) const { source_.fail(element_.GetLineNum(), what_ + message); }

 private:
  std::vector<double> numbers(const char* attribute, std::size_t count) const {
    const std::string text = required(source_, element_, attribute);
    const auto values = parse_numbers(text);
    if (!values || values->size() != count)
      fail(attribute + ("=\"" + text) + "\" is wrong; expected " + (count == 1 ? "a number" : "3 numbers"));
    return *values;
  }

  const Source& source_;
  const XMLElement& element_;
  std::string what_;
};

const XMLElement& child_of(const Source& source, const XMLElement& element, const char* child,
                           const std::string& what) {
  const XMLElement* found = element.FirstChildElement(child);
  if (!found) source.fail(element.GetLineNum(), what + " has no <" + child + ">");
  return *found;
}

Eigen::Isometry3d origin_of(const Source& source, const XMLElement& sensor, const std::string& name) {
  const XMLElement* element = sensor.FirstChildElement("origin");
  if (!element) return Eigen::Isometry3d::Identity();
  only_attributes(source, *element, {"xyz", "rpy"});
  only_children(source, *element, {});
  const Reader origin(source, *element, name);
  const Eigen::Vector3d angles = origin.vector("rpy");
  return Eigen::Translation3d(origin.vector("xyz")) * Eigen::AngleAxisd(angles[2], Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(angles[1], Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(angles[0], Eigen::Vector3d::UnitX());
}

// Of angles that are none in radians, and may be some in degrees.
std::string in_degrees(double lower, double upper) {
  constexpr double degree = turn / 360;
  if (std::abs(lower) > 360 || std::abs(upper) > 360) return "";
  return "; are these degrees? expected min_angle=\"" + print_number(lower * degree) + "\" max_angle=\"" +
         print_number(upper * degree) + '"';
}

// All rays of a laser are in one plane: <vertical> may only confirm that.
Laser laser_of(const Source& source, const XMLElement& ray, const std::string& name) {
  only_attributes(source, ray, {});
  only_children(source, ray, {"horizontal", "vertical"});
  const XMLElement& element = child_of(source, ray, "horizontal", "sensor '" + name + "': <ray>");
  const std::vector<std::string> known = {"samples", "resolution", "min_angle", "max_angle"};
  only_attributes(source, element, known);
  const Reader horizontal(source, element, name);
  const double samples = horizontal.number("samples", 1);
  if (!(samples >= 1 && samples <= max_samples && samples == std::floor(samples)))
    horizontal.fail(std::string("samples=\"") + element.Attribute("samples") +
                    "\" is wrong; expected a whole number from 1 to 100000");
  if (horizontal.number("resolution", 1) != 1) horizontal.fail("resolution is not 1: a range for each ray");
  Laser laser;
  laser.samples = static_cast<int>(samples);
  laser.min_angle = horizontal.number("min_angle", 0);
  laser.max_angle = horizontal.number("max_angle", 0);
  if (std::abs(laser.min_angle) > turn || std::abs(laser.max_angle) > turn)
    horizontal.fail("goes beyond a whole turn, from " + print_number(laser.min_angle) + " to " +
                    print_number(laser.max_angle) + " rad" + in_degrees(laser.min_angle, laser.max_angle));
  const double sweep = laser.max_angle - laser.min_angle;
  if (laser.samples > 1 ? !(sweep > 0) : sweep != 0)
    horizontal.fail("max_angle is not above min_angle; a single ray has one angle");
  if (sweep > turn) horizontal.fail("sweeps more than a whole turn");
  if (const XMLElement* above = ray.FirstChildElement("vertical")) {
    only_attributes(source, *above, known);
    const Reader vertical(source, *above, name);
    const bool is_flat = vertical.number("samples", 1) == 1 && vertical.number("min_angle", 0) == 0 &&
                         vertical.number("max_angle", 0) == 0;
    if (!is_flat) vertical.fail("is more than one ray at angle 0; a laser's rays lie in one plane");
  }
  return laser;
}

std::size_t find_link(const Source& source, const XMLElement& parent, const Robot& robot, const std::string& sensor) {
  const std::string name = required(source, parent, "link");
  std::vector<std::string> names;
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    if (robot.links[i].name == name) return i;
    names.push_back(robot.links[i].name);
  }
  const std::string remedy = nearest(name, names);
  std::string links;
  for (std::size_t i = 0; remedy.empty() && i < std::min<std::size_t>(names.size(), 30); ++i)
    links += (i == 0 ? "; expected one of its links: " : ", ") + names[i];
  source.fail(parent.GetLineNum(),
              "sensor '" + sensor + "': link '" + name + "' is not known" + (remedy.empty() ? links : remedy));
}

}  // namespace

void read_sensor(const Source& source, const XMLElement& element, Robot& robot) {
  Sensor sensor;
  sensor.name = required(source, element, "name");
  only_attributes(source, element, {"name", "type", "update_rate"});
  const int line = element.GetLineNum();
  const std::string what = "sensor '" + sensor.name + "'";
  for (const Sensor& other : robot.sensors) {
    if (other.name == sensor.name) source.fail(line, what + " is there twice");
  }
  const XMLElement* ray = element.FirstChildElement("ray");
  if (!ray) {
    robot.warnings.push_back(source.file + ":" + std::to_string(line) + ": " + what +
                             " has no <ray>; muster has plugins for lasers alone, so that nothing senses with it");
    return;
  }
  only_children(source, element, {"parent", "origin", "ray"});
  const XMLElement& parent = child_of(source, element, "parent", what);
  only_attributes(source, parent, {"link"});
  const auto carrier = frame_on_body(robot, find_link(source, parent, robot, sensor.name));
  if (!carrier) source.fail(parent.GetLineNum(), what + " is not on the robot's body: a joint between them moves");
  sensor.pose = *carrier * origin_of(source, element, sensor.name);
  sensor.rate = positive(source, element, "update_rate");
  if (sensor.rate > max_rate) source.fail(line, what + ": update_rate is above 1000000 Hz");
  sensor.laser = laser_of(source, *ray, sensor.name);
  robot.sensors.push_back(sensor);
}

void read_laser(const Source& source, const XMLElement& element, Robot& robot) {
  only_attributes(source, element, {"sensor", "min_range", "max_range", "resolution"});
  only_children(source, element, {});
  const std::string name = required(source, element, "sensor");
  std::vector<std::string> names;
  for (const Sensor& sensor : robot.sensors) names.push_back(sensor.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    source.fail(element.GetLineNum(),
                "<laser> sensor '" + name + "' is not known, or has no <ray>" + nearest(name, names));
  }
  Laser& laser = robot.sensors[static_cast<std::size_t>(found - names.begin())].laser;
  const Reader reader(source, element, name);
  if (laser.max_range > 0) reader.fail("has its range already");
  laser.max_range = positive(source, element, "max_range");
  laser.min_range = reader.from_0("min_range");
  laser.resolution = reader.from_0("resolution");
  if (laser.min_range >= laser.max_range) reader.fail("min_range is not below max_range");
  if (laser.resolution > 0 && !(laser.resolution < laser.max_range && laser.resolution > 1e-9 * laser.max_range))
    reader.fail("resolution is not between a billionth of max_range and max_range");
}

void warn_of_blind_lasers(const Source& source, const XMLElement& root, Robot& robot) {
  for (const auto* element = root.FirstChildElement("sensor"); element;
       element = element->NextSiblingElement("sensor")) {
    const auto sensor = std::find_if(robot.sensors.begin(), robot.sensors.end(),
                                     [&](const Sensor& one) { return one.name == element->Attribute("name"); });
    if (sensor == robot.sensors.end() || sensor->laser.max_range > 0) continue;
    robot.warnings.push_back(source.file + ":" + std::to_string(element->GetLineNum()) + ": sensor '" + sensor->name +
                             "' has no range, so that nothing senses with it; expected <muster><laser sensor=\"" +
                             sensor->name + "\" max_range=\"\"/></muster>");
  }
}

}  // namespace muster::description
