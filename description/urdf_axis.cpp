// Axes of joints that rounded figures put beside an axis of the robot's frame.
#include <cmath>

#include "description/file_text.hpp"
#include "description/urdf_check.hpp"

namespace muster::description {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double degree = 0.017453292519943295;  // [rad]
// [rad] An axis nearer than `exact` stays as it is; up to `rounded` it is taken for one of figures cut short, as an rpy
// of 1.57 (0.046 degrees off).
constexpr double exact = 1e-6, rounded = degree;

// Roll, pitch and yaw as URDF has them: R = Rz(yaw) Ry(pitch) Rx(roll).
std::string rpy_text(const Matrix3d& r) {
  const auto clean = [](double v) { return print_exactly(std::abs(v) < 1e-12 ? 0 : v); };
  return clean(std::atan2(r(2, 1), r(2, 2))) + " " + clean(std::atan2(-r(2, 0), std::hypot(r(2, 1), r(2, 2)))) + " " +
         clean(std::atan2(r(1, 0), r(0, 0)));
}

}  // namespace

void snap_axes(const Source& source, const Outline& outline, Robot& robot) {
  std::vector<Matrix3d> turned(robot.links.size(), Matrix3d::Identity());  // of each link, in the root's frame
  for (Joint& joint : robot.joints) {                                      // parents come first
    const Matrix3d& carrier = turned[joint.parent];
    Matrix3d& own = turned[joint.child];
    own = carrier * joint.origin.linear();
    if (!law_of(joint.kind).has_axis) continue;
    const Vector3d axis = own * joint.axis;
    int nearest = 0;
    axis.cwiseAbs().maxCoeff(&nearest);
    const Vector3d unit = std::copysign(1.0, axis[nearest]) * Vector3d::Unit(nearest);
    const double off = std::atan2(axis.cross(unit).norm(), axis.dot(unit));
    if (off <= exact || off >= rounded) continue;
    const Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(axis, unit).toRotationMatrix();
    own = turn * own;
    joint.origin.linear() = carrier.transpose() * own;
    const std::string name = std::string(unit[nearest] > 0 ? "+" : "-") + "xyz"[nearest];
    robot.warnings.push_back(source.file + ":" + std::to_string(outline.joint_lines.at(joint.name)) + ": joint '" +
                             joint.name + "': its axis is " + print_number(off / degree) + " degrees off the robot's " +
                             name + " axis, and is turned onto it; write <origin rpy=\"" +
                             rpy_text(joint.origin.linear()) + "\"/>");
  }
}

}  // namespace muster::description
