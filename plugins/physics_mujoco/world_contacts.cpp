// Contacts and constraints of a step: which contacts count, and the accelerations that all constraints aim at.
//
// MuJoCo's solver finds the accelerations nearest to the free ones, in the metric of the masses, under the constraints
// of joints and the friction cones of contacts. Its own aims are springs of some time constant. Here each aim is a
// velocity at the end of the step: motors at their rate, contacts closed or bouncing, rolling without slip.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "world.hpp"

namespace muster::mujoco {

using Eigen::Vector3d;

namespace {

constexpr double taken_back = 0.2;       // share of a constraint's error that a step takes back
constexpr double push_out = 0.2;         // highest speed out of penetrations [m/s]
constexpr double slowest_bounce = 0.02;  // [m/s]
constexpr double weakest = 1e-5;         // of a friction coefficient in MuJoCo
constexpr double far_off = -1e9;         // [m/s2]: an aim that no contact needs a force for

// Highest speed at which a gap may close in a step; what overlaps moves apart.
double closing(double gap, double h) { return gap > 0 ? -gap / h : std::min(push_out, -taken_back * gap / h); }

}  // namespace

// Keeps contacts that count, with the friction of their pair.
void World::touch() {
  mjData* d = data_.get();
  int kept = 0;
  for (int c = 0; c < d->ncon; ++c) {
    if (!keep(d->contact[c])) continue;
    if (kept != c) d->contact[kept] = d->contact[c];
    ++kept;
  }
  d->ncon = kept;
}

bool World::keep(mjContact& contact) const {
  const Surface &a = surface(contact.geom1), &b = surface(contact.geom2);
  if (a.robot == b.robot) return false;  // parts of one robot do not collide
  const double friction = std::min(a.friction, b.friction);
  contact.dim = friction > weakest ? 3 : 1;
  std::fill(std::begin(contact.friction), std::end(contact.friction), std::max(friction, weakest));
  if (a.holds_along) hold(a, contact);
  if (b.holds_along) hold(b, contact);
  return true;
}

// Friction along one direction; across it the wheel rolls with MuJoCo's least one.
void World::hold(const Surface& wheel, mjContact& contact) const {
  if (contact.dim == 1) return;
  const double* turned = data_->xmat + 9 * robots_[static_cast<std::size_t>(wheel.robot)].body;
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> body(turned);
  const Vector3d normal(contact.frame[0], contact.frame[1], contact.frame[2]);
  Vector3d along = body * wheel.along;
  along = (along - normal * normal.dot(along)).normalized();
  const Vector3d across = normal.cross(along);
  std::copy(along.data(), along.data() + 3, contact.frame + 3);
  std::copy(across.data(), across.data() + 3, contact.frame + 6);
  contact.friction[1] = weakest;
}

void World::aim(double h) {
  mjData* d = data_.get();
  for (int row = 0; row < d->nefc; ++row) {
    const double velocity = d->efc_vel[row], gap = d->efc_pos[row];
    switch (d->efc_type[row]) {
      case mjCNSTR_EQUALITY:
        d->efc_aref[row] = (-taken_back * gap / h - velocity) / h;
        break;
      case mjCNSTR_FRICTION_DOF:
        d->efc_aref[row] = (wanted_[static_cast<std::size_t>(d->efc_id[row])] - velocity) / h;
        break;
      case mjCNSTR_LIMIT_JOINT:
        d->efc_aref[row] = (closing(gap, h) - velocity) / h;
        break;
      default:
        break;
    }
  }
  for (int c = 0; c < d->ncon; ++c) {
    if (d->contact[c].efc_address >= 0) aim_contact(d->contact[c], h);
  }
}

void World::aim_contact(const mjContact& contact, double h) {
  mjData* d = data_.get();
  const int row = contact.efc_address;
  const double velocity = d->efc_vel[row];
  const double share = std::min(surface(contact.geom1).restitution, surface(contact.geom2).restitution);
  if (share > 0 && velocity < -slowest_bounce) {  // it bounces where it has met
    d->efc_aref[row] = contact.dist > 0 ? far_off : -(1 + share) * velocity / h;
  } else {
    d->efc_aref[row] = (closing(contact.dist, h) - velocity) / h;
  }
  for (int k = 1; k < contact.dim; ++k) d->efc_aref[row + k] = -d->efc_vel[row + k] / h;
}

// MuJoCo's cones are convex: a contact that slips at speed v parts at friction times v. What its aim is lowered by that
// much does not part and has Coulomb's friction (de Saxce's bipotential); the slip is found by iteration, each of which
// takes the error to its share mu2 k / (1 + mu2 k), k being the ratio of the contact's mobilities along and across the
// ground.
void World::solve(double h) {
  constexpr int most = 50;
  constexpr double close_enough = 1e-6;  // of an acceleration [m/s2], and relative
  const mjModel* m = model_.get();
  mjData* d = data_.get();
  const auto contacts = static_cast<std::size_t>(d->ncon);
  base_.assign(contacts, 0);
  const auto slips = [&](std::size_t c) {
    const mjContact& contact = d->contact[c];
    return contact.efc_address >= 0 && contact.dim > 1;
  };
  const auto parting = [&](const mjContact& contact, const double* slip) {
    return std::hypot(contact.friction[0] * slip[1], contact.friction[1] * slip[2]);
  };
  std::vector<double> lowered(contacts, 0);
  for (std::size_t c = 0; c < contacts; ++c) {
    if (!slips(c)) continue;
    const int row = d->contact[c].efc_address;
    base_[c] = d->efc_aref[row];
    lowered[c] = parting(d->contact[c], d->efc_vel + row) / h;
  }
  lag_.assign(static_cast<std::size_t>(d->nefc), 0);
  for (int k = 0; k < most; ++k) {
    for (std::size_t c = 0; c < contacts; ++c) {
      if (slips(c)) d->efc_aref[d->contact[c].efc_address] = base_[c] - lowered[c];
    }
    mj_fwdConstraint(m, d);
    if (d->nefc == 0) return;
    mju_copy(d->qacc_warmstart, d->qacc, m->nv);
    mj_mulJacVec(m, d, lag_.data(), d->qacc);
    bool is_done = true;
    for (std::size_t c = 0; c < contacts; ++c) {
      if (!slips(c)) continue;
      const int row = d->contact[c].efc_address;
      double slip[3];
      for (int j = 0; j < 3; ++j) slip[j] = lag_[static_cast<std::size_t>(row + j)] - d->efc_aref[row + j];
      const double now = parting(d->contact[c], slip);
      is_done &= std::abs(now - lowered[c]) <= close_enough * (1 + now);
      lowered[c] = now;
    }
    if (is_done) return;
  }
}

}  // namespace muster::mujoco
