#include "limbs.hpp"

#include <cmath>

namespace muster::ode {

using description::JointKind;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

Quaterniond turn_of(const Limb& limb) {
  const Quaterniond q(limb.qw, limb.qx, limb.qy, limb.qz);
  return q.squaredNorm() > 0 ? q.normalized() : Quaterniond::Identity();
}

// Damping and friction of a joint as motors with target rate 0: one as soft as the damping, the other of the friction's
// strength. `set(parameter, value)` of the motor that `make` makes.
template <class Make, class Set>
void brake(const LimbModel& limb, Make make, Set set) {
  const auto motor = [&](double strength, double softness) {
    dJointID made = make();
    set(made, dParamVel, 0);
    set(made, dParamFMax, strength);
    if (softness > 0) set(made, dParamCFM, softness);
  };
  if (limb.friction > 0) motor(limb.friction, 0);
  if (limb.damping > 0) motor(dInfinity, 1 / limb.damping);
}

void brake_turns(dWorldID world, const LimbModel& limb, dBodyID body, dBodyID carrier, const Matrix3d& axes,
                 int count) {
  const auto make = [&] {
    dJointID motor = dJointCreateAMotor(world, nullptr);
    dJointAttach(motor, body, carrier);
    dJointSetAMotorNumAxes(motor, count);
    for (int k = 0; k < count; ++k) dJointSetAMotorAxis(motor, k, 2, axes(0, k), axes(1, k), axes(2, k));
    return motor;
  };
  brake(limb, make, [count](dJointID motor, int parameter, double value) {
    for (int k = 0; k < count; ++k) dJointSetAMotorParam(motor, parameter + k * dParamGroup, value);
  });
}

void brake_way(dWorldID world, const LimbModel& limb, dBodyID body, dBodyID carrier, const Vector3d& axis) {
  const auto make = [&] {
    dJointID motor = dJointCreateLMotor(world, nullptr);
    dJointAttach(motor, body, carrier);
    dJointSetLMotorNumAxes(motor, 1);
    dJointSetLMotorAxis(motor, 0, 2, axis.x(), axis.y(), axis.z());
    return motor;
  };
  brake(limb, make, dJointSetLMotorParam);
}

}  // namespace

Moving carried(const LimbModel& limb, const Limb& now, const Moving& carrier) {
  const Matrix3d joint = carrier.turned * limb.frame.linear();
  const Vector3d axis = joint * limb.axis;
  Moving result{carrier.at + carrier.turned * limb.frame.translation(), joint, Vector3d::Zero(), carrier.spin};
  if (limb.kind == JointKind::ball) {
    result.turned = joint * turn_of(now).toRotationMatrix();
    result.spin += joint * Vector3d(now.wx, now.wy, now.wz);
  } else if (limb.kind == JointKind::prismatic) {
    result.at += now.way * axis;
  } else {
    result.turned = joint * Eigen::AngleAxisd(now.angle, limb.axis).toRotationMatrix();
    result.spin += now.rate * axis;
  }
  result.velocity = carrier.velocity_at(result.at);
  if (limb.kind == JointKind::prismatic) result.velocity += now.speed * axis;
  return result;
}

Limb hanging(const LimbModel& limb, const Limb& before, const Moving& carrier, const Moving& now) {
  const Matrix3d joint = carrier.turned * limb.frame.linear();
  const Vector3d axis = joint * limb.axis;
  const Quaterniond turn(Matrix3d(joint.transpose() * now.turned));
  const Vector3d spin = joint.transpose() * (now.spin - carrier.spin);
  Limb result;
  if (limb.kind == JointKind::ball) {
    result.qw = turn.w(), result.qx = turn.x(), result.qy = turn.y(), result.qz = turn.z();
    result.wx = spin.x(), result.wy = spin.y(), result.wz = spin.z();
  } else if (limb.kind == JointKind::prismatic) {
    result.way = axis.dot(now.at - carrier.at - carrier.turned * limb.frame.translation());
    result.speed = axis.dot(now.velocity - carrier.velocity_at(now.at));
  } else {
    const double angle = 2 * std::atan2(turn.vec().dot(limb.axis), turn.w());
    result.angle = before.angle + std::remainder(angle - before.angle, 2 * M_PI);
    result.rate = limb.axis.dot(spin);
  }
  return result;
}

void join(dWorldID world, const LimbModel& limb, dBodyID body, dBodyID carrier,
          const Eigen::Isometry3d& frame_of_carrier) {
  const Eigen::Isometry3d frame = frame_of_carrier * limb.frame;
  const Vector3d at = frame.translation(), axis = frame.linear() * limb.axis;
  // ODE ignores a lower stop above the upper one.
  const auto stop = [&](dJointID joint, auto set) {
    if (std::isfinite(limb.lower)) set(joint, dParamLoStop, limb.lower);
    if (std::isfinite(limb.upper)) set(joint, dParamHiStop, limb.upper);
  };
  if (limb.kind == JointKind::ball) {
    dJointID joint = dJointCreateBall(world, nullptr);
    dJointAttach(joint, body, carrier);
    dJointSetBallAnchor(joint, at.x(), at.y(), at.z());
    brake_turns(world, limb, body, carrier, frame.linear(), 3);
  } else if (limb.kind == JointKind::prismatic) {
    dJointID joint = dJointCreateSlider(world, nullptr);
    dJointAttach(joint, body, carrier);
    dJointSetSliderAxis(joint, axis.x(), axis.y(), axis.z());
    stop(joint, dJointSetSliderParam);
    brake_way(world, limb, body, carrier, axis);
  } else {
    dJointID joint = dJointCreateHinge(world, nullptr);
    dJointAttach(joint, body, carrier);
    dJointSetHingeAnchor(joint, at.x(), at.y(), at.z());
    dJointSetHingeAxis(joint, axis.x(), axis.y(), axis.z());
    stop(joint, dJointSetHingeParam);
    Matrix3d axes;
    axes.col(0) = axis;
    brake_turns(world, limb, body, carrier, axes, 1);
  }
}

}  // namespace muster::ode
