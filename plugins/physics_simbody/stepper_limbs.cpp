// The step of robots with limbs: forces that depend on velocities are those between two steps, so contacts are solved
// twice.
#include "motion.hpp"
#include "stepper.hpp"

namespace muster::simbody {

using Eigen::Matrix3d;
using Eigen::Vector3d;

template <int N>
void StepperOf<N>::place_limbs(const CrewMember& robot, double h, double at, const Command& command,
                               const RobotState& state, PlacedOf<N>& now) {
  if constexpr (N == unknowns_with_legs) {
    auto& body = now.body;
    const auto& drive = robot.model.drive;
    const double asked[] = {command.left + at * command.left_rate, command.right + at * command.right_rate};
    for (int w = 0; robot.model.has_wheels && w < 2; ++w) {
      body.previous[6 + w] = state.rate[w];
      body.motors[w] = {drive.limited_rate(asked[w]), drive.max_torque * h};
    }
    now.posture = posture_of(robot.model, state.limbs, now.to_world.transpose() * matrix_of(state));
    take_rates(robot.model, now.posture, state.limbs, body.previous);
    if (robot.model.feels_limbs()) {
      Limbs ahead = state.limbs;
      now.posture_ahead = now.posture;
      move_limbs(robot.model, 0.5 * h, Matrix3d::Identity(), body.previous, now.posture_ahead, ahead);
    }
    for (const LimbModel& limb : robot.model.limbs) {
      for (int k = limb.first; k < limb.first + law_of(limb.kind).rates; ++k)
        body.motors[k - 6] = joint_motor(limb, 0.5 * (state.memory.previous_step + h));
    }
    push(robot, h, state, body.previous, now);
    push(robot, h, state, body.free, now);
    stop_limbs(robot, h, state, body.free, now);
  }
}

// Velocity-dependent forces are evaluated between the two steps, half way to the velocities to be found: `after` is the
// best available estimate of these.
template <int N>
void StepperOf<N>::push(const CrewMember& robot, double h, const RobotState& state, const VelocityOf<N>& after,
                        PlacedOf<N>& now) {
  if constexpr (N == unknowns_with_legs) {
    auto& body = now.body;
    const double kick = 0.5 * (state.memory.previous_step + h),
                 share = kick > 0 ? 0.5 * state.memory.previous_step / kick : 0;
    const VelocityOf<N> between = body.previous + share * (after - body.previous);
    const Vector3d fall = now.to_world.transpose() * Vector3d(0, 0, -gravity);
    LimbedMass limbed = weigh(robot.model, now.posture, between, fall);
    if (robot.model.rotors) {
      const Matrix3d& turn = now.posture.body;
      const auto wrench = robot.model.rotors->wrench(state.rotors, turn.transpose() * between.template segment<3>(3),
                                                     turn.transpose() * between.template head<3>());
      limbed.force.template head<3>() += turn * wrench.torque;
      limbed.force.template segment<3>(3) += turn * wrench.force;
    }
    now.inertia.mass = limbed.mass + kick * share * limbed.damping;
    now.inertia.inverse = now.inertia.mass.llt().solve(MassMatrixOf<N>::Identity());
    body.free = body.previous + kick * (now.inertia.inverse * (limbed.force - limbed.damping * body.previous));
  }
}

template <int N>
void StepperOf<N>::stop_limbs(const CrewMember& robot, double h, const RobotState& state, const VelocityOf<N>& rates,
                              PlacedOf<N>& now) {
  for (std::size_t i = 0; i < robot.model.limbs.size(); ++i) {
    const LimbModel& limb = robot.model.limbs[i];
    if (law_of(limb.kind).rates == 1)
      stop_at_limits(limb, state.limbs.limb[i], rates[limb.first], h, now.body.motors[limb.first - 6]);
  }
}

// Repeats push() with the velocities after contacts and motors. False if no robot has limbs.
template <int N>
bool StepperOf<N>::push_again(const Island& island, double h, const std::vector<RobotState>& states) {
  bool any = false;
  for (std::size_t i = 0; i < island.robots.size(); ++i) {
    const int index = island.robots[i];
    const CrewMember& robot = arena_.crew[index];
    if (robot.model.limbs.empty()) continue;
    PlacedOf<N>& now = placed()[index];
    push(robot, h, states[index], problem_.bodies[i].velocity, now);
    stop_limbs(robot, h, states[index], problem_.bodies[i].velocity, now);
    problem_.bodies[i] = now.body;
    any = true;
  }
  return any;
}

template <int N>
void StepperOf<N>::finish_limbs(const CrewMember& robot, double h, const PlacedOf<N>& now, RobotState& state) const {
  if constexpr (N == unknowns_with_legs) {
    if (robot.model.limbs.empty()) return;
    Posture posture = now.posture;
    move_limbs(robot.model, h, now.to_world.transpose() * matrix_of(state), now.body.velocity, posture, state.limbs);
    leave_rates(robot.model, posture, now.body.velocity, state.limbs);
  }
}

template void StepperOf<unknowns>::place_limbs(const CrewMember&, double, double, const Command&, const RobotState&,
                                               PlacedOf<unknowns>&);
template void StepperOf<unknowns_with_legs>::place_limbs(const CrewMember&, double, double, const Command&,
                                                         const RobotState&, PlacedOf<unknowns_with_legs>&);
template bool StepperOf<unknowns>::push_again(const Island&, double, const std::vector<RobotState>&);
template bool StepperOf<unknowns_with_legs>::push_again(const Island&, double, const std::vector<RobotState>&);
template void StepperOf<unknowns>::finish_limbs(const CrewMember&, double, const PlacedOf<unknowns>&,
                                                RobotState&) const;
template void StepperOf<unknowns_with_legs>::finish_limbs(const CrewMember&, double,
                                                          const PlacedOf<unknowns_with_legs>&, RobotState&) const;

}  // namespace muster::simbody
