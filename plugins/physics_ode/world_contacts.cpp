// Contacts of a step: friction of wheels that slip, of rollers and free wheels, and of all else.
#include <algorithm>

#include "world.hpp"

namespace muster::ode {

using Eigen::Vector3d;

namespace {

constexpr int most_contacts = 8;         // of two shapes: the most that two boxes make
constexpr double slowest_bounce = 0.02;  // [m/s]

}  // namespace

void World::near(void* world, dGeomID a, dGeomID b) {
  if (dGeomIsSpace(a) || dGeomIsSpace(b)) return dSpaceCollide2(a, b, world, near);
  const auto* first = static_cast<const Surface*>(dGeomGetData(a));
  const auto* second = static_cast<const Surface*>(dGeomGetData(b));
  const bool ordered = first->number < second->number;
  auto& pairs = static_cast<World*>(world)->pairs_;
  pairs.push_back(ordered ? Pair{a, b, first, second} : Pair{b, a, second, first});
}

// Contacts of the next step. ODE finds pairs in an order that depends on recent motion: they are sorted.
void World::touch() {
  dJointGroupEmpty(contacts_.get());
  pairs_.clear();
  dSpaceCollide(space_.get(), this, near);
  std::sort(pairs_.begin(), pairs_.end());
  for (const Pair& pair : pairs_) touch(pair);
}

// A skid steer's wheel. Its contact is as soft as to share the weight among more than three wheels, which rigid ones do
// not determine. Friction is Coulomb's law, linear about the slip before the step: its bound along that slip, and
// across it the bound times the share that the velocity there has of the slip. A pyramid would hold the direction of
// the slip.
void World::carry_and_slip(const Pair& pair, dContact& contact) const {
  const Surface& wheel = pair.first->stiffness > 0 ? *pair.first : *pair.second;
  const double stiff = h_ * wheel.stiffness + wheel.damping;
  contact.surface.mode |= dContactSoftERP | dContactSoftCFM;
  contact.surface.soft_erp = h_ * wheel.stiffness / stiff;
  contact.surface.soft_cfm = 1 / stiff;
  if (wheel.frame) return hold(wheel, contact);
  Vector3d slip = Vector3d::Zero();
  const auto add = [&](dGeomID geom, double sign) {
    dBodyID body = dGeomGetBody(geom);
    if (!body) return;
    dVector3 velocity;
    const dReal* at = contact.geom.pos;
    dBodyGetPointVel(body, at[0], at[1], at[2], velocity);
    slip += sign * vector(velocity);
  };
  add(pair.a, 1);
  add(pair.b, -1);
  const Vector3d normal = vector(contact.geom.normal);
  slip -= normal * normal.dot(slip);
  constexpr double slowest = 1e-6;  // [m/s]: below, it rolls
  const double speed = slip.norm();
  if (speed < slowest) return;
  slip /= speed;
  contact.surface.mode |= dContactFDir1 | dContactSlip2;
  contact.surface.slip2 = speed / wheel.grip;
  for (int k = 0; k < 3; ++k) contact.fdir1[k] = slip[k];
}

// Friction along one direction; across it the wheel rolls without.
void World::hold(const Surface& wheel, dContact& contact) {
  const Vector3d normal = vector(contact.geom.normal);
  Vector3d along = quaternion(dBodyGetQuaternion(wheel.frame)) * wheel.along;
  along = (along - normal * normal.dot(along)).normalized();
  contact.surface.mode |= dContactFDir1 | dContactMu2;
  contact.surface.mu2 = 0;
  for (int k = 0; k < 3; ++k) contact.fdir1[k] = along[k];
}

void World::touch(const Pair& pair) {
  dContact contact[most_contacts];
  const int count = dCollide(pair.a, pair.b, most_contacts, &contact[0].geom, sizeof contact[0]);
  for (int i = 0; i < count; ++i) {
    contact[i].surface.mode = dContactApprox1;  // friction's bound follows the normal force
    contact[i].surface.mu = std::min(pair.first->friction, pair.second->friction);
    if (const double share = std::min(pair.first->restitution, pair.second->restitution); share > 0) {
      contact[i].surface.mode |= dContactBounce;
      contact[i].surface.bounce = share;
      contact[i].surface.bounce_vel = slowest_bounce;
    }
    if (pair.first->stiffness > 0 || pair.second->stiffness > 0) carry_and_slip(pair, contact[i]);
    dJointID joint = dJointCreateContact(world_.get(), contacts_.get(), &contact[i]);
    dJointAttach(joint, dGeomGetBody(pair.a), dGeomGetBody(pair.b));
  }
}

}  // namespace muster::ode
