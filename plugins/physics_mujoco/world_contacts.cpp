// Contacts and constraints of a step: which contacts count, and the accelerations that all constraints aim at.
//
// MuJoCo's solver finds the accelerations nearest to the free ones, in the metric of the masses, under the constraints
// of joints and the friction cones of contacts. Its own aims are springs of some time constant. Here each aim is a
// velocity at the end of the step: motors at their rate, contacts closed or bouncing, rolling without slip.
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

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

// At this speed a contact that slips so parts in MuJoCo. `slip`: along the normal (not used) and across it.
double parting(const mjContact& contact, const double* slip) {
  return std::hypot(contact.friction[0] * slip[1], contact.friction[1] * slip[2]);
}

// The fixed point of a map, from what it makes of the last few arguments (Anderson 1965).
class Mixing {
 public:
  explicit Mixing(Eigen::Index size) : steps_(size, 0), changes_(size, 0) {}

  // The next argument, none below 0.
  Eigen::VectorXd next(const Eigen::VectorXd& argument, const Eigen::VectorXd& result) {
    constexpr Eigen::Index most = 5;
    const Eigen::VectorXd error = result - argument;
    if (last_error_.size() > 0) {
      const Eigen::Index kept = std::min(steps_.cols(), most - 1), size = argument.size();
      Eigen::MatrixXd steps(size, kept + 1), changes(size, kept + 1);
      steps << steps_.rightCols(kept), result - last_result_;
      changes << changes_.rightCols(kept), error - last_error_;
      steps_ = steps, changes_ = changes;
    }
    last_error_ = error, last_result_ = result;
    if (steps_.cols() == 0) return result;
    const Eigen::VectorXd weights = changes_.colPivHouseholderQr().solve(error);
    return (result - steps_ * weights).cwiseMax(0);
  }

 private:
  Eigen::MatrixXd steps_, changes_;  // of results and errors, from each to the next
  Eigen::VectorXd last_error_, last_result_;
};

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
  // MuJoCo acts half way into the ground: a wheel that sinks would roll on a smaller radius.
  if (model_->geom_type[contact.geom1] == mjGEOM_PLANE) mju_addToScl3(contact.pos, contact.frame, contact.dist / 2);
  const double friction = std::min(a.friction, b.friction);
  contact.dim = friction > weakest ? 3 : 1;
  std::fill(std::begin(contact.friction), std::end(contact.friction), std::max(friction, weakest));
  if (a.holds_along) hold(a, contact);
  if (b.holds_along) hold(b, contact);
  return true;
}

// Turns the contact's first tangent to the direction along which the wheel holds; let_roll() frees the second.
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
}

// Across the direction in which a roller or a free wheel holds, its contact has no velocity to act on: what is left of
// the cone is Coulomb's law along the one direction.
void World::let_roll() {
  const mjModel* m = model_.get();
  mjData* d = data_.get();
  std::vector<bool> is_free(static_cast<std::size_t>(d->nefc), false);
  bool any = false;
  for (int c = 0; c < d->ncon; ++c) {
    const mjContact& contact = d->contact[c];
    if (contact.efc_address < 0 || contact.dim == 1) continue;
    if (!surface(contact.geom1).holds_along && !surface(contact.geom2).holds_along) continue;
    is_free[static_cast<std::size_t>(contact.efc_address) + 2] = any = true;
  }
  if (!any) return;
  for (int row = 0; row < d->nefc; ++row) {
    if (!is_free[static_cast<std::size_t>(row)]) continue;
    double* first = d->efc_J + (mj_isSparse(m) ? d->efc_J_rowadr[row] : row * m->nv);
    std::fill_n(first, mj_isSparse(m) ? d->efc_J_rownnz[row] : m->nv, 0.0);
  }
  for (int dof = 0; mj_isSparse(m) && dof < m->nv; ++dof) {  // the same transposed
    for (int k = d->efc_JT_rowadr[dof]; k < d->efc_JT_rowadr[dof] + d->efc_JT_rownnz[dof]; ++k) {
      if (is_free[static_cast<std::size_t>(d->efc_JT_colind[k])]) d->efc_JT[k] = 0;
    }
  }
}

void World::aim(double h) {
  mjData* d = data_.get();
  for (int row = 0; row < d->nefc; ++row) {
    const double velocity = d->efc_vel[row], gap = d->efc_pos[row] - h / 2 * velocity;
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

void World::aim_contact(mjContact& contact, double h) {
  mjData* d = data_.get();
  const int row = contact.efc_address;
  const double velocity = d->efc_vel[row];
  const double share = std::min(surface(contact.geom1).restitution, surface(contact.geom2).restitution);
  const double gap = contact.dist - h / 2 * velocity;  // at the start of the step
  if (share > 0 && velocity < -slowest_bounce) {       // it bounces where it has met
    d->efc_aref[row] = gap > 0 ? far_off : -(1 + share) * velocity / h;
  } else {
    d->efc_aref[row] = (closing(gap, h) - velocity) / h;
    soften(contact, gap, h);
  }
  for (int k = 1; k < contact.dim; ++k) d->efc_aref[row + k] = -d->efc_vel[row + k] / h;
}

// Rigid contacts of more than three points do not determine how they share a weight, and then the solver's rest error
// does. Wheels of which there are more share it as springs and dampers that sink by 0.1 mm, all others with a small
// multiple of MuJoCo's least softness, by which nothing sinks more than 0.001 mm.
void World::soften(mjContact& contact, double gap, double h) {
  constexpr double sunk = 1e-4, hardly = 1e-6;   // [m]
  constexpr double least = 1e-4, wanted = 1e-2;  // softness over the contact's mobility: MuJoCo's, and that here
  mjData* d = data_.get();
  const int row = contact.efc_address;
  const double carries = std::max(surface(contact.geom1).carries, surface(contact.geom2).carries);
  double& softness = d->efc_R[row];
  if (carries > 0) {  // at the end of the step: force = -stiffness gap - damping velocity
    const double stiffness = carries * gravity / sunk, damping = 2 * std::sqrt(stiffness * carries);
    const double stiff = h * stiffness + damping;
    softness = 1 / (stiff * h);
    d->efc_aref[row] = -(d->efc_vel[row] + stiffness * gap / stiff) / h;
  } else {
    softness *= std::max(1.0, std::min(wanted, hardly * taken_back / (gravity * h * h)) / least);
  }
  d->efc_D[row] = 1 / softness;
  if (contact.dim > 1) contact.mu = contact.friction[0] * std::sqrt(d->efc_R[row + 1] / softness);
}

// MuJoCo's cones are convex: a contact that slips at speed v parts at friction times v. What its aim is lowered by that
// much does not part and has Coulomb's friction (de Saxce's bipotential). How much that is follows from the solution,
// so it is found by iteration: each takes an error to its share mu2 k / (1 + mu2 k), k being the ratio of the contact's
// mobilities along and across the ground. Under wheels that spin k is large; Anderson's mixing of the last iterations
// finds the limit there.
void World::solve(double h) {
  constexpr int most = 20;
  constexpr double close_enough = 1e-6;  // of a contact's speed at the end of the step [m/s], and relative to its slip
  const mjModel* m = model_.get();
  mjData* d = data_.get();
  slipping_.clear();
  for (int c = 0; c < d->ncon; ++c) {
    if (d->contact[c].efc_address >= 0 && d->contact[c].dim > 1) slipping_.push_back(c);
  }
  const auto count = static_cast<Eigen::Index>(slipping_.size());
  const auto contact = [&](Eigen::Index i) -> const mjContact& {
    return d->contact[slipping_[static_cast<std::size_t>(i)]];
  };
  Eigen::VectorXd base(count), lowered(count), found(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int row = contact(i).efc_address;
    base[i] = d->efc_aref[row];
    lowered[i] = parting(contact(i), d->efc_vel + row) / h;
  }
  std::vector<double> reached(static_cast<std::size_t>(d->nefc));
  Mixing mixing(count);
  for (int k = 0; k < most; ++k) {
    for (Eigen::Index i = 0; i < count; ++i) d->efc_aref[contact(i).efc_address] = base[i] - lowered[i];
    mj_fwdConstraint(m, d);
    if (count == 0) break;
    mju_copy(d->qacc_warmstart, d->qacc, m->nv);
    mj_mulJacVec(m, d, reached.data(), d->qacc);
    for (Eigen::Index i = 0; i < count; ++i) {
      const int row = contact(i).efc_address;
      const double* at = reached.data() + row;
      const double slip[] = {0, at[1] - d->efc_aref[row + 1], at[2] - d->efc_aref[row + 2]};
      found[i] = parting(contact(i), slip);
    }
    if (((found - lowered).array().abs() <= close_enough * (1 / h + found.array())).all()) break;
    lowered = mixing.next(lowered, found);
  }
  if (d->nefc == 0) return;
  // MuJoCo's solver settles accelerations to the root of what a double resolves. Those that its forces give keep the
  // momentum to the last bits.
  mju_add(d->qacc, d->qfrc_smooth, d->qfrc_constraint, m->nv);
  mj_solveM(m, d, d->qacc, d->qacc, 1);
}

}  // namespace muster::mujoco
