// Newton's method in passes: friction's bounds follow the normal impulses from pass to pass. Contacts are processed in
// lanes (contact_lanes.hpp), eight side by side; their rows are read only where needed.
#include <algorithm>
#include <cmath>

#include "contact_solver.hpp"

namespace muster::simbody {

namespace {

constexpr int first_newton = 4, later_newton = 2, last_newton = 50;

}  // namespace

template <int N>
void ContactSolverOf<N>::slip(Outcome& outcome) {
  for (std::size_t b = 0; b < u_.size(); ++b) u_[b] = p_->bodies[b].previous;
  fill_lanes();
  for (int pass = 0; pass < p_->search.passes; ++pass) {
    const bool last = pass + 1 == p_->search.passes;
    outcome.minimised = minimise(last ? last_newton : pass == 0 ? first_newton : later_newton);
    double change = 0, size = 0;
    for (std::size_t i = 0; i < local_.size(); ++i) {
      const ContactLanes& lanes = lanes_[i / ContactLanes::width];
      const std::size_t k = i % ContactLanes::width;
      Contact& c = p_->contacts[i];
      c.push = lanes.push[k];
      c.grip = {lanes.grip[0][k], lanes.grip[1][k]};
      const double bound = c.friction * c.push;
      change = std::max(change, std::abs(bound - lanes.bound[k]));
      size = std::max(size, bound);
    }
    outcome.converged = outcome.minimised && change <= p_->search.bound_tolerance * (size + 1e-9);
    if (outcome.converged) return;
    if (!last) refresh_bounds(pass);
  }
}

// Initial state of the search, at u_.
template <int N>
void ContactSolverOf<N>::fill_lanes() {
  lanes_.assign((local_.size() + ContactLanes::width - 1) / ContactLanes::width, ContactLanes{});
  bodies_.clear();
  for (std::size_t i = 0; i < local_.size(); ++i) {
    const Contact& c = p_->contacts[i];
    ContactLanes& lanes = lanes_[i / ContactLanes::width];
    const std::size_t k = i % ContactLanes::width;
    std::array<double, 3> speeds;
    speeds_of(c, u_, speeds);
    bodies_.insert(bodies_.end(), {c.body, c.other});
    lanes.target[k] = c.target;
    lanes.hardness[k] = 1 / c.softness;
    lanes.grip_softness[k] = c.grip_softness;
    lanes.bound[k] = c.friction * local_[i].start_push;
    lanes.speed[k] = speeds[0];
    lanes.slip[0][k] = speeds[1], lanes.slip[1][k] = speeds[2];
    set_dual(i, local_[i].start_grip);
  }
}

template <int N>
void ContactSolverOf<N>::set_dual(std::size_t contact, const Eigen::Vector2d& dual) {
  ContactLanes& lanes = lanes_[contact / ContactLanes::width];
  const std::size_t k = contact % ContactLanes::width;
  const Eigen::Vector2d bounded = within(dual, lanes.bound[k]);
  lanes.dual[0][k] = bounded[0], lanes.dual[1][k] = bounded[1];
}

template <int N>
void ContactSolverOf<N>::refresh_bounds(int pass) {
  for (std::size_t i = 0; i < local_.size(); ++i) {
    ContactLanes& lanes = lanes_[i / ContactLanes::width];
    const std::size_t k = i % ContactLanes::width;
    const double bound = p_->contacts[i].friction * p_->contacts[i].push;
    lanes.bound[k] = pass < 2 ? bound : 0.5 * (bound + lanes.bound[k]);  // an average ends cycles
    set_dual(i, {lanes.dual[0][k], lanes.dual[1][k]});
  }
}

// Newton with exact line search on the convex energy of fixed bounds; the impulses are those at u_ when it returns.
// Speeds at contacts are updated with u_, not recomputed from it.
template <int N>
bool ContactSolverOf<N>::minimise(int limit) {
  for (int iteration = 0;; ++iteration) {
    respond();
    if (residual() <= p_->search.tolerance) return true;
    if (iteration == limit) return false;
    set_hessian();
    hessian_.factor();
    d_ = gradient_;
    hessian_.solve(d_);
    for (Velocity& d : d_) d = -d;
    look_ahead();
    move_duals();
    const double a = line_search();
    for (std::size_t b = 0; b < u_.size(); ++b) u_[b] += a * d_[b];
    in_lanes_.go_ahead(lanes_.data(), lane_count(), a);
  }
}

template <int N>
ContactTable ContactSolverOf<N>::table() const {
  if (p_->contacts.empty()) return {};
  const Contact& first = p_->contacts.front();
  const double* rows = first.normal.data();
  return {static_cast<int>(p_->contacts.size()), rows, sizeof(Contact) / sizeof(double),
          first.of_other.normal.data() - rows, bodies_.data()};
}

// Impulses at u_, and the energy's gradient there.
template <int N>
void ContactSolverOf<N>::respond() {
  in_lanes_.respond(lanes_.data(), lane_count());
  begin_gradient();
  blocks_.take_impulses(table(), lanes_.data(), gradient_.front().data());
  end_gradient();
}

// Contacts of one pair, or of one robot with static surfaces, are consecutive and are added in runs.
template <int N>
void ContactSolverOf<N>::set_hessian() {
  begin_hessian();
  constexpr int most_in_run = BlockArithmetic<N>::most_contacts;
  std::array<const double*, most_in_run> own, others;
  std::array<double, 4 * most_in_run> stiffness;
  int count = 0;
  for (std::size_t i = 0; i < local_.size(); ++i) {
    const Contact& c = p_->contacts[i];
    const ContactLanes& lanes = lanes_[i / ContactLanes::width];
    const std::size_t k = i % ContactLanes::width;
    if (lanes.stiffness[k] > 0 || lanes.bound[k] > 0) {
      own[count] = c.normal.data();
      others[count] = c.of_other.normal.data();
      const double of_contact[] = {lanes.stiffness[k], lanes.grip_xx[k], lanes.grip_xy[k], lanes.grip_yy[k]};
      std::copy(std::begin(of_contact), std::end(of_contact), &stiffness[4 * count]);
      ++count;
    }
    const bool goes_on = i + 1 < local_.size() && count < most_in_run && bodies_[2 * i] == bodies_[2 * i + 2] &&
                         bodies_[2 * i + 1] == bodies_[2 * i + 3];
    if (goes_on || count == 0) continue;
    add_run(c, count, own.data(), others.data(), stiffness.data());
    count = 0;
  }
  for (std::size_t b = 0; b < u_.size(); ++b) {
    for (int m = 0; m < joints; ++m) hessian_.diagonal(static_cast<int>(b))(6 + m, 6 + m) += motor_stiffness(b, m);
  }
}

// A motor at its limit is a one-dimensional friction, and is treated alike: near other robots with a dual estimate of
// its impulse, without which the wheels of many robots overshoot in turn.
template <int N>
double ContactSolverOf<N>::motor_stiffness(std::size_t body, int m) const {
  const Motor& motor = p_->bodies[body].motors[m];
  const double slip = u_[body][6 + m] - motor.asked, size = std::abs(slip);
  if (size < motor.softness * motor.limit) return 1 / motor.softness;
  if (!p_->search.together || motor.limit <= 0) return 0;
  return (motor.limit / size) * (1 + motor_duals_[body][m] / motor.limit * (slip < 0 ? -1 : 1));
}

// Derivatives along d_: of contacts' speeds, and of the kinetic energy, a quadratic along d_.
template <int N>
void ContactSolverOf<N>::look_ahead() {
  blocks_.look_ahead(table(), d_.front().data(), lanes_.data());
  slope_of_motion_ = curve_of_motion_ = 0;
  for (std::size_t b = 0; b < u_.size(); ++b) {
    Velocity momentum = d_[b];
    blocks_.apply(momentum.data(), p_->bodies[b].inertia->mass.data());
    slope_of_motion_ += momentum.dot(u_[b] - p_->bodies[b].free);
    curve_of_motion_ += momentum.dot(d_[b]);
  }
}

template <int N>
void ContactSolverOf<N>::move_duals() {
  in_lanes_.move_duals(lanes_.data(), lane_count());
  for (std::size_t b = 0; p_->search.together && b < u_.size(); ++b) {
    for (int m = 0; m < joints; ++m) {
      const Motor& motor = p_->bodies[b].motors[m];
      if (motor.limit <= 0) continue;
      const double slip = u_[b][6 + m] - motor.asked, change = d_[b][6 + m];
      const double size = std::max(std::abs(slip), motor.softness * motor.limit);
      double x = slip + change;
      if (std::abs(slip) > motor.softness * motor.limit) x += slip * change / (size * motor.limit) * motor_duals_[b][m];
      motor_duals_[b][m] = std::clamp(-(motor.limit / size) * x, -motor.limit, motor.limit);
    }
  }
}

// The energy's slope along d_ at u_ + a d_, which rises with a.
template <int N>
double ContactSolverOf<N>::slope(double a) const {
  double s = slope_of_motion_ + a * curve_of_motion_ - in_lanes_.slope(lanes_.data(), lane_count(), a);
  for (std::size_t b = 0; b < u_.size(); ++b) {
    for (int m = 0; m < joints; ++m) {
      const double ahead = d_[b][6 + m];
      s -= p_->bodies[b].motors[m].impulse(u_[b][6 + m] + a * ahead) * ahead;
    }
  }
  return s;
}

template <int N>
double ContactSolverOf<N>::line_search() const {
  double at_zero = 0;
  for (std::size_t b = 0; b < u_.size(); ++b) at_zero += gradient_[b].dot(d_[b]);
  const double at_one = slope(1);
  if (at_one <= 0.5 * std::abs(at_zero)) return 1;
  double low = 0, high = 1, slope_low = at_zero, slope_high = at_one;
  for (int i = 0; i < 30 && high - low > 1e-9; ++i) {
    double middle = low - slope_low * (high - low) / (slope_high - slope_low);
    if (i % 3 == 2 || !(middle > low && middle < high)) middle = 0.5 * (low + high);
    const double s = slope(middle);
    if (std::abs(s) < 0.1 * std::abs(at_zero)) return middle;
    (s < 0 ? low : high) = middle;
    (s < 0 ? slope_low : slope_high) = s;
  }
  return low > 0 ? low : high;
}

template void ContactSolverOf<unknowns>::slip(Outcome&);
template void ContactSolverOf<unknowns_with_legs>::slip(Outcome&);

}  // namespace muster::simbody
