#include "description/robot.hpp"

namespace muster::description {

namespace {

// Steiner's term (parallel-axis theorem): the inertia of a point mass at p about the origin.
Eigen::Matrix3d point_inertia(double mass, const Eigen::Vector3d& p) {
  return mass * (p.squaredNorm() * Eigen::Matrix3d::Identity() - p * p.transpose());
}

// Calls visit(index, frame in the link's own) for the link and for all links that joints accepted by `through` attach
// to it.
template <class Through, class Visit>
void walk(const Robot& robot, std::size_t link, Through through, Visit visit) {
  std::vector<std::optional<Eigen::Isometry3d>> frames(robot.links.size());
  frames[link] = Eigen::Isometry3d::Identity();
  visit(link, *frames[link]);
  for (const Joint& joint : robot.joints) {  // parents come first
    if (!frames[joint.parent] || !through(joint)) continue;
    frames[joint.child] = *frames[joint.parent] * joint.origin;
    visit(joint.child, *frames[joint.child]);
  }
}

bool is_fixed(const Joint& joint) { return joint.kind == JointKind::fixed; }
bool is_any(const Joint&) { return true; }

template <class Through>
std::vector<Shape> shapes_through(const Robot& robot, std::size_t link, Through through) {
  std::vector<Shape> shapes;
  walk(robot, link, through, [&](std::size_t i, const Eigen::Isometry3d& frame) {
    for (Shape shape : robot.links[i].shapes) {
      shape.pose = frame * shape.pose;
      shapes.push_back(std::move(shape));
    }
  });
  return shapes;
}

}  // namespace

Mass operator+(const Mass& a, const Mass& b) {
  if (b.mass == 0) return a;
  if (a.mass == 0) return b;
  Mass sum;
  sum.mass = a.mass + b.mass;
  sum.centre = (a.mass * a.centre + b.mass * b.centre) / sum.mass;
  sum.inertia = a.inertia + point_inertia(a.mass, a.centre - sum.centre) + b.inertia +
                point_inertia(b.mass, b.centre - sum.centre);
  return sum;
}

Mass in_parent(const Eigen::Isometry3d& frame, const Mass& mass) {
  return {mass.mass, frame * mass.centre, frame.linear() * mass.inertia * frame.linear().transpose()};
}

Mass rigid_mass(const Robot& robot, std::size_t link) {
  Mass sum;
  walk(robot, link, is_fixed,
       [&](std::size_t i, const Eigen::Isometry3d& frame) { sum = sum + in_parent(frame, robot.links[i].mass); });
  return sum;
}

std::vector<Shape> rigid_shapes(const Robot& robot, std::size_t link) { return shapes_through(robot, link, is_fixed); }

namespace {

bool is_kingpin(const Robot& robot, const Joint& joint) {
  if (!robot.drive || !robot.drive->steering) return false;
  const auto& kingpins = robot.drive->steering->kingpins;
  return joint.child == robot.joints[kingpins[0]].child || joint.child == robot.joints[kingpins[1]].child;
}

}  // namespace

std::vector<Shape> body_shapes(const Robot& robot) {
  return shapes_through(robot, 0, [&](const Joint& joint) { return is_fixed(joint) && !is_kingpin(robot, joint); });
}

std::vector<Shape> steered_shapes(const Robot& robot, std::size_t side) {
  const std::size_t link = robot.joints[robot.drive->steering->kingpins[side]].child;
  const Eigen::Isometry3d frame = *frame_on_body(robot, link);
  std::vector<Shape> shapes = shapes_through(robot, link, is_fixed);
  for (Shape& shape : shapes) shape.pose = frame * shape.pose;
  return shapes;
}

std::vector<Shape> whole_shapes(const Robot& robot) { return shapes_through(robot, 0, is_any); }

Mass whole_mass(const Robot& robot) {
  Mass sum;
  walk(robot, 0, is_any,
       [&](std::size_t i, const Eigen::Isometry3d& frame) { sum = sum + in_parent(frame, robot.links[i].mass); });
  return sum;
}

std::optional<Eigen::Isometry3d> frame_on_body(const Robot& robot, std::size_t link) {
  std::optional<Eigen::Isometry3d> result;
  walk(robot, 0, is_fixed, [&](std::size_t i, const Eigen::Isometry3d& frame) {
    if (i == link) result = frame;
  });
  return result;
}

}  // namespace muster::description
