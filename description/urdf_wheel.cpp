// Wheels whose inertia rounded figures leave uneven about the axle: engines that turn a wheel without moving its mass
// need it even.
#include <Eigen/Eigenvalues>
#include <cmath>

#include "description/file_text.hpp"
#include "description/urdf_check.hpp"
#include "description/urdf_inertia.hpp"

namespace muster::description {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Relative differences of the moments across the axle, and of the mass centre's distance from it to the radius of
// gyration: below `exact` nothing is to be done, up to `rounded` they are taken for rounded figures, as CAD programs
// write them.
constexpr double exact = 1e-6, rounded = 0.05;

}  // namespace

void balance_wheel(std::size_t index, Robot& robot) {
  const Joint& joint = robot.joints[index];
  const Vector3d& axis = joint.axis;
  const Mass whole = rigid_mass(robot, joint.child);
  if (!(whole.mass > 0)) return;
  const double gyration = std::sqrt(whole.inertia.trace() / whole.mass);
  const Vector3d beside = whole.centre - axis * axis.dot(whole.centre);
  const Matrix3d along = axis * axis.transpose(), round = Matrix3d::Identity() - along;
  const double about = axis.dot(whole.inertia * axis), mean = (whole.inertia.trace() - about) / 2;
  const Matrix3d even = about * along + mean * round;
  const double uneven = (whole.inertia - even).norm() / whole.inertia.trace(), off = beside.norm();
  if (uneven < exact && off < exact) return;
  if (uneven > rounded || off > rounded * gyration) return;  // meant so: an engine that cannot do it refuses it
  Mass& mass = robot.links[joint.child].mass;
  if (!(mass.mass > 0)) return;
  mass.inertia += even - whole.inertia;
  mass.centre -= beside * (whole.mass / mass.mass);
  std::string what;
  if (uneven >= exact) {
    const Matrix3d rest = whole.inertia - even;
    const Vector3d moments = Eigen::SelfAdjointEigenSolver<Matrix3d>(rest).eigenvalues();
    what = "its inertia is uneven about the axle by " + print_number(100 * (moments[2] - moments[0]) / mean) + " %";
  }
  if (off >= exact)
    what += (what.empty() ? "" : " and ") + std::string("its centre of mass is ") + print_number(1000 * off) +
            " mm off the axle";
  robot.warnings.push_back(robot.file + ":" + std::to_string(robot.links[joint.child].line) + ": the wheel of joint '" +
                           joint.name + "': " + what + "; it is taken as balanced; write " + inertial_text(mass) +
                           " in link '" + robot.links[joint.child].name + "'");
}

}  // namespace muster::description
