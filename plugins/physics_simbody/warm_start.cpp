// Warm start for robots near others: each contact keeps its mode (open, stick, slide) from the last step, and motors
// hold their rates.
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact_solver.hpp"

namespace muster::simbody {

using Eigen::Vector2d;

namespace {

constexpr int most_steps = 20, most_factors = 10;
constexpr int most_that_slide = 40;      // contacts: if more slide, their directions rarely persist
constexpr double lost = 1;               // [m/s] residual after a step beyond which the warm start is abandoned
constexpr double slow = 0.5;             // largest reduction factor of the residual in a step without a new
                                         // factorisation
constexpr double at_rest = 1e-6;         // [m/s] slip below which its direction is undefined
constexpr double share_of_mass = 0.125;  // weight of slip against friction in the decision between stick and slide

Vector2d beside(const Vector2d& way) { return {-way[1], way[0]}; }

}  // namespace

// With fixed modes, one factorisation solves the step except for friction's bounds, which follow the normal impulses,
// and directions of sliding, which turn. Further steps with the same factorisation find both, and satisfy Coulomb's law
// in the end. A contact whose mode changes needs a new factorisation. False if this does not converge.
template <int N>
bool ContactSolverOf<N>::go_on() {
  begin_as_before();
  double before = std::numeric_limits<double>::infinity();
  bool anew = true;
  for (int step = 0, factors = 0; step < most_steps; ++step) {
    anew |= see_habits();
    if (step == 0 && number_that_slide() > most_that_slide) return false;
    if (anew) {
      if (++factors > most_factors) return false;
      factor_habits();
      mixing_.begin();
    }
    step_by_habits();
    obey_law();
    const double rest = residual();
    if (rest <= p_->search.tolerance) return true;
    if (!(rest < lost)) return false;
    note_grips();
    anew = see_motor_habits() || (rest > slow * before && mixing_.count() > 2);
    before = rest;
  }
  return false;
}

template <int N>
void ContactSolverOf<N>::begin_as_before() {
  for (std::size_t b = 0; b < u_.size(); ++b) {
    u_[b] = p_->bodies[b].previous;
    motor_habits_[b].fill(MotorHabit::holds);
  }
  locate(u_);
  for (std::size_t i = 0; i < local_.size(); ++i) {
    const Contact& c = p_->contacts[i];
    Local& at = local_[i];
    const double push = at.start_push > 0 ? at.start_push : std::max(0.0, (c.target - at.speed()) / c.softness);
    at.closes = push > 0;
    at.bound = c.friction * push;
    at.dual = at.start_grip;
  }
}

// Augmented friction impulse, as without its bound (Alart and Curnier 1991): friction and slip together decide between
// stick and slide, and the direction.
template <int N>
Vector2d ContactSolverOf<N>::pull(std::size_t contact) const {
  return local_[contact].dual - weight(contact) * local_[contact].slip();
}
template <int N>
double ContactSolverOf<N>::weight(std::size_t contact) const {
  return share_of_mass * p_->bodies[p_->contacts[contact].body].inertia->mass(3, 3);
}

template <int N>
bool ContactSolverOf<N>::see_habits() {
  bool changed = false;
  for (std::size_t i = 0; i < local_.size(); ++i) {
    Local& at = local_[i];
    const ContactMode habit = !at.closes                   ? ContactMode::open
                              : at.bound <= 0              ? ContactMode::smooth
                              : pull(i).norm() <= at.bound ? ContactMode::sticks
                                                           : ContactMode::slides;
    changed |= habit != at.habit;
    at.habit = habit;
  }
  return changed;
}

template <int N>
int ContactSolverOf<N>::number_that_slide() const {
  return static_cast<int>(
      std::count_if(local_.begin(), local_.end(), [](const Local& at) { return at.habit == ContactMode::slides; }));
}

template <int N>
bool ContactSolverOf<N>::see_motor_habits() {
  bool changed = false;
  for (std::size_t b = 0; b < u_.size(); ++b) {
    for (int m = 0; m < joints; ++m) {
      const Motor& motor = p_->bodies[b].motors[m];
      const double lacks = (motor.asked - u_[b][6 + m]) / motor.softness;
      const MotorHabit habit = lacks > motor.limit    ? MotorHabit::pulls
                               : lacks < -motor.limit ? MotorHabit::brakes
                                                      : MotorHabit::holds;
      changed |= habit != motor_habits_[b][m];
      motor_habits_[b][m] = habit;
    }
  }
  return changed;
}

template <int N>
void ContactSolverOf<N>::factor_habits() {
  begin_hessian();
  for (std::size_t b = 0; b < u_.size(); ++b) {
    MassMatrixOf<N>& block = hessian_.diagonal(static_cast<int>(b));
    for (int m = 0; m < joints; ++m) {
      if (motor_habits_[b][m] == MotorHabit::holds) block(6 + m, 6 + m) += 1 / p_->bodies[b].motors[m].softness;
    }
  }
  for (std::size_t i = 0; i < local_.size(); ++i) {
    const Contact& c = p_->contacts[i];
    Local& at = local_[i];
    GripStiffness grip{};
    if (at.habit == ContactMode::open) continue;
    if (at.habit == ContactMode::sticks) grip = sticking(c.grip_softness);
    if (at.habit == ContactMode::slides) {
      const Vector2d asked = pull(i);
      const double size = asked.norm();
      at.way = asked / size;
      at.stiffness = std::min(weight(i) * at.bound / (size - at.bound), 1 / c.grip_softness);
      grip = across(at.way, at.stiffness);
    }
    add(c, 1 / c.softness, grip);
  }
  hessian_.factor();
}

// Impulses by mode, that of sliding contacts by their slip, and the step that makes all of them consistent.
template <int N>
void ContactSolverOf<N>::step_by_habits() {
  for (std::size_t b = 0; b < u_.size(); ++b) {
    const auto& body = p_->bodies[b];
    d_[b] = u_[b] - body.free;
    blocks_.apply(d_[b].data(), body.inertia->mass.data());
    for (int m = 0; m < joints; ++m) {
      const Motor& motor = body.motors[m];
      d_[b][6 + m] -= motor_habits_[b][m] == MotorHabit::holds ? (motor.asked - u_[b][6 + m]) / motor.softness
                                                               : motor.impulse(u_[b][6 + m]);
    }
  }
  for (std::size_t i = 0; i < local_.size(); ++i) {
    Contact& c = p_->contacts[i];
    const Local& at = local_[i];
    if (at.habit == ContactMode::open) continue;
    c.push = (c.target - at.speed()) / c.softness;
    c.grip = grip_by_habit(i);
    take_impulse(c, d_);
  }
  hessian_.solve(d_);
  for (Velocity& d : d_) d = -d;
  Velocity weights = Velocity::Constant(rim * rim);
  weights.template head<3>().setConstant(turn_arm * turn_arm);
  weights.template segment<3>(3).setOnes();
  mixing_.mix(u_, d_, weights);
  for (std::size_t b = 0; b < u_.size(); ++b) u_[b] += d_[b];
}

template <int N>
Vector2d ContactSolverOf<N>::grip_by_habit(std::size_t contact) const {
  const Contact& c = p_->contacts[contact];
  const Local& at = local_[contact];
  if (at.habit == ContactMode::sticks) return -at.slip() / c.grip_softness;
  if (at.habit != ContactMode::slides) return Vector2d::Zero();
  return at.slip().norm() < at_rest ? sliding_grip(at) : grip_of(at.slip(), at.bound, c.grip_softness);
}

// For a sliding contact that keeps its direction.
template <int N>
Vector2d ContactSolverOf<N>::sliding_grip(const Local& at) {
  const Vector2d side = beside(at.way);
  return at.bound * at.way - at.stiffness * side.dot(at.slip()) * side;
}

// After a step: friction impulses by mode, within their bounds or not.
template <int N>
void ContactSolverOf<N>::note_grips() {
  for (std::size_t i = 0; i < local_.size(); ++i) {
    const Contact& c = p_->contacts[i];
    Local& at = local_[i];
    at.closes = c.push > 0;
    if (at.habit == ContactMode::sticks) {
      at.dual = -at.slip() / c.grip_softness;
    } else if (at.habit == ContactMode::slides && at.slip().dot(at.way) > 0) {  // against the direction of sliding
      at.dual = within(sliding_grip(at), at.bound);
    } else {
      at.dual = c.grip;
    }
  }
}

template bool ContactSolverOf<unknowns>::go_on();
template bool ContactSolverOf<unknowns_with_legs>::go_on();

}  // namespace muster::simbody
