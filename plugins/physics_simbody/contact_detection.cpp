#include "contact_detection.hpp"

#include <algorithm>
#include <cmath>

#include "compliance.hpp"

namespace muster::simbody {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Creep of a sticking contact between robots, as a share of the speed that its friction removes: at most 0.06 mm/s
// between two Scarabs that push each other with all their wheels.
constexpr double creep_of_pairs = 2.4e-3;
constexpr double slack = 0.003;   // [m] margin for other forces on contacts that would not close by themselves
constexpr double nearby = 0.003;  // [m] least distance of contact detection

constexpr double longest_way_of_corners = 0.005;  // [m] limit of corners passing each other in one step

// Rows of a robot's velocity for a contact at `place` on its body, wheel, leg or limb, with the sign of its side. A
// wheel's tread moves along the contact only.
template <int N, class Side>
ContactRowsOf<N> rows_at(const Side& side, const Vector3d& place, const Matrix3d& frame, double sign) {
  const PlacedOf<N>& robot = *side.robot;
  const int wheel = side.wheel, leg = side.leg;
  const Matrix3d to_body = robot.to_world.transpose();
  const Vector3d arm = to_body * (place - robot.position);
  const Matrix3d ways = sign * (to_body * frame);
  ContactRowsOf<N> rows;
  if constexpr (N == unknowns_with_legs) {
    if (side.limb >= 0) {
      const auto columns = columns_at(*robot.model, robot.posture_ahead, side.limb, arm);
      rows.normal = columns.going.transpose() * ways.col(0);
      for (int k = 0; k < 2; ++k) rows.tangent[k] = columns.going.transpose() * ways.col(1 + k);
      return rows;
    }
  }
  rows.normal = point_row<N>(arm, ways.col(0));
  for (int k = 0; k < 2; ++k) {
    rows.tangent[k] = point_row<N>(arm, ways.col(1 + k));
    if (wheel < 0) continue;
    const Vector3d centre = robot.model->hub_of(wheel);
    rows.tangent[k][6 + robot.model->joint_of(wheel)] = Vector3d::UnitY().cross(arm - centre).dot(ways.col(1 + k));
  }
  if (leg >= 0) {
    const Vector3d turning = Vector3d::UnitY().cross(arm - robot.model->legs[leg].hip);
    rows.normal[6 + leg] = turning.dot(ways.col(0));
    for (int k = 0; k < 2; ++k) rows.tangent[k][6 + leg] = turning.dot(ways.col(1 + k));
  }
  return rows;
}

// Upper bound of the speed of the first side near `place` relative to the second, or to a static one [m/s].
template <int N, class Side>
double closing_speed(const Side& a, const Side& b, const Vector3d& place) {
  Vector3d velocity = Vector3d::Zero(), spin = Vector3d::Zero();
  const auto add = [&](const Side& side, double sign) {
    const PlacedOf<N>& robot = *side.robot;
    if constexpr (N == unknowns_with_legs) {
      if (side.limb >= 0) {
        const Vector3d arm = robot.to_world.transpose() * (place - robot.position);
        const auto columns = columns_at(*robot.model, robot.posture_ahead, side.limb, arm);
        spin += sign * (robot.to_world * (columns.turning * robot.body.previous));
        velocity += sign * (robot.to_world * (columns.going * robot.body.previous));
        return;
      }
    }
    const Vector3d w = sign * (robot.to_world * robot.body.previous.template head<3>());
    spin += w;
    velocity += sign * (robot.to_world * robot.body.previous.template segment<3>(3)) + w.cross(place - robot.position);
  };
  add(a, 1);
  if (b.robot) add(b, -1);
  return velocity.norm() + a.robot->model->reach * spin.norm();
}

Matrix3d frame_about(const Vector3d& normal) {
  Matrix3d frame;
  frame.col(0) = normal;
  frame.col(1) = normal.unitOrthogonal();
  frame.col(2) = normal.cross(frame.col(1));
  return frame;
}

// Legs are numbered after the parts of the body.
std::size_t leg_part(int leg) { return 48 + static_cast<std::size_t>(leg); }

// 0 for the ground, odd for walls, even for robots.
double id_of(int partner, std::size_t part, std::size_t other_part, int mark) {
  return (1 + partner * 64.0 + static_cast<double>(part % 64)) * 64 * 16384 +
         static_cast<double>(other_part % 64) * 16384 + mark;
}

template <int N>
Solid placed(const Part& part, const PlacedOf<N>& robot) {
  const Solid& solid = part.solid;
  if (part.limb >= 0) {
    const Posture::Place& limb = robot.posture_ahead.limb[part.limb];
    return {solid.kind, robot.position + robot.to_world * (limb.at + limb.turned * solid.centre),
            robot.to_world * limb.turned * solid.axes, solid.half};
  }
  return {solid.kind, robot.position + robot.to_world * solid.centre, robot.to_world * solid.axes, solid.half};
}

bool may_touch(const Solid& a, const Solid& b, double margin) {
  const double reach = a.reach() + b.reach() + margin;
  return (a.centre - b.centre).squaredNorm() < reach * reach;
}

// Conservative test: a lower bound of the distance between a solid's middle and the wall.
bool may_touch_wall(const Solid& solid, const Solid& wall, double margin) {
  const Vector3d p = wall.axes.transpose() * (solid.centre - wall.centre);
  return ((p.cwiseAbs() - wall.half).array() < solid.reach() + margin).all();
}

}  // namespace

template <int N>
void EncountersOf<N>::begin(double h, double friction, bool somebody_bounces) {
  h_ = h;
  friction_ = friction;
  somebody_bounces_ = somebody_bounces;
  contacts.clear();
  traces.clear();
  meetings.clear();
}

template <int N>
double EncountersOf<N>::margin(double speed) const {
  return nearby + h_ * speed;
}

template <int N>
void EncountersOf<N>::with_ground(int body, const Placed& robot, const Memory& memory) {
  stand(body, robot, memory);
  if (!robot.model->legs.empty()) stand_on_legs(body, robot, memory);
  // Boxes and cylinders of driven robots reach the ground only after tipping.
  const double near = margin(robot.speed);
  const bool is_low = robot.position.z() + robot.model->lowest_corner(robot.to_world.row(2)) <= near;
  if (!is_low && !robot.model->feels_limbs()) return;
  for (std::size_t k = 0; k < robot.model->parts.size(); ++k) {
    const Part& part = robot.model->parts[k];
    if (!robot.model->stands_on(part) || (!is_low && part.limb < 0)) continue;
    const Touch t = touch_ground(placed(part, robot), near);
    for (int n = 0; n < t.count; ++n) {
      const Trace trace{robot.index, id_of(0, k, 0, t.points[n].mark), frame_about(t.normal)};
      add(side(body, robot, part), {}, trace, memory, t.points[n]);
    }
  }
}

template <int N>
void EncountersOf<N>::with_wall(int body, const Placed& robot, const Memory& memory, int wall_index,
                                const Solid& wall) {
  const double near = margin(robot.speed);
  for (std::size_t k = 0; k < robot.solids.size(); ++k) {
    if (!may_touch_wall(robot.solids[k], wall, near)) continue;
    const Touch t = touch(robot.solids[k], wall, near);
    for (int n = 0; n < t.count; ++n) {
      const Trace trace{robot.index, id_of(1 + 2 * wall_index, k, 0, t.points[n].mark), frame_about(t.normal)};
      add(side(body, robot, robot.model->parts[k]), {}, trace, memory, t.points[n]);
    }
  }
  each_leg_at(robot, wall, near, [&](int leg, const LegTouch& t) {
    const Trace trace{robot.index, id_of(1 + 2 * wall_index, leg_part(leg), 0, t.point.mark), frame_about(t.normal)};
    add({&robot, body, -1, leg}, {}, trace, memory, t.point);
  });
}

template <int N>
void EncountersOf<N>::between(int body_a, const Placed& a, const Memory& memory_a, int body_b, const Placed& b) {
  const double near = margin(a.speed + b.speed);
  const Vector3d middle_of_b = b.position + b.to_world * b.model->middle;
  for (std::size_t i = 0; i < a.solids.size(); ++i) {
    const double reach = a.solids[i].reach() + b.model->reach + near;
    if ((a.solids[i].centre - middle_of_b).squaredNorm() >= reach * reach) continue;
    for (std::size_t j = 0; j < b.solids.size(); ++j) {
      if (!may_touch(a.solids[i], b.solids[j], near)) continue;
      const Touch t = touch(a.solids[i], b.solids[j], near);
      for (int n = 0; n < t.count; ++n) {
        const Trace trace{a.index, id_of(2 + 2 * b.index, i, j, t.points[n].mark), frame_about(t.normal)};
        add(side(body_a, a, a.model->parts[i]), side(body_b, b, b.model->parts[j]), trace, memory_a, t.points[n]);
      }
    }
  }
  for (std::size_t j = 0; j < b.solids.size(); ++j) {
    each_leg_at(a, b.solids[j], near, [&](int leg, const LegTouch& t) {
      const Trace trace{a.index, id_of(2 + 2 * b.index, leg_part(leg), j, t.point.mark), frame_about(t.normal)};
      add({&a, body_a, -1, leg}, side(body_b, b, b.model->parts[j]), trace, memory_a, t.point);
    });
  }
  for (std::size_t i = 0; i < a.solids.size(); ++i) {
    each_leg_at(b, a.solids[i], near, [&](int leg, const LegTouch& t) {
      const Trace trace{a.index, id_of(2 + 2 * b.index, i, leg_part(leg), t.point.mark), frame_about(-t.normal)};
      add(side(body_a, a, a.model->parts[i]), {&b, body_b, -1, leg}, trace, memory_a, t.point);
    });
  }
}

// Calls meet(leg, touch) for legs that touch the solid, or soon would.
template <int N>
template <class Meet>
void EncountersOf<N>::each_leg_at(const Placed& robot, const Solid& solid, double margin, Meet meet) const {
  const double radius = robot.model->leg_drive.radius;
  for (std::size_t i = 0; i < robot.model->legs.size(); ++i) {
    const Leg& leg = robot.model->legs[i];
    const double c = std::cos(robot.leg_angle[i]), s = std::sin(robot.leg_angle[i]);
    const Vector3d ahead = robot.to_world * Vector3d(c, 0, -s), above = robot.to_world * Vector3d(s, 0, c);
    const Vector3d hip = robot.position + robot.to_world * leg.hip;
    const Solid around{Solid::Kind::sphere, hip - radius * above, Matrix3d::Identity(), Vector3d::Constant(radius)};
    if (!may_touch(around, solid, margin)) continue;
    const LegTouches t = touch_leg(hip, ahead, above, radius, solid, margin);
    for (int n = 0; n < t.count; ++n) meet(static_cast<int>(i), t.touch[n]);
  }
}

// Each leg rolls on its lowest point.
template <int N>
void EncountersOf<N>::stand_on_legs(int body, const Placed& robot, const Memory& memory) {
  const double near = margin(robot.speed);
  const description::LegDrive& drive = robot.model->leg_drive;
  const Vector3d up = robot.to_world.row(2);
  for (std::size_t i = 0; i < robot.model->legs.size(); ++i) {
    const Leg& leg = robot.model->legs[i];
    if (robot.position.z() + up.dot(leg.hip) > 2 * drive.radius + near) continue;
    const double angle = robot.leg_angle[i];
    const Vector3d place =
        robot.position + robot.to_world * (leg.hip + drive.place(angle, drive.lowest_way(angle, up)));
    if (place.z() > near) continue;
    const Trace trace{robot.index, id_of(0, leg_part(static_cast<int>(i)), 0, 0), frame_about(Vector3d::UnitZ())};
    add({&robot, body, -1, static_cast<int>(i)}, {}, trace, memory, {place, place.z(), 0});
  }
}

// Adds a contact unless it cannot close within this step.
template <int N>
void EncountersOf<N>::add(const Side& a, const Side& b, Trace trace, const Memory& memory, const TouchPoint& point) {
  Contact c;
  static_cast<ContactRowsOf<N>&>(c) = rows_at<N>(a, point.place, trace.frame, 1);
  double speed = c.normal.dot(a.robot->body.previous), free = c.normal.dot(a.robot->body.free), mass = a.robot->mass;
  if (b.robot) {
    c.of_other = rows_at<N>(b, point.place, trace.frame, -1);
    speed += c.of_other.normal.dot(b.robot->body.previous);
    free += c.of_other.normal.dot(b.robot->body.free);
    mass = 2 * a.robot->mass * b.robot->mass / (a.robot->mass + b.robot->mass);
    c.grip_softness = creep_of_pairs / mass;
  }
  const double gap = point.gap - 0.5 * h_ * speed;            // at the step's start
  const double least_gap = gap + h_ * std::min(speed, free);  // at the step's end
  if (a.leg < 0 && b.leg < 0) {
    const auto is_too_far = [&](double way) { return way > std::max(gap, longest_way_of_corners); };
    trace.step_is_too_long =
        gap < -never_so_deep || (point.of_corners && is_too_far(h_ * closing_speed<N>(a, b, point.place)));
  }
  if (least_gap > slack && !trace.step_is_too_long) return;
  c.body = a.body;
  c.other = b.body;
  c.friction = a.leg >= 0 && !b.robot ? a.robot->model->leg_drive.friction : friction_;
  const description::LegDrive* leg = a.leg >= 0   ? &a.robot->model->leg_drive
                                     : b.leg >= 0 ? &b.robot->model->leg_drive
                                                  : nullptr;
  if (leg && !leg->is_rigid()) {
    if (gap > 0 || h_ == 0) return;
    const Spring spring(*leg, h_);
    c.softness = spring.softness;
    c.target = spring.target(gap, speed);
  } else {
    const Compliance compliance(mass, h_);
    c.softness = compliance.softness;
    c.target = compliance.target(gap, h_);
  }
  for (const KeptImpulse& kept : memory.kept) {
    if (kept.id != trace.id) continue;
    const Vector3d impulse = trace.frame.transpose() * Vector3d(kept.impulse[0], kept.impulse[1], kept.impulse[2]);
    c.push = impulse[0];
    c.grip = impulse.tail<2>();
  }
  contacts.push_back(c);
  traces.push_back(trace);
  if (somebody_bounces_) {
    const double elastic = std::min(a.robot->model->restitution, (b.robot ? b : a).robot->model->restitution);
    meetings.push_back({gap, leg ? 0 : elastic});
  }
}

Solid solid_of(const scene::Slab& slab) {
  Matrix3d axes;
  axes << slab.cos_yaw, -slab.sin_yaw, 0, slab.sin_yaw, slab.cos_yaw, 0, 0, 0, 1;
  return {Solid::Kind::box, {slab.x, slab.y, slab.z}, axes, {slab.length / 2, slab.thickness / 2, slab.height / 2}};
}

template <int N>
void place_parts(PlacedOf<N>& robot) {
  robot.solids.clear();
  for (const Part& part : robot.model->parts) robot.solids.push_back(placed(part, robot));
}

template <int N>
void keep(const ContactOf<N>& contact, const Trace& trace, Memory& memory) {
  if (trace.wheel >= 0) {
    memory.impulse[trace.wheel] = {contact.push, contact.grip[0], contact.grip[1]};
    return;
  }
  if (trace.id == 0 || !(contact.push > 0)) return;
  const Vector3d impulse = trace.frame * Vector3d(contact.push, contact.grip[0], contact.grip[1]);
  KeptImpulse made{trace.id, {impulse[0], impulse[1], impulse[2]}};
  const auto size = [](const KeptImpulse& k) {
    return Vector3d(k.impulse[0], k.impulse[1], k.impulse[2]).squaredNorm();
  };
  for (KeptImpulse& kept : memory.kept) {  // sorted, the strongest first
    if (kept.id == 0 || size(made) > size(kept)) std::swap(made, kept);
    if (made.id == 0) return;
  }
}

template class EncountersOf<unknowns>;
template class EncountersOf<unknowns_with_legs>;
template void place_parts(PlacedOf<unknowns>&);
template void place_parts(PlacedOf<unknowns_with_legs>&);
template void keep(const ContactOf<unknowns>&, const Trace&, Memory&);
template void keep(const ContactOf<unknowns_with_legs>&, const Trace&, Memory&);

}  // namespace muster::simbody
