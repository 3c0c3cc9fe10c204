#include <algorithm>
#include <cmath>

#include "description/file_text.hpp"
#include "description/urdf_check.hpp"

namespace muster::description {

using tinyxml2::XMLElement;

namespace {

LegDrive::Leg read_leg(const Source& source, const XMLElement& element, const Robot& robot, double radius) {
  const int line = element.GetLineNum();
  if (element.Name() != std::string("leg")) {
    source.fail(line, std::string("<legs> has no element <") + element.Name() + ">; expected <leg>");
  }
  only_attributes(source, element, {"joint", "tripod"});
  LegDrive::Leg leg;
  leg.joint = find_joint(source, element, "joint", robot);
  const std::string tripod = required(source, element, "tripod");
  if (tripod != "1" && tripod != "2") {
    source.fail(line, "<leg> tripod=\"" + tripod + "\" is wrong; expected 1 or 2");
  }
  leg.tripod = tripod == "2";
  leg.hip = place_of_turning(source, element, robot, leg.joint);
  if (!rigid_shapes(robot, robot.joints[leg.joint].child).empty()) {
    source.fail(line, "<leg> joint '" + robot.joints[leg.joint].name +
                          "' has a link with a <collision>; a leg is a half circle, and nothing else of it touches");
  }
  if (std::abs(leg.hip.z() - 2 * radius) > placement_tolerance) {
    source.fail(line, "<leg> joint '" + robot.joints[leg.joint].name +
                          "' is not two radii above the ground, which is at z = 0 of the robot's frame");
  }
  return leg;
}

// Checks for three legs on each side, which turn the robot, and for two tripods, each of which carries it.
void check_tripods(const Source& source, int line, const Robot& robot, const LegDrive& drive) {
  const auto is_left = [](const LegDrive::Leg& leg) { return leg.hip.y() > 0; };
  const auto left = std::count_if(drive.legs.begin(), drive.legs.end(), is_left);
  if (left != 3) source.fail(line, "<legs> has " + std::to_string(left) + " legs on the left side; expected 3");
  const Eigen::Vector3d centre = whole_mass(robot).centre;
  for (int tripod = 0; tripod < 2; ++tripod) {
    std::vector<Eigen::Vector2d> feet;
    for (const LegDrive::Leg& leg : drive.legs) {
      if (leg.tripod == tripod) feet.push_back(leg.hip.head<2>());
    }
    const std::string what = "<legs> tripod " + std::to_string(tripod + 1);
    if (feet.size() != 3) source.fail(line, what + " has " + std::to_string(feet.size()) + " legs; expected 3");
    int left_of = 0;  // sides that the mass centre is left of
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector2d side = feet[(k + 1) % 3] - feet[k], to = centre.head<2>() - feet[k];
      left_of += side.x() * to.y() - side.y() * to.x() > 0;
    }
    if (left_of % 3 != 0) source.fail(line, what + " does not stand under the robot's centre of mass");
  }
}

}  // namespace

LegDrive read_legs(const Source& source, const XMLElement& element, const Robot& robot) {
  only_attributes(
      source, element,
      {"radius", "position_gain", "rate_gain", "max_torque", "max_speed", "friction", "stiffness", "damping"});
  const int line = element.GetLineNum();
  LegDrive drive;
  drive.radius = positive(source, element, "radius");
  drive.position_gain = positive(source, element, "position_gain");
  drive.rate_gain = positive(source, element, "rate_gain");
  drive.max_torque = positive(source, element, "max_torque");
  drive.max_speed = positive(source, element, "max_speed");
  drive.friction = positive(source, element, "friction");
  if (element.Attribute("stiffness")) drive.stiffness = positive(source, element, "stiffness");
  if (element.Attribute("damping")) drive.damping = positive(source, element, "damping");
  if (drive.is_rigid() && drive.damping > 0) source.fail(line, "<legs> has a damping, but no stiffness");
  std::size_t count = 0;
  for (const auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement(), ++count) {
    const LegDrive::Leg leg = read_leg(source, *child, robot, drive.radius);
    if (count == LegDrive::count) source.fail(child->GetLineNum(), "<legs> has more than 6 legs");
    const auto end = drive.legs.begin() + static_cast<std::ptrdiff_t>(count);
    if (std::any_of(drive.legs.begin(), end, [&](const auto& other) { return other.joint == leg.joint; })) {
      source.fail(child->GetLineNum(), "<leg> joint '" + robot.joints[leg.joint].name + "' has a leg already");
    }
    drive.legs[count] = leg;
  }
  if (count != LegDrive::count) source.fail(line, "<legs> has " + std::to_string(count) + " legs; expected 6");
  check_tripods(source, line, robot, drive);
  return drive;
}

}  // namespace muster::description
