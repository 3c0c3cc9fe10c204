#include "contact_solver.hpp"

#include <algorithm>
#include <cmath>

namespace muster::simbody {

using Eigen::Vector2d;

template <int N>
Outcome ContactSolverOf<N>::solve(Problem& problem) {
  p_ = &problem;
  begin();
  Outcome outcome;
  if (problem.search.first == Search::First::all_sticks ? stick_all() : go_on()) {
    outcome.direct = true;
  } else {
    slip(outcome);
    if (!outcome.minimised && !problem.search.together) {  // rare: motors at their limits, which the other search
                                                           // handles
      problem.search.together = true;
      slip(outcome);
    }
  }
  if (u_.size() > 1 && outcome.minimised) obey_impulses();
  for (std::size_t i = 0; i < u_.size(); ++i) problem.bodies[i].velocity = u_[i];
  return outcome;
}

// A residual below the tolerance would still create momentum: velocities are recomputed from the impulses, so that
// those between bodies sum to zero.
template <int N>
void ContactSolverOf<N>::obey_impulses() {
  for (std::size_t b = 0; b < u_.size(); ++b) u_[b] -= p_->bodies[b].inertia->inverse * gradient_[b];
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

// Normal speed and slip of a contact, written directly to their place: reading numbers just written one by one as a
// pair would stall.
template <int N>
void ContactSolverOf<N>::speeds_of(const Contact& c, const Velocities& u, std::array<double, 3>& speeds) const {
  speeds = {};
  blocks_.add_speeds(speeds.data(), c.normal.data(), u[c.body].data());
  if (c.other >= 0) blocks_.add_speeds(speeds.data(), c.of_other.normal.data(), u[c.other].data());
}

// Subtracts the contact's impulses from the momenta.
template <int N>
void ContactSolverOf<N>::take_impulse(const Contact& c, Velocities& momenta) const {
  const double impulses[] = {c.push, c.grip[0], c.grip[1]};
  blocks_.subtract_rows(momenta[c.body].data(), c.normal.data(), impulses);
  if (c.other >= 0) blocks_.subtract_rows(momenta[c.other].data(), c.of_other.normal.data(), impulses);
}

template <int N>
void ContactSolverOf<N>::locate(const Velocities& u) {
  for (std::size_t i = 0; i < local_.size(); ++i) speeds_of(p_->contacts[i], u, local_[i].speeds);
}

// Impulses at u_ by Coulomb's law itself, of which the gradient is then the residual: friction's bounds follow the
// normal impulses at once.
template <int N>
void ContactSolverOf<N>::obey_law() {
  locate(u_);
  begin_gradient();
  for (std::size_t i = 0; i < local_.size(); ++i) {
    Contact& c = p_->contacts[i];
    c.push = std::max(0.0, (c.target - local_[i].speed()) / c.softness);
    local_[i].bound = c.friction * c.push;
    c.grip = grip_of(local_[i].slip(), local_[i].bound, c.grip_softness);
    take_impulse(c, gradient_);
  }
  end_gradient();
}

// begin_gradient() adds the inertial part; end_gradient(), after the contacts' impulses are subtracted, the motors'.
template <int N>
void ContactSolverOf<N>::begin_gradient() {
  for (std::size_t b = 0; b < u_.size(); ++b) {
    gradient_[b] = u_[b] - p_->bodies[b].free;
    blocks_.apply(gradient_[b].data(), p_->bodies[b].inertia->mass.data());
  }
}
template <int N>
void ContactSolverOf<N>::end_gradient() {
  for (std::size_t b = 0; b < u_.size(); ++b) {
    for (int m = 0; m < joints; ++m) gradient_[b][6 + m] -= p_->bodies[b].motors[m].impulse(u_[b][6 + m]);
  }
}

// The largest change of velocity by which the gradient would still be reduced.
template <int N>
double ContactSolverOf<N>::residual() const {
  double most = 0;
  for (std::size_t b = 0; b < u_.size(); ++b) {
    Velocity v = gradient_[b];
    blocks_.apply(v.data(), p_->bodies[b].inertia->inverse.data());
    most = std::max({most, v.template segment<3>(3).norm(), turn_arm * v.template head<3>().norm(),
                     rim * v.template tail<joints>().norm()});
    if (std::isnan(v.sum())) return v.sum();
  }
  return most;
}

template <int N>
void ContactSolverOf<N>::begin_hessian() {
  for (std::size_t b = 0; b < u_.size(); ++b)
    blocks_.copy(hessian_.diagonal(static_cast<int>(b)).data(), p_->bodies[b].inertia->mass.data());
  hessian_.clear_pairs();
}

// Adds the contact's part to the Hessian.
template <int N>
void ContactSolverOf<N>::add(const Contact& c, double normal, const GripStiffness& grip) {
  const double *own = c.normal.data(), *other = c.of_other.normal.data();
  const double stiffness[] = {normal, grip[0], grip[1], grip[2]};
  add_run(c, 1, &own, &other, stiffness);
}

// The same for several contacts of one pair: their rows, and four numbers for each, as for BlockArithmetic.
template <int N>
void ContactSolverOf<N>::add_run(const Contact& c, int count, const double* const* own, const double* const* others,
                                 const double* stiffness) {
  blocks_.add_contacts(hessian_.diagonal(c.body).data(), count, own, own, stiffness);
  if (c.other < 0) return;
  blocks_.add_contacts(hessian_.diagonal(c.other).data(), count, others, others, stiffness);
  hessian_.add_contacts(c.body, c.other, count, own, others, stiffness);
}

// A guess that holds on a clear floor: contacts that touch and close under the free motion are closed, those with
// static surfaces stick, and motors hold their rate. Contacts that would have to pull are opened, and those that come
// too near are closed: then it guesses again.
template <int N>
bool ContactSolverOf<N>::stick_all() {
  constexpr int guesses = 3;
  for (int guess = 0; guess < guesses; ++guess) {
    for (std::size_t b = 0; b < u_.size(); ++b) u_[b] = p_->bodies[b].free;
    locate(u_);
    for (std::size_t i = 0; guess == 0 && i < local_.size(); ++i) {
      const double target = p_->contacts[i].target;
      local_[i].closes = target >= 0 && target > local_[i].speed();
    }
    stick();
    obey_law();
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

// From the free motion, after locate().
template <int N>
void ContactSolverOf<N>::stick() {
  begin_hessian();
  for (Velocity& d : d_) d.setZero();
  for (std::size_t i = 0; i < local_.size(); ++i) {
    const Contact& c = p_->contacts[i];
    if (!local_[i].closes) continue;
    const double push = (c.target - local_[i].speed()) / c.softness;
    const bool grips = c.other < 0 && c.friction > 0;
    add(c, 1 / c.softness, grips ? sticking(c.grip_softness) : GripStiffness{});
    d_[c.body] += push * c.normal;
    if (c.other >= 0) {
      d_[c.other] += push * c.of_other.normal;
    } else if (grips) {
      for (int k = 0; k < 2; ++k) d_[c.body] -= (local_[i].speeds[1 + k] / c.grip_softness) * c.tangent[k];
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

template class ContactSolverOf<unknowns>;
template class ContactSolverOf<unknowns_with_legs>;

}  // namespace muster::simbody
