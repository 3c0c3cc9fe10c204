#include "model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "block_cholesky.hpp"
#include "state.hpp"

namespace muster::simbody {

using SimTK::Vec3;

namespace {

Vec3 vec(const Eigen::Vector3d& v) { return Vec3(v.x(), v.y(), v.z()); }

// Simbody takes the inertia about the body's origin, not about its centre of mass.
SimTK::MassProperties properties(const description::Mass& mass) {
  const auto& i = mass.inertia;
  const SimTK::Inertia central(Vec3(i(0, 0), i(1, 1), i(2, 2)), Vec3(i(0, 1), i(0, 2), i(1, 2)));
  return {mass.mass, vec(mass.centre), central.shiftFromMassCenter(-vec(mass.centre), mass.mass)};
}

SimTK::Transform transform(const Eigen::Isometry3d& frame) {
  SimTK::Mat33 m;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) m(r, c) = frame.linear()(r, c);
  }
  return {SimTK::Rotation(m), vec(frame.translation())};
}

// A wheel whose mass is the same at every angle: the block stepper turns it without moving its mass.
bool balanced(const description::Mass& wheel, const Eigen::Vector3d& axis) {
  const double size = wheel.inertia.trace();
  const double along = axis.dot(wheel.inertia * axis);
  const Eigen::Matrix3d across = wheel.inertia - along * axis * axis.transpose();
  const Eigen::Matrix3d even = (across.trace() / 2) * (Eigen::Matrix3d::Identity() - axis * axis.transpose());
  return wheel.centre.cross(axis).norm() < 1e-6 && (across - even).norm() < 1e-6 * size;
}

Solid solid_of(const Eigen::Isometry3d& frame, const description::Shape& shape) {
  const Eigen::Isometry3d pose = frame * shape.pose;
  Solid solid{Solid::Kind::box, pose.translation(), pose.linear(), {}};
  if (const auto* box = std::get_if<description::Box>(&shape.geometry)) {
    solid.half = 0.5 * box->size;
  } else if (const auto* sphere = std::get_if<description::Sphere>(&shape.geometry)) {
    solid.kind = Solid::Kind::sphere;
    solid.half.setConstant(sphere->radius);
  } else if (const auto* cylinder = std::get_if<description::Cylinder>(&shape.geometry)) {
    solid.kind = Solid::Kind::cylinder;
    solid.half = {cylinder->radius, cylinder->radius, 0.5 * cylinder->length};
  } else {
    Eigen::AlignedBox3d around;
    for (const Eigen::Vector3d& vertex : std::get<description::Mesh>(shape.geometry).vertices) around.extend(vertex);
    solid.centre = pose * around.center();
    solid.half = 0.5 * around.sizes();
  }
  return solid;
}

[[noreturn]] void refuse(const description::Robot& robot, const std::string& why) {
  throw std::runtime_error("robot model '" + robot.name + "' (" + robot.file +
                           ") cannot be simulated by physics.simbody: " + why);
}

Eigen::Isometry3d frame_on_body(const description::Robot& robot, const description::Joint& joint) {
  Eigen::Isometry3d frame = joint.origin;
  for (std::size_t link = joint.parent; link != 0; link = robot.joints[link - 1].parent) {
    frame = robot.joints[link - 1].origin * frame;
  }
  return frame;
}

}  // namespace

RobotModel::RobotModel(const description::Robot& robot) : name(robot.name) {
  is_driven = robot.is_driven();
  has_wheels = robot.drive.has_value();
  rotors = robot.quadrotor;
  restitution = robot.restitution;
  body = rigid_mass(robot, 0);
  if (!(body.mass > 0)) refuse(robot, "its body has no mass");
  core = body;
  if (robot.legs) take_legs(robot);
  if (has_wheels) take_wheels(robot);
  take_limbs(robot);
  for (const description::Shape& shape : body_shapes(robot)) {
    if (const auto* sphere = std::get_if<description::Sphere>(&shape.geometry); sphere && is_driven) {
      sliders.push_back({shape.pose.translation(), sphere->radius});
    }
    parts.push_back({solid_of(Eigen::Isometry3d::Identity(), shape)});
  }
  for (std::size_t side = 0; has_wheels && drive.steering && side < 2; ++side) {
    for (const description::Shape& shape : steered_shapes(robot, side))
      parts.push_back({solid_of(Eigen::Isometry3d::Identity(), shape), -1, -1, true});
  }
  measure_limbs();
  measure();
}

void RobotModel::take_wheels(const description::Robot& robot) {
  drive = *robot.drive;
  int number = 0;
  for (const description::Follower& one : drive.wheels()) {
    const description::Joint& joint = robot.joints[one.joint];
    FollowingWheel made{one.side, rigid_mass(robot, joint.child), frame_on_body(robot, joint)};
    if (!balanced(made.mass, joint.axis)) {
      refuse(robot, "the wheel of joint '" + joint.name +
                        "' is not balanced about its axis by more than rounded figures (5 %); expected its centre of "
                        "mass on the axle and the same inertia about all axes across it");
    }
    for (const description::Shape& shape : rigid_shapes(robot, joint.child))
      parts.push_back({solid_of(made.frame, shape), number});
    // Simbody's pin turns about z: turn the joint's frame so that its z is the axle.
    const Eigen::Quaterniond to_axis = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), joint.axis);
    made.frame = made.frame * to_axis;
    made.mass = in_parent(Eigen::Isometry3d(to_axis.inverse()), made.mass);
    core = core + in_parent(made.frame, made.mass);
    if (number < 2) {
      wheel[static_cast<std::size_t>(number)] = made.mass;
      wheel_frame[static_cast<std::size_t>(number)] = made.frame;
    } else {
      followers.push_back(made);
    }
    ++number;
  }
}

void RobotModel::take_legs(const description::Robot& robot) {
  leg_drive = *robot.legs;
  for (const auto& leg : leg_drive.legs) {
    const description::Joint& joint = robot.joints[leg.joint];
    const Eigen::Isometry3d turned(frame_on_body(robot, joint).linear());
    legs.push_back({leg.hip, in_parent(turned, rigid_mass(robot, joint.child))});
  }
}

void RobotModel::take_limbs(const description::Robot& robot) {
  int next = has_wheels ? 8 : 6;
  for (const description::LimbJoint& limb : limbs_of(robot)) {
    const description::Joint& joint = robot.joints[limb.joint];
    if (robot.legs) refuse(robot, "joint '" + joint.name + "' has no motor; what walks may not have limbs");
    if (!followers.empty())
      refuse(robot, "joint '" + joint.name + "' has no motor; a robot on more than two wheels may not have limbs");
    if (limb.carrier == description::LimbJoint::driven) refuse(robot, "joint '" + joint.name + "' hangs on a wheel");
    if (const std::string what = unmodelled(joint); !what.empty())
      refuse(robot, "joint '" + joint.name + "' (" + law_of(joint.kind).name + ") without a motor " + what);
    for (const description::Shape& shape : rigid_shapes(robot, joint.child))
      parts.push_back({solid_of(Eigen::Isometry3d::Identity(), shape), -1, static_cast<int>(limbs.size())});
    limbs.push_back({limb_model(robot, limb), next});
    next += law_of(joint.kind).rates;
  }
  if (limbs.size() > Limbs::most || next > unknowns_with_legs) {
    refuse(robot, "its joints without motors have " + std::to_string(next - (has_wheels ? 8 : 6)) +
                      " rates; expected at most 4 joints, of 4 rates beside wheels and of 6 beside rotors");
  }
}

double LimbModel::travel() const {
  return kind == description::JointKind::prismatic ? std::max(std::abs(lower), std::abs(upper)) : 0;
}

bool RobotModel::feels_limbs() const {
  return std::any_of(limbs.begin(), limbs.end(), [](const LimbModel& limb) { return limb.reach > 0; });
}

// Limbs come after their carriers.
void RobotModel::measure_limbs() {
  for (const Part& part : parts) {
    if (part.limb < 0) continue;
    double& reach_of_it = limbs[part.limb].reach;
    reach_of_it = std::max(reach_of_it, part.solid.centre.norm() + part.solid.reach());
  }
  for (auto limb = limbs.rbegin(); limb != limbs.rend(); ++limb) {
    if (limb->carrier < 0 || limb->reach <= 0) continue;
    double& reach_of_carrier = limbs[limb->carrier].reach;
    reach_of_carrier = std::max(reach_of_carrier, limb->frame.translation().norm() + limb->travel() + limb->reach);
  }
}

// Extents of all parts; a leg by a circle of its length about its hip, a limb by a sphere about its joint.
void RobotModel::measure() {
  const double leg = 2 * leg_drive.radius;
  Eigen::AlignedBox3d around(Eigen::Vector3d::Zero().eval());
  const auto each_limb_on_body = [this](const auto& see) {
    for (const LimbModel& limb : limbs) {
      if (limb.carrier < 0 && limb.reach > 0) see(limb.frame.translation(), limb.travel() + limb.reach);
    }
  };
  for (const Part& part : parts) {
    if (part.limb >= 0) continue;
    const Eigen::Vector3d half = part.solid.axes.cwiseAbs() * part.solid.half;
    around.extend(part.solid.centre - half).extend(part.solid.centre + half);
  }
  for (const Leg& l : legs) {
    const Eigen::Vector3d half(leg, 0, leg);
    around.extend(l.hip - half).extend(l.hip + half);
  }
  each_limb_on_body([&](const Eigen::Vector3d& joint, double span) {
    around.extend(joint - Eigen::Vector3d::Constant(span)).extend(joint + Eigen::Vector3d::Constant(span));
  });
  middle = around.center();
  const Eigen::Vector3d far = around.min().cwiseAbs().cwiseMax(around.max().cwiseAbs());
  arm = {std::hypot(far.y(), far.z()), std::hypot(far.x(), far.z()), std::hypot(far.x(), far.y())};
  for (const Part& part : parts) {
    if (part.limb < 0) reach = std::max(reach, (part.solid.centre - middle).norm() + part.solid.reach());
  }
  for (const Leg& l : legs) reach = std::max(reach, (l.hip - middle).norm() + leg);
  each_limb_on_body(
      [&](const Eigen::Vector3d& joint, double span) { reach = std::max(reach, (joint - middle).norm() + span); });
}

double RobotModel::lowest_corner(const Eigen::Vector3d& up) const {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Part& part : parts) {
    const Solid& solid = part.solid;
    if (part.limb >= 0 || !stands_on(part)) continue;
    const Eigen::Vector3d along = solid.axes.transpose() * up;
    double half_width = solid.half[0];  // of a sphere
    if (solid.kind == Solid::Kind::box) half_width = solid.half.dot(along.cwiseAbs());
    if (solid.kind == Solid::Kind::cylinder)
      half_width = 1.02 * solid.half[0] * along.head<2>().norm() + solid.half[2] * std::abs(along[2]);
    lowest = std::min(lowest, up.dot(solid.centre) - half_width);
  }
  return lowest;
}

double RobotModel::lowest_point(const Eigen::Vector3d& up) const {
  double lowest = lowest_corner(up);
  for (const Slider& slider : sliders) lowest = std::min(lowest, up.dot(slider.centre) - slider.radius);
  return lowest;
}

namespace {

// Simbody's pin turns about z, its slider goes along x.
SimTK::MobilizedBody hang(SimTK::MobilizedBody& carrier, const LimbModel& limb) {
  using description::JointKind;
  const SimTK::Body::Rigid body(properties(limb.mass));
  const Eigen::Vector3d own = limb.kind == JointKind::prismatic ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  const Eigen::Isometry3d to_axis(Eigen::Quaterniond::FromTwoVectors(own, limb.axis));
  if (limb.kind == JointKind::ball)
    return SimTK::MobilizedBody::Ball(carrier, transform(limb.frame), body, SimTK::Transform());
  const SimTK::Transform on_carrier = transform(limb.frame * to_axis), on_limb = transform(to_axis);
  if (limb.kind == JointKind::prismatic) return SimTK::MobilizedBody::Slider(carrier, on_carrier, body, on_limb);
  return SimTK::MobilizedBody::Pin(carrier, on_carrier, body, on_limb);
}

}  // namespace

System::System() : matter(system), forces(system) { SimTK::Force::Gravity(forces, matter, Vec3(0, 0, -gravity)); }

RobotBodies System::add(const RobotModel& model) {
  RobotBodies bodies;
  bodies.body = SimTK::MobilizedBody::Free(matter.updGround(), SimTK::Transform(),
                                           SimTK::Body::Rigid(properties(model.body)), SimTK::Transform());
  const auto pin = [&](const Eigen::Isometry3d& frame, const description::Mass& mass) {
    return SimTK::MobilizedBody::Pin(bodies.body, transform(frame), SimTK::Body::Rigid(properties(mass)),
                                     SimTK::Transform());
  };
  for (std::size_t w = 0; model.has_wheels && w < 2; ++w) bodies.wheel[w] = pin(model.wheel_frame[w], model.wheel[w]);
  for (const FollowingWheel& follower : model.followers) pin(follower.frame, follower.mass);
  // A pin turns about z: turn a leg's frame so that its z is the body's y.
  const Eigen::Quaterniond to_axis =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY());
  for (const Leg& leg : model.legs) {
    bodies.legs.push_back(pin(Eigen::Translation3d(leg.hip) * Eigen::Isometry3d(to_axis),
                              in_parent(Eigen::Isometry3d(to_axis.inverse()), leg.mass)));
  }
  for (const LimbModel& limb : model.limbs) {
    SimTK::MobilizedBody& carrier = limb.carrier < 0 ? bodies.body : bodies.limbs[limb.carrier];
    bodies.limbs.push_back(hang(carrier, limb));
  }
  return bodies;
}

void set_limb(const SimTK::MobilizedBody& body, const LimbModel& model, const Limb& limb, SimTK::State& state) {
  if (model.kind == description::JointKind::ball) {
    const bool is_turned = limb.qw != 0 || limb.qx != 0 || limb.qy != 0 || limb.qz != 0;
    const double turn[] = {is_turned ? limb.qw : 1, limb.qx, limb.qy, limb.qz}, spin[] = {limb.wx, limb.wy, limb.wz};
    for (int k = 0; k < 4; ++k) body.setOneQ(state, k, turn[k]);
    for (int k = 0; k < 3; ++k) body.setOneU(state, k, spin[k]);
    return;
  }
  const bool slides = model.kind == description::JointKind::prismatic;
  body.setOneQ(state, 0, slides ? limb.way : limb.angle);
  body.setOneU(state, 0, slides ? limb.speed : limb.rate);
}

void get_limb(const SimTK::MobilizedBody& body, const LimbModel& model, const SimTK::State& state, Limb& limb) {
  const auto q = [&](int k) { return body.getOneQ(state, k); };
  const auto u = [&](int k) { return body.getOneU(state, k); };
  if (model.kind == description::JointKind::ball) {
    limb = {0, 0, 0, 0, q(0), q(1), q(2), q(3), u(0), u(1), u(2)};
  } else if (model.kind == description::JointKind::prismatic) {
    limb.way = q(0), limb.speed = u(0);
  } else {
    limb.angle = q(0), limb.rate = u(0);
  }
}

void System::finish() {
  state = system.realizeTopology();
  system.realizeModel(state);
}

}  // namespace muster::simbody
