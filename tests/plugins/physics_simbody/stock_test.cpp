// Simbody's own integrators on rolling constraints: the reference that our stepper must agree with.
#include "scarabs.hpp"

namespace muster::simbody {
namespace {

Command gentle(double t) { return command(0.25 + 0.15 * std::sin(1.3 * t), 0.8 * std::sin(0.9 * t)); }

RobotState end_of(Integrator integrator, double step) {
  Fleet run({rolling(0, 0, 0, 0.25, 0)}, scarab(), integrator, step);
  run.drive(2, 0.01, gentle);
  return run.states[0];
}

double apart(const RobotState& a, const RobotState& b) {
  return std::hypot(a.pose[0] - b.pose[0], a.pose[1] - b.pose[1]) + std::abs(yaw(a) - yaw(b)) * 0.1;
}

TEST(SimbodyIntegrators, StepperAgreesWithRungeKutta) {
  const RobotState reference = end_of(Integrator::rk3, 0.002);
  EXPECT_GT(std::abs(reference.pose[0]), 0.3);
  EXPECT_LT(apart(end_of(Integrator::midpoint, 0.001), reference), 2e-5);
}

TEST(SimbodyIntegrators, AdaptiveIntegratorsAgree) {
  const RobotState reference = end_of(Integrator::rk3, 0.002);
  EXPECT_LT(apart(end_of(Integrator::rkm, 0.01), reference), 2e-5);
  EXPECT_LT(apart(end_of(Integrator::cpodes, 0.01), reference), 2e-4);
}

TEST(SimbodyIntegrators, WheelsTurnAsAsked) {
  const RobotState s = end_of(Integrator::rk3, 0.005);
  const Command c = gentle(2);
  EXPECT_NEAR(s.rate[0], c.left, 1e-9);
  EXPECT_NEAR(s.rate[1], c.right, 1e-9);
}

}  // namespace
}  // namespace muster::simbody
