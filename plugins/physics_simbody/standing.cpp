// The ground under a robot's wheels and sliders.
#include "compliance.hpp"
#include "contact_detection.hpp"

namespace muster::simbody {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Up, and the tangents x and y of the world.
Matrix3d ground_frame() {
  Matrix3d frame;
  frame << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  return frame;
}

// The same with a horizontal direction for the first tangent.
Matrix3d frame_along(const Vector3d& way) {
  Matrix3d frame;
  frame.col(0) = Vector3d::UnitZ();
  frame.col(1) = way;
  frame.col(2) = Vector3d::UnitZ().cross(way);
  return frame;
}

// Steered wheels are numbered after those of drives.
constexpr int steered = 64;

}  // namespace

// Friction along one direction of the body only: a roller or a free wheel rolls across it. The second tangent has no
// row, so that nothing acts along it.
template <int N>
void EncountersOf<N>::hold(const Placed& robot, const Vector3d& arm, const Vector3d& along, int wheel,
                           const Memory& memory, Contact& c) {
  const Matrix3d to_body = robot.to_world.transpose();
  const Vector3d up = to_body.col(2), way = (along - up * up.dot(along)).normalized();
  c.tangent[0] = point_row<N>(arm, way);
  c.tangent[1].setZero();
  if (wheel < steered) {
    const Vector3d surface = Vector3d::UnitY().cross(-robot.model->drive.wheel_radius * up);
    c.tangent[0][6 + robot.model->joint_of(wheel)] = surface.dot(way);
  }
  traces.emplace_back(robot.index, -wheel - 1.0, frame_along(robot.to_world * way));
  for (const KeptImpulse& kept : memory.kept) {
    if (kept.id != -wheel - 1.0) continue;
    const Vector3d impulse(kept.impulse[0], kept.impulse[1], kept.impulse[2]);
    c.push = impulse.z();
    c.grip = {traces.back().frame.col(1).dot(impulse), 0};
  }
}

template <int N>
void EncountersOf<N>::stand(int body, const Placed& robot, const Memory& memory) {
  const Compliance compliance(robot.mass, h_);
  const Matrix3d to_body = robot.to_world.transpose();
  const Vector3d up = to_body.col(2);
  const Vector3d rates = robot.body.previous.template head<3>(), velocity = robot.body.previous.template segment<3>(3);
  const auto add_contact = [&](const Vector3d& arm) -> Contact& {
    Contact& c = contacts.emplace_back();
    c.body = body;
    c.normal = point_row<N>(arm, up);
    c.softness = compliance.softness;
    const double gap = robot.position.z() + up.dot(arm) - 0.5 * h_ * up.dot(velocity + rates.cross(arm));
    c.target = compliance.target(gap, h_);
    if (somebody_bounces_) meetings.push_back({gap, robot.model->restitution});
    return c;
  };
  for (int w = 0; w < robot.model->wheel_count(); ++w) {
    const double radius = robot.model->drive.wheel_radius;
    const Vector3d arm = robot.model->hub_of(w) - radius * up;
    Contact& c = add_contact(arm);
    c.friction = robot.model->drive.friction;
    if (robot.model->drive.mecanum) {
      hold(robot, arm, description::Mecanum::hold(static_cast<std::size_t>(w)), w, memory, c);
      continue;
    }
    const Vector3d surface = Vector3d::UnitY().cross(-radius * up);  // of the tread, per rate
    for (int k = 0; k < 2; ++k) {
      c.tangent[k] = point_row<N>(arm, to_body.col(k));
      c.tangent[k][6 + robot.model->side_of(w)] = surface.dot(to_body.col(k));
    }
    if (w < 2) {
      const auto& impulse = memory.impulse[w];
      c.push = impulse[0];
      c.grip = {impulse[1], impulse[2]};
      traces.emplace_back(robot.index, w);
      continue;
    }
    traces.emplace_back(robot.index, -w, ground_frame());
    for (const KeptImpulse& kept : memory.kept) {
      if (kept.id != -w) continue;
      c.push = kept.impulse[2];
      c.grip = {kept.impulse[0], kept.impulse[1]};
    }
  }
  for (int side = 0; robot.model->has_wheels && robot.model->drive.steering && side < 2; ++side) {
    const description::Steering& car = *robot.model->drive.steering;
    const Vector3d arm = car.middle(side, robot.steering) - car.radius * up;
    Contact& c = add_contact(arm);
    c.friction = robot.model->drive.friction;
    hold(robot, arm, car.axle(side, robot.steering), steered + side, memory, c);
  }
  for (const Slider& slider : robot.model->sliders) {
    add_contact(slider.centre - slider.radius * up);
    traces.emplace_back(robot.index);
  }
}

template void EncountersOf<unknowns>::stand(int, const Placed&, const Memory&);
template void EncountersOf<unknowns_with_legs>::stand(int, const Placed&, const Memory&);

}  // namespace muster::simbody
