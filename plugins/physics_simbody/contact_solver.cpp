#include "contact_solver.hpp"

#include <algorithm>
#include <cmath>

namespace muster::simbody {

using Eigen::Vector2d;

namespace {

constexpr int first_newton = 4, later_newton = 2, last_newton = 50;

}  // namespace

template <int N>
Outcome ContactSolverOf<N>::solve(Problem& problem) {
  p_ = &problem;
  begin();
  Outcome outcome;
  if (problem.search.first == Search::First::all_sticks ? stick_all() : go_on()) {
    outcome.direct = true;
  } else {
    slip(outcome);
    if (!outcome.minimised && !problem.search.together) {  // rare: motors at their limits, which the other search meets
      problem.search.together = true;
      slip(outcome);
    }
  }
  if (u_.size() > 1 && outcome.minimised) obey_impulses();
  for (std::size_t i = 0; i < u_.size(); ++i) problem.bodies[i].velocity = u_[i];
  return outcome;
}

// What the search left over, less than its tolerance, would be momentum from nowhere: velocities become exactly what
// the impulses make of them, so that what bodies give each other adds up to nothing.
template <int N>
void ContactSolverOf<N>::obey_impulses() {
  for (std::size_t b = 0; b < u_.size(); ++b) u_[b] -= p_->bodies[b].inverse_mass * gradient_[b];
}

template <int N>
void ContactSolverOf<N>::begin() {
  const std::size_t count = p_->bodies.size();
  for (Velocities* v : {&u_, &gradient_, &d_}) v->resize(count);
  local_.assign(p_->contacts.size(), {});
  motor_duals_.assign(count, {});
  motor_habits_.resize(count);
  pairs_.clear();
  for (std::size_t i = 0; i < local_.size(); ++i) {
    const Contact& c = p_->contacts[i];
    local_[i].start_push = std::max(0.0, c.push);
    local_[i].start_grip = c.grip;
    if (c.other >= 0) pairs_.push_back({c.body, c.other});
  }
  hessian_.arrange(static_cast<int>(count), pairs_);
}

// Normal speed and slip of a contact.
template <int N>
std::array<double, 3> ContactSolverOf<N>::speeds_of(const Contact& c, const Velocities& u) const {
  std::array<double, 3> speeds{};
  blocks_.add_speeds(speeds.data(), c.normal.data(), u[c.body].data());
  if (c.other >= 0) blocks_.add_speeds(speeds.data(), c.of_other.normal.data(), u[c.other].data());
  return speeds;
}

// Takes what the contact's impulses give from the momenta.
template <int N>
void ContactSolverOf<N>::take_impulse(const Contact& c, Velocities& momenta) const {
  const double impulses[] = {c.push, c.grip[0], c.grip[1]};
  blocks_.subtract_rows(momenta[c.body].data(), c.normal.data(), impulses);
  if (c.other >= 0) blocks_.subtract_rows(momenta[c.other].data(), c.of_other.normal.data(), impulses);
}

template <int N>
void ContactSolverOf<N>::locate(const Velocities& u) {
  for (std::size_t i = 0; i < local_.size(); ++i) {
    const auto [speed, x, y] = speeds_of(p_->contacts[i], u);
    local_[i].speed = speed;
    local_[i].slip = {x, y};
  }
}

// Impulses at u_, and the energy's gradient there. With `refresh` the bounds follow the normal impulses at once: the
// gradient is then the residual of Coulomb's law itself.
template <int N>
void ContactSolverOf<N>::gradient(bool refresh) {
  locate(u_);
  for (std::size_t b = 0; b < u_.size(); ++b) {
    gradient_[b] = u_[b] - p_->bodies[b].free;
    blocks_.apply(gradient_[b].data(), p_->bodies[b].mass.data());
  }
  for (std::size_t i = 0; i < local_.size(); ++i) {
    Contact& c = p_->contacts[i];
    c.push = std::max(0.0, (c.target - local_[i].speed) / c.softness);
    if (refresh) local_[i].bound = c.friction * c.push;
    c.grip = grip_of(local_[i].slip, local_[i].bound, c.grip_softness);
    take_impulse(c, gradient_);
  }
  for (std::size_t b = 0; b < u_.size(); ++b) {
    for (int m = 0; m < joints; ++m) gradient_[b][6 + m] -= p_->bodies[b].motors[m].impulse(u_[b][6 + m]);
  }
}

// The largest change of velocity that the gradient would still make.
template <int N>
double ContactSolverOf<N>::residual() const {
  double most = 0;
  for (std::size_t b = 0; b < u_.size(); ++b) {
    Velocity v = gradient_[b];
    blocks_.apply(v.data(), p_->bodies[b].inverse_mass.data());
    most = std::max({most, v.template segment<3>(3).norm(), turn_arm * v.template head<3>().norm(),
                     rim * v.template tail<joints>().norm()});
    if (std::isnan(v.sum())) return v.sum();
  }
  return most;
}

// The contact's part of the Hessian: all its rows, or those along the ground alone, or the normal alone.
template <int N>
void ContactSolverOf<N>::add(const Contact& c, double normal, const GripStiffness& grip) {
  const bool slips = grip[0] != 0 || grip[2] != 0;
  const int first = normal == 0 ? 1 : 0, rows = (slips ? 3 : 1) - first;
  if (rows == 0) return;
  const auto weighed = [&](const ContactRowsOf<N>& of) {
    std::array<Velocity, 3> result;
    result[0] = normal * of.normal;
    for (int k = 0; slips && k < 2; ++k) result[1 + k] = grip[k] * of.tangent[0] + grip[1 + k] * of.tangent[1];
    return result;
  };
  const Velocity *own = &c.normal + first, *others = &c.of_other.normal + first;
  const auto of_own = weighed(c);
  blocks_.add_rows(hessian_.diagonal(c.body).data(), rows, own->data(), of_own[first].data());
  if (c.other < 0) return;
  const auto of_other = weighed(c.of_other);
  blocks_.add_rows(hessian_.diagonal(c.other).data(), rows, others->data(), of_other[first].data());
  hessian_.add(c.body, c.other, rows, own, &of_other[first]);
}

// The guess that is true on a clear floor: what touches and closes under the free motion closes; against what stands
// still it sticks; motors hold their rate. What would have to pull does not touch after all, and what comes nearer than
// it may does: the guess is made again.
template <int N>
bool ContactSolverOf<N>::stick_all() {
  constexpr int guesses = 3;
  for (int guess = 0; guess < guesses; ++guess) {
    for (std::size_t b = 0; b < u_.size(); ++b) u_[b] = p_->bodies[b].free;
    locate(u_);
    for (std::size_t i = 0; guess == 0 && i < local_.size(); ++i) {
      const double target = p_->contacts[i].target;
      local_[i].closes = target >= 0 && target > local_[i].speed;
    }
    stick();
    gradient(true);
    if (residual() <= p_->search.tolerance) return true;
    bool changed = false;
    for (std::size_t i = 0; i < local_.size(); ++i) {
      const bool pushes = p_->contacts[i].push > 0;
      changed |= pushes != local_[i].closes;
      local_[i].closes = pushes;
    }
    if (!changed) return false;
  }
  return false;
}

// From the free motion, where all has been located.
template <int N>
void ContactSolverOf<N>::stick() {
  for (std::size_t b = 0; b < u_.size(); ++b) {
    blocks_.copy(hessian_.diagonal(static_cast<int>(b)).data(), p_->bodies[b].mass.data());
    d_[b].setZero();
  }
  hessian_.clear_pairs();
  for (std::size_t i = 0; i < local_.size(); ++i) {
    const Contact& c = p_->contacts[i];
    if (!local_[i].closes) continue;
    const double push = (c.target - local_[i].speed) / c.softness;
    const bool grips = c.other < 0 && c.friction > 0;
    add(c, 1 / c.softness, grips ? sticking(c.grip_softness) : GripStiffness{});
    d_[c.body] += push * c.normal;
    if (c.other >= 0) {
      d_[c.other] += push * c.of_other.normal;
    } else if (grips) {
      for (int k = 0; k < 2; ++k) d_[c.body] -= (local_[i].slip[k] / c.grip_softness) * c.tangent[k];
    }
  }
  for (std::size_t b = 0; b < u_.size(); ++b) {
    for (int m = 0; m < joints; ++m) {
      const Motor& motor = p_->bodies[b].motors[m];
      hessian_.diagonal(static_cast<int>(b))(6 + m, 6 + m) += 1 / motor.softness;
      d_[b][6 + m] += (motor.asked - u_[b][6 + m]) / motor.softness;
    }
  }
  hessian_.factor();
  hessian_.solve(d_);
  for (std::size_t b = 0; b < u_.size(); ++b) u_[b] += d_[b];
}

template <int N>
void ContactSolverOf<N>::slip(Outcome& outcome) {
  for (std::size_t i = 0; i < local_.size(); ++i) {
    local_[i].bound = p_->contacts[i].friction * local_[i].start_push;
    local_[i].dual = within(local_[i].start_grip, local_[i].bound);
  }
  for (std::size_t b = 0; b < u_.size(); ++b) u_[b] = p_->bodies[b].previous;
  for (int pass = 0; pass < p_->search.passes; ++pass) {
    const bool last = pass + 1 == p_->search.passes;
    outcome.minimised = minimise(last ? last_newton : pass == 0 ? first_newton : later_newton);
    double change = 0, size = 0;
    for (std::size_t i = 0; i < local_.size(); ++i) {
      const double bound = p_->contacts[i].friction * p_->contacts[i].push;
      change = std::max(change, std::abs(bound - local_[i].bound));
      size = std::max(size, bound);
    }
    outcome.converged = outcome.minimised && change <= p_->search.bound_tolerance * (size + 1e-9);
    if (outcome.converged) return;
    if (!last) refresh_bounds(pass);
  }
}

template <int N>
void ContactSolverOf<N>::refresh_bounds(int pass) {
  for (std::size_t i = 0; i < local_.size(); ++i) {
    const double bound = p_->contacts[i].friction * p_->contacts[i].push;
    local_[i].bound = pass < 2 ? bound : 0.5 * (bound + local_[i].bound);  // an average ends cycles
    local_[i].dual = within(local_[i].dual, local_[i].bound);
  }
}

// Newton with exact line search on the convex energy of fixed bounds; the impulses are those at u_ when it returns.
template <int N>
bool ContactSolverOf<N>::minimise(int limit) {
  for (int iteration = 0;; ++iteration) {
    gradient(false);
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
  }
}

// What d_ does to contacts and to the energy of motion, a quadratic along d_.
template <int N>
void ContactSolverOf<N>::look_ahead() {
  for (std::size_t i = 0; i < local_.size(); ++i) {
    const auto [speed, x, y] = speeds_of(p_->contacts[i], d_);
    local_[i].speed_ahead = speed;
    local_[i].slip_ahead = {x, y};
  }
  slope_of_motion_ = curve_of_motion_ = 0;
  for (std::size_t b = 0; b < u_.size(); ++b) {
    Velocity momentum = d_[b];
    blocks_.apply(momentum.data(), p_->bodies[b].mass.data());
    slope_of_motion_ += momentum.dot(u_[b] - p_->bodies[b].free);
    curve_of_motion_ += momentum.dot(d_[b]);
  }
}

template <int N>
void ContactSolverOf<N>::set_hessian() {
  for (std::size_t b = 0; b < u_.size(); ++b)
    blocks_.copy(hessian_.diagonal(static_cast<int>(b)).data(), p_->bodies[b].mass.data());
  hessian_.clear_pairs();
  for (std::size_t i = 0; i < local_.size(); ++i) {
    const Contact& c = p_->contacts[i];
    const Local& at = local_[i];
    add(c, c.push > 0 ? 1 / c.softness : 0, grip_stiffness(at.slip, at.bound, at.dual, c.grip_softness));
  }
  for (std::size_t b = 0; b < u_.size(); ++b) {
    for (int m = 0; m < joints; ++m) hessian_.diagonal(static_cast<int>(b))(6 + m, 6 + m) += motor_stiffness(b, m);
  }
}

// A motor at its limit is a friction of one dimension, and is met alike: near others by an estimate of its impulse kept
// beside the rate, without which the wheels of many robots take turns in overshooting.
template <int N>
double ContactSolverOf<N>::motor_stiffness(std::size_t body, int m) const {
  const Motor& motor = p_->bodies[body].motors[m];
  const double slip = u_[body][6 + m] - motor.asked, size = std::abs(slip);
  if (size < motor.softness * motor.limit) return 1 / motor.softness;
  if (!p_->search.together || motor.limit <= 0) return 0;
  return (motor.limit / size) * (1 + motor_duals_[body][m] / motor.limit * (slip < 0 ? -1 : 1));
}

template <int N>
void ContactSolverOf<N>::move_duals() {
  for (std::size_t i = 0; i < local_.size(); ++i) {
    Local& at = local_[i];
    if (at.bound <= 0) continue;
    const double softness = p_->contacts[i].grip_softness;
    const Vector2d& change = at.slip_ahead;
    const double size = std::max(at.slip.norm(), softness * at.bound);
    Vector2d x = at.slip + change;
    if (!sticks(at.slip.norm(), at.bound, softness)) x += (at.slip.dot(change) / (size * at.bound)) * at.dual;
    at.dual = within(-(at.bound / size) * x, at.bound);
  }
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
  double s = slope_of_motion_ + a * curve_of_motion_;
  for (std::size_t i = 0; i < local_.size(); ++i) {
    const Contact& c = p_->contacts[i];
    const Local& at = local_[i];
    s -= std::max(0.0, (c.target - at.speed - a * at.speed_ahead) / c.softness) * at.speed_ahead;
    if (at.bound > 0) s -= grip_of(at.slip + a * at.slip_ahead, at.bound, c.grip_softness).dot(at.slip_ahead);
  }
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
  const double at_zero = slope(0), at_one = slope(1);
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

template class ContactSolverOf<unknowns>;
template class ContactSolverOf<unknowns_with_legs>;

}  // namespace muster::simbody
