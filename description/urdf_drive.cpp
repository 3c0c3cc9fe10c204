#include <cmath>

#include "description/file_text.hpp"
#include "description/urdf_check.hpp"

namespace muster::description {

using tinyxml2::XMLElement;

namespace {

constexpr double placement_tolerance = 1e-4;  // [m]: a drive that contradicts the joints by more is a mistake

double positive(const Source& source, const XMLElement& element, const char* attribute) {
  const std::string text = required(source, element, attribute);
  const auto value = parse_number(text);
  if (!value || !(*value > 0)) {
    source.fail(element.GetLineNum(),
                std::string("<differential> ") + attribute + "=\"" + text + "\" is wrong; expected a number above 0");
  }
  return *value;
}

std::size_t find_joint(const Source& source, const XMLElement& element, const char* attribute, const Robot& robot) {
  const std::string name = required(source, element, attribute);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    if (robot.joints[i].name == name) return i;
    names.push_back(robot.joints[i].name);
  }
  source.fail(element.GetLineNum(), std::string("<differential> ") + attribute + ": joint '" + name + "' is not known" +
                                        nearest(name, names));
}

// The joint's frame in the root's, or nothing where a joint between them moves.
std::optional<Eigen::Isometry3d> frame_on_body(const Robot& robot, const Joint& joint) {
  Eigen::Isometry3d frame = joint.origin;
  for (std::size_t link = joint.parent; link != 0;) {
    const Joint& above = robot.joints[link - 1];
    if (above.kind != JointKind::fixed) return std::nullopt;
    frame = above.origin * frame;
    link = above.parent;
  }
  return frame;
}

// The axle lies along the body's y axis, left wheel on the left, and turns forward for positive rates.
void check_wheel(const Source& source, int line, const Robot& robot, std::size_t index, double y,
                 Eigen::Vector3d& middle) {
  const Joint& joint = robot.joints[index];
  const std::string what = "<differential> joint '" + joint.name + "' ";
  if (joint.kind != JointKind::continuous) source.fail(line, what + "is not continuous");
  const auto frame = frame_on_body(robot, joint);
  if (!frame) source.fail(line, what + "is not on the robot's body: a joint between them moves");
  if (!(frame->linear() * joint.axis - Eigen::Vector3d::UnitY()).isZero(1e-6)) {
    source.fail(line, what + "does not turn about the body's +y axis");
  }
  middle = frame->translation();
  if (std::abs(middle.y() - y) > placement_tolerance) {
    source.fail(line, what + "is not half a wheel_base from the body's x axis (left: +y, right: -y)");
  }
}

}  // namespace

void read_drive(const Source& source, const XMLElement& muster, Robot& robot) {
  for (const auto* child = muster.FirstChildElement(); child; child = child->NextSiblingElement()) {
    if (child->Name() != std::string("differential")) {
      source.fail(child->GetLineNum(), std::string("<") + child->Name() + "> is not a drive; expected <differential>");
    }
    if (robot.drive) source.fail(child->GetLineNum(), "has a second drive");
    const std::vector<std::string> known = {"left",       "right",     "wheel_radius",     "wheel_base",
                                            "max_torque", "max_speed", "max_acceleration", "friction"};
    for (const auto* attribute = child->FirstAttribute(); attribute; attribute = attribute->Next()) {
      bool is_known = false;
      for (const auto& name : known) is_known = is_known || name == attribute->Name();
      if (!is_known) {
        source.fail(child->GetLineNum(), std::string("<differential> has no attribute '") + attribute->Name() + "'" +
                                             nearest(attribute->Name(), known));
      }
    }
    DifferentialDrive drive;
    drive.left = find_joint(source, *child, "left", robot);
    drive.right = find_joint(source, *child, "right", robot);
    drive.wheel_radius = positive(source, *child, "wheel_radius");
    drive.wheel_base = positive(source, *child, "wheel_base");
    drive.max_torque = positive(source, *child, "max_torque");
    drive.max_speed = positive(source, *child, "max_speed");
    if (child->Attribute("max_acceleration")) drive.max_acceleration = positive(source, *child, "max_acceleration");
    drive.friction = positive(source, *child, "friction");
    Eigen::Vector3d left, right;
    check_wheel(source, child->GetLineNum(), robot, drive.left, drive.wheel_base / 2, left);
    check_wheel(source, child->GetLineNum(), robot, drive.right, -drive.wheel_base / 2, right);
    if (std::hypot(left.x() - right.x(), left.z() - right.z()) > placement_tolerance) {
      source.fail(child->GetLineNum(), "<differential> the wheels are not on one axle");
    }
    robot.drive = drive;
  }
}

}  // namespace muster::description
