#include "limbs.hpp"

#include <cmath>

#include "motion.hpp"

namespace muster::simbody {

using description::JointKind;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

constexpr int n = unknowns_with_legs;
constexpr double hold = 1e-6, none = 1e30;  // softness of a held joint [rad/s per N m s], and of a free one
constexpr double without_end = 1e9;         // [N m s]
using Columns = ColumnsOfUnknowns;

Quaterniond turn_of(const Limb& limb) {
  const Quaterniond q(limb.qw, limb.qx, limb.qy, limb.qz);
  return q.squaredNorm() > 0 ? q.normalized() : Quaterniond::Identity();
}

Matrix3d turned_by(const Vector3d& rotation) {
  const double angle = rotation.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix() : Matrix3d::Identity();
}

// A rigid part of the robot with its columns of unknowns; its accelerations are those at constant unknowns.
struct Moving {
  Vector3d at = Vector3d::Zero();  // its origin, from the body's
  Columns turning = Columns::Zero(), going = Columns::Zero();
  Vector3d spin = Vector3d::Zero(), spin_rate = Vector3d::Zero(), acceleration = Vector3d::Zero();

  // Moves on to a place fixed to it.
  void go_to(const Vector3d& place) {
    const Vector3d way = place - at;
    going -= cross_matrix(way) * turning;
    acceleration += spin_rate.cross(way) + spin.cross(spin.cross(way));
    at = place;
  }
};

Moving root(const VelocityOf<n>& u) {
  Moving body;
  body.turning.leftCols<3>().setIdentity();
  body.going.middleCols<3>(3).setIdentity();
  body.spin = u.head<3>();
  return body;
}

Moving carried(const LimbModel& limb, const Posture::Place& place, const Moving& carrier, const VelocityOf<n>& u) {
  Moving moving = carrier;
  moving.go_to(place.at);
  const Vector3d axis = place.joint * limb.axis;
  if (limb.kind == JointKind::ball) {
    moving.turning.setZero();
    moving.turning.middleCols<3>(limb.first).setIdentity();
    moving.spin = u.segment<3>(limb.first);
    moving.spin_rate.setZero();
  } else if (limb.kind == JointKind::prismatic) {
    moving.going.col(limb.first) += axis;
    moving.acceleration += 2 * carrier.spin.cross(axis * u[limb.first]);
  } else {
    moving.turning.col(limb.first) += axis;
    moving.spin_rate += carrier.spin.cross(axis * u[limb.first]);
    moving.spin += axis * u[limb.first];
  }
  return moving;
}

// `turned`: the axes in which the mass is given.
void add(const description::Mass& mass, const Matrix3d& turned, Moving moving, const Vector3d& fall,
         LimbedMass& result) {
  moving.go_to(moving.at + turned * mass.centre);
  const Matrix3d inertia = turned * mass.inertia * turned.transpose();
  const Vector3d pull = mass.mass * (fall - moving.acceleration);
  const Vector3d twist = -(inertia * moving.spin_rate + moving.spin.cross(inertia * moving.spin));
  result.mass +=
      mass.mass * moving.going.transpose() * moving.going + moving.turning.transpose() * inertia * moving.turning;
  result.force += moving.going.transpose() * pull + moving.turning.transpose() * twist;
}

// Wheels are balanced: their rotation with the body is in its core, and their own spin is added here.
void add_wheels(const RobotModel& robot, const Posture& posture, const VelocityOf<n>& u, LimbedMass& result) {
  const Vector3d axle = posture.body.col(1);
  for (int w = 0; w < 2; ++w) {
    const double inertia = robot.wheel[w].inertia(2, 2);
    result.mass(6 + w, 6 + w) = inertia;
    result.mass.block<3, 1>(0, 6 + w) = inertia * axle;
    result.mass.block<1, 3>(6 + w, 0) = inertia * axle.transpose();
    result.force.head<3>() -= u.head<3>().cross(inertia * u[6 + w] * axle);
  }
}

}  // namespace

Posture posture_of(const RobotModel& robot, const Limbs& limbs, const Matrix3d& body) {
  Posture posture;
  posture.body = body;
  for (std::size_t i = 0; i < robot.limbs.size(); ++i) {
    const LimbModel& limb = robot.limbs[i];
    const Limb& now = limbs.limb[i];
    const Matrix3d& carrier = limb.carrier < 0 ? body : posture.limb[limb.carrier].turned;
    auto& [joint, turned, at] = posture.limb[i];
    joint = carrier * limb.frame.linear();
    at = carrier * limb.frame.translation();
    if (limb.carrier >= 0) at += posture.limb[limb.carrier].at;
    turned = joint;
    if (limb.kind == JointKind::ball) {
      turned = joint * turn_of(now).toRotationMatrix();
    } else if (limb.kind == JointKind::prismatic) {
      at += now.way * (joint * limb.axis);
    } else {
      turned = joint * Eigen::AngleAxisd(now.angle, limb.axis).toRotationMatrix();
    }
  }
  return posture;
}

LimbColumns columns_at(const RobotModel& robot, const Posture& posture, int limb, const Vector3d& place) {
  std::array<int, Limbs::most> chain;  // outwards
  int count = 0;
  for (int i = limb; i >= 0; i = robot.limbs[i].carrier) chain[count++] = i;
  const VelocityOf<n> still = VelocityOf<n>::Zero();
  Moving moving = root(still);
  while (count > 0) {
    const int i = chain[--count];
    moving = carried(robot.limbs[i], posture.limb[i], moving, still);
  }
  moving.go_to(place);
  return {moving.going, moving.turning};
}

LimbedMass weigh(const RobotModel& robot, const Posture& posture, const VelocityOf<n>& u, const Vector3d& fall) {
  LimbedMass result;
  result.mass.setZero(), result.damping.setZero(), result.force.setZero();
  const Moving body = root(u);
  add(robot.core, posture.body, body, fall, result);
  if (robot.has_wheels) add_wheels(robot, posture, u, result);
  std::array<Moving, Limbs::most> moving;
  for (std::size_t i = 0; i < robot.limbs.size(); ++i) {
    const LimbModel& limb = robot.limbs[i];
    const Moving& carrier = limb.carrier < 0 ? body : moving[limb.carrier];
    moving[i] = carried(limb, posture.limb[i], carrier, u);
    add(limb.mass, posture.limb[i].turned, moving[i], fall, result);
    if (limb.kind == JointKind::ball) {
      const Columns relative = moving[i].turning - carrier.turning;
      result.damping += limb.damping * relative.transpose() * relative;
    } else {
      result.damping(limb.first, limb.first) += limb.damping;
    }
  }
  for (int k = 6; k < n; ++k) {
    if (result.mass(k, k) == 0) result.mass(k, k) = 1;  // unused, without torque
  }
  return result;
}

void take_rates(const RobotModel& robot, const Posture& posture, const Limbs& limbs, VelocityOf<n>& u) {
  std::array<Vector3d, Limbs::most> spin;
  for (std::size_t i = 0; i < robot.limbs.size(); ++i) {
    const LimbModel& limb = robot.limbs[i];
    const Limb& now = limbs.limb[i];
    spin[i] = limb.carrier < 0 ? Vector3d(u.head<3>()) : spin[limb.carrier];
    const Matrix3d& joint = posture.limb[i].joint;
    if (limb.kind == JointKind::ball) {
      spin[i] += joint * Vector3d(now.wx, now.wy, now.wz);
      u.segment<3>(limb.first) = spin[i];
    } else if (limb.kind == JointKind::prismatic) {
      u[limb.first] = now.speed;
    } else {
      u[limb.first] = now.rate;
      spin[i] += now.rate * (joint * limb.axis);
    }
  }
}

void leave_rates(const RobotModel& robot, const Posture& posture, const VelocityOf<n>& u, Limbs& limbs) {
  std::array<Vector3d, Limbs::most> spin;
  for (std::size_t i = 0; i < robot.limbs.size(); ++i) {
    const LimbModel& limb = robot.limbs[i];
    Limb& now = limbs.limb[i];
    spin[i] = limb.carrier < 0 ? Vector3d(u.head<3>()) : spin[limb.carrier];
    const Matrix3d& joint = posture.limb[i].joint;
    if (limb.kind == JointKind::ball) {
      const Vector3d w = joint.transpose() * (u.segment<3>(limb.first) - spin[i]);
      now.wx = w.x(), now.wy = w.y(), now.wz = w.z();
      spin[i] = u.segment<3>(limb.first);
    } else if (limb.kind == JointKind::prismatic) {
      now.speed = u[limb.first];
    } else {
      now.rate = u[limb.first];
      spin[i] += now.rate * (joint * limb.axis);
    }
  }
}

void move_limbs(const RobotModel& robot, double h, const Matrix3d& body, const VelocityOf<n>& u, Posture& posture,
                Limbs& limbs) {
  const Posture before = posture;
  for (std::size_t i = 0; i < robot.limbs.size(); ++i) {
    const LimbModel& limb = robot.limbs[i];
    Limb& now = limbs.limb[i];
    if (limb.kind == JointKind::prismatic) {
      now.way += h * u[limb.first];
    } else if (limb.kind != JointKind::ball) {
      now.angle += h * u[limb.first];
    } else {  // its carrier has moved already, but for its own turn
      const Matrix3d joint = posture_of(robot, limbs, body).limb[i].joint;
      const Matrix3d turned = turned_by(h * u.segment<3>(limb.first)) * before.limb[i].turned;
      const Quaterniond q = Quaterniond(joint.transpose() * turned).normalized();
      now.qw = q.w(), now.qx = q.x(), now.qy = q.y(), now.qz = q.z();
    }
  }
  posture = posture_of(robot, limbs, body);
}

Motor joint_motor(const LimbModel& limb, double kick) {
  return {0, limb.friction * kick, limb.friction > 0 ? hold : none};
}

void stop_at_limits(const LimbModel& limb, const Limb& now, double rate, double h, Motor& motor) {
  const double position = limb.kind == JointKind::prismatic ? now.way : now.angle, then = position + h * rate;
  if (then < limb.lower) motor = {(limb.lower - position) / h, without_end, hold};
  if (then > limb.upper) motor = {(limb.upper - position) / h, without_end, hold};
}

}  // namespace muster::simbody
