// Wheels that a robot is meant to have and that are none as they stand: one that carries the body instead of the other
// way round, and those that can be seen and have no shape to roll on.
#include <algorithm>
#include <optional>
#include <variant>

#include "description/urdf_check.hpp"

namespace muster::description {

using Eigen::Vector3d;
using tinyxml2::XMLElement;

namespace {

constexpr double askew = 0.1;  // of the sine of an angle

bool is_along(const Vector3d& a, const Vector3d& b) { return a.cross(b).norm() < askew; }

// A link that weighs something and is round about the axis, a ball, or a wheel by its name.
bool is_like_a_wheel(const Link& link, const Vector3d& axis) {
  if (!(link.mass.mass > 0)) return false;
  if (is_named_wheel(link.name)) return true;
  const auto is_round = [&](const Shape& shape) {
    return std::holds_alternative<Sphere>(shape.geometry) ||
           (std::holds_alternative<Cylinder>(shape.geometry) && is_along(shape.pose.linear().col(2), axis));
  };
  return !link.shapes.empty() && std::all_of(link.shapes.begin(), link.shapes.end(), is_round);
}

bool is_named_body(const std::string& name) {
  return name == "base_link" || name == "base" || name == "base_footprint" || name == "chassis" || name == "body";
}

// True if a link carries another wheel than the joint itself, directly or by fixed links, about the same direction.
bool carries_another(const Robot& robot, const Joint& first) {
  std::vector<std::optional<Eigen::Isometry3d>> frames(
      robot.links.size());  // in the child; of links that are fixed to it
  frames[first.child] = Eigen::Isometry3d::Identity();
  for (const Joint& joint : robot.joints) {  // parents come first
    if (&joint == &first || !frames[joint.parent]) continue;
    const Eigen::Isometry3d frame = *frames[joint.parent] * joint.origin;
    if (joint.kind == JointKind::fixed) frames[joint.child] = frame;
    if (joint.kind == JointKind::continuous && is_along(frame.linear() * joint.axis, first.axis) &&
        is_like_a_wheel(robot.links[joint.child], joint.axis))
      return true;
  }
  return false;
}

std::string printed(const XMLElement& element) {
  tinyxml2::XMLPrinter printer(nullptr, true);
  element.Accept(&printer);
  return printer.CStr();
}

// A <visual> that rolls: of a link with such a name, or with a cylinder or a ball.
const XMLElement* rolling_visual(const XMLElement& link, bool is_named) {
  for (const auto* visual = link.FirstChildElement("visual"); visual; visual = visual->NextSiblingElement("visual")) {
    const XMLElement* geometry = visual->FirstChildElement("geometry");
    if (!geometry) continue;
    if (is_named || geometry->FirstChildElement("cylinder") || geometry->FirstChildElement("sphere")) return visual;
  }
  return nullptr;
}

}  // namespace

const XMLElement* find_element(const XMLElement& root, const char* kind, const std::string& name) {
  for (const auto* each = root.FirstChildElement(kind); each; each = each->NextSiblingElement(kind)) {
    const char* own = each->Attribute("name");
    if (own && name == own) return each;
  }
  return nullptr;
}

void refuse_exchanged(const Source& source, const XMLElement& root, Robot& robot) {
  for (const Joint& joint : robot.joints) {
    const Link &parent = robot.links[joint.parent], &child = robot.links[joint.child];
    if (joint.kind != JointKind::continuous || joint.parent != 0 || !(parent.mass.mass > 0)) continue;
    const XMLElement* element = find_element(root, "joint", joint.name);
    if (!element) continue;  // of MJCF, whose <body> has no parent to exchange
    const bool is_wheel = is_like_a_wheel(parent, joint.origin.linear() * joint.axis) && !is_named_body(parent.name);
    const bool is_body = is_named_body(child.name);
    if (!is_body && !(is_wheel && carries_another(robot, joint))) continue;
    const std::string what = "joint '" + joint.name + "' has '" + child.name + "' as its <child>, so that '" +
                             parent.name +
                             "' is the robot's root; are <parent> and <child> exchanged? expected <parent link=\"" +
                             child.name + "\"/><child link=\"" + parent.name + "\"/>";
    if (is_wheel) source.fail(element->GetLineNum(), what);
    robot.warnings.push_back(source.file + ":" + std::to_string(element->GetLineNum()) + ": " + what);
  }
}

void warn_of_shapeless_wheels(const Source& source, const XMLElement& root, Robot& robot) {
  for (const Joint& joint : robot.joints) {
    const Link& link = robot.links[joint.child];
    const auto carrier = frame_on_body(robot, joint.parent);
    if (joint.kind != JointKind::continuous || !carrier || !rigid_shapes(robot, joint.child).empty()) continue;
    if (!is_along((*carrier * joint.origin).linear() * joint.axis, Vector3d::UnitY())) continue;
    const XMLElement* element = find_element(root, "link", link.name);
    if (!element || element->FirstChildElement("collision")) continue;  // a mesh that is not read for this caller
    const XMLElement* visual = rolling_visual(*element, is_named_wheel(link.name) || is_named_wheel(joint.name));
    if (!visual) continue;
    const XMLElement *origin = visual->FirstChildElement("origin"), *geometry = visual->FirstChildElement("geometry");
    const bool is_mesh = geometry->FirstChildElement("mesh");
    robot.warnings.push_back(
        source.file + ":" + std::to_string(element->GetLineNum()) + ": link '" + link.name + "' of joint '" +
        joint.name + "' has a <visual> and no <collision>, so that its radius is not known and it is no wheel; " +
        (is_mesh
             ? "expected a <collision> with a <cylinder> of the wheel's radius and width, its axis along the joint's"
             : "copy its <visual> into a <collision>: <collision>" + (origin ? printed(*origin) : "") +
                   printed(*geometry) + "</collision>"));
  }
}

}  // namespace muster::description
