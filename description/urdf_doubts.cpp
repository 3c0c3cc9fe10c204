// Figures of a URDF that are legal and look like another unit, or name what is not there.
#include <algorithm>
#include <cmath>

#include "description/file_text.hpp"
#include "description/urdf_check.hpp"

namespace muster::description {

using tinyxml2::XMLElement;

namespace {

constexpr double turn = 6.3;                      // rad; a whole one in two digits
constexpr double degrees_of_turn = 360;           // a limit beyond it means none
constexpr double radians = 0.017453292519943295;  // in a degree
constexpr double stickiest = 5;                   // coefficient of friction; rubber on stone has some 1

class Doubts {
 public:
  Doubts(const Source& source, Robot& robot) : source_(source), robot_(robot) {}

  void look(const XMLElement& element, const std::string& owner) {
    const std::string name = element.Name();
    if (name == "origin") angles(element, owner);
    if (name == "limit") limits(element, owner);
    if (name == "differential" || name == "ackermann" || name == "mecanum" || name == "legs") friction(element);
    for (const auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement())
      look(*child, owner);
  }

  // Gazebo's friction of a wheel, where that of the drive is another. Thousands are "no slip", and no figure.
  void gazebo(const XMLElement& element) {
    const char* link = element.Attribute("reference");
    const auto wheel = std::find_if(robot_.joints.begin(), robot_.joints.end(), [&](const Joint& joint) {
      return link && robot_.links[joint.child].name == link && is_wheel(joint);
    });
    const XMLElement* mu = element.FirstChildElement("mu1");
    const double given = parse_number(mu && mu->GetText() ? mu->GetText() : "").value_or(0);
    constexpr double alike = 0.05;
    if (wheel == robot_.joints.end() || !(given > 0 && given <= stickiest) ||
        std::abs(given - robot_.drive->friction) <= alike)
      return;
    if (!said_friction_)
      warn(*mu, "<gazebo> of '" + std::string(link) + "': <mu1> " + print_number(given) +
                    " is not taken, and the drive's wheels have a friction of " + print_number(robot_.drive->friction) +
                    "; expected friction=\"" + print_number(given) + "\" in <muster>, <differential>");
    said_friction_ = true;
  }

  void transmission(const XMLElement& element) {
    std::vector<std::string> names;
    for (const Joint& joint : robot_.joints) names.push_back(joint.name);
    for (const auto* joint = element.FirstChildElement("joint"); joint; joint = joint->NextSiblingElement("joint")) {
      const char* name = joint->Attribute("name");
      if (!name || std::find(names.begin(), names.end(), name) != names.end()) continue;
      const char* own = element.Attribute("name");
      warn(*joint, "<transmission> '" + std::string(own ? own : "") + "': joint '" + name + "' is not known" +
                       nearest(name, names));
    }
  }

 private:
  bool is_wheel(const Joint& joint) const {
    return robot_.drive && robot_.drive->side_of(static_cast<std::size_t>(&joint - robot_.joints.data())) >= 0;
  }

  // effort="0" velocity="0", as exports of CAD programs have it: of a wheel nobody means that.
  void no_motion(const XMLElement& element, const XMLElement& joint, const std::string& owner) {
    const char* name = joint.Attribute("name");
    std::string zeros;
    for (const char* one : {"effort", "velocity"})
      if (element.Attribute(one) && number(element, one) == 0)
        zeros += (zeros.empty() ? "" : " ") + std::string(one) + "=\"" + element.Attribute(one) + '"';
    const auto own = std::find_if(robot_.joints.begin(), robot_.joints.end(),
                                  [&](const Joint& each) { return name && each.name == name; });
    if (zeros.empty() || own == robot_.joints.end() || !is_wheel(*own)) return;
    warn(element, owner + ": <limit> " + zeros +
                      " would let the wheel not turn, and is taken as no limit; the drive has " +
                      print_number(robot_.drive->max_torque) + " N m and " + print_number(robot_.drive->max_speed) +
                      " rad/s: expected effort=\"" + print_number(robot_.drive->max_torque) + "\" velocity=\"" +
                      print_number(robot_.drive->max_speed) + "\", or no <limit>");
  }

  void warn(const XMLElement& element, const std::string& what) {
    robot_.warnings.push_back(source_.file + ":" + std::to_string(element.GetLineNum()) + ": " + what);
  }

  // 0 where it is not given, or no number.
  static double number(const XMLElement& element, const char* name) {
    const char* text = element.Attribute(name);
    return parse_number(text ? text : "").value_or(0);
  }

  static std::string in_radians(double degrees) {
    return print_number(degrees) + " degrees are " + print_number(degrees * radians) + " rad";
  }

  void angles(const XMLElement& element, const std::string& owner) {
    const char* text = element.Attribute("rpy");
    const auto values = parse_numbers(text ? text : "");
    for (const double angle : values ? *values : std::vector<double>()) {
      if (!(std::abs(angle) > turn)) continue;
      const char* name = element.Parent()->ToElement()->Attribute("name");
      for (Joint& joint : robot_.joints)
        if (element.Parent()->Value() == std::string("joint") && name && joint.name == name) joint.is_in_degrees = true;
      return warn(element, owner + ": <origin> rpy=\"" + text + "\": " + print_number(angle) +
                               " rad is more than a full turn; are these degrees? " + in_radians(angle));
    }
  }

  void limits(const XMLElement& element, const std::string& owner) {
    const XMLElement* joint = element.Parent()->ToElement();
    if (joint) no_motion(element, *joint, owner);
    const char* type = joint ? joint->Attribute("type") : nullptr;
    if (!type || type != std::string("revolute")) return;
    const double lower = number(element, "lower"), upper = number(element, "upper");
    const double largest = std::max(std::abs(lower), std::abs(upper));
    if (largest > turn && largest <= degrees_of_turn)
      warn(element, owner + ": limits of " + print_number(lower) + " to " + print_number(upper) +
                        " rad are more than a full turn; are these degrees? " + in_radians(largest));
  }

  void friction(const XMLElement& element) {
    if (number(element, "friction") > stickiest)
      warn(element, tag(element) + "friction=\"" + element.Attribute("friction") +
                        "\" is more than any tyre has, some 0.8; is this per cent?");
  }

  const Source& source_;
  Robot& robot_;
  bool said_friction_ = false;  // of all wheels alike
};

// `rpy="-1.570796 0 0"` of degrees; "" where no angle is beyond a turn.
std::string meant_angles(const char* rpy) {
  const auto values = parse_numbers(rpy ? rpy : "");
  if (!values || std::none_of(values->begin(), values->end(), [](double v) { return std::abs(v) > turn; })) return "";
  std::string result;
  for (const double degrees : *values) {
    constexpr double digits = 1e6;
    result += (result.empty() ? "" : " ") + print_exactly(std::round(degrees * radians * digits) / digits + 0.0);
  }
  return "rpy=\"" + result + '"';
}

}  // namespace

void refuse_degrees(const Source& source, const XMLElement& root, const Robot& robot, std::size_t joint) {
  for (std::size_t next = joint; next < robot.joints.size();) {
    const Joint& here = robot.joints[next];
    const XMLElement* element = find_element(root, "joint", here.name);
    const XMLElement* origin = element ? element->FirstChildElement("origin") : nullptr;
    const std::string meant = origin ? meant_angles(origin->Attribute("rpy")) : "";
    if (origin && !meant.empty())
      source.fail(origin->GetLineNum(), "joint '" + here.name + "': <origin> rpy=\"" + origin->Attribute("rpy") +
                                            "\": more than a full turn in radians; are these degrees? expected " +
                                            meant);
    const auto above = std::find_if(robot.joints.begin(), robot.joints.end(),
                                    [&](const Joint& each) { return each.child == here.parent; });
    next = static_cast<std::size_t>(above - robot.joints.begin());
  }
}

void warn_of_doubts(const Source& source, const XMLElement& root, Robot& robot) {
  Doubts doubts(source, robot);
  for (const auto* each = root.FirstChildElement(); each; each = each->NextSiblingElement()) {
    const std::string kind = each->Name();
    const char* name = each->Attribute("name");
    if (kind == "gazebo") doubts.gazebo(*each);
    if (kind == "transmission") doubts.transmission(*each);
    if (kind == "link" || kind == "joint" || kind == "sensor" || kind == "muster")
      doubts.look(*each, kind + (name ? " '" + std::string(name) + "'" : ""));
  }
}

}  // namespace muster::description
