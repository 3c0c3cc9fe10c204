// Limbs of every kind, at random: their dynamics are Simbody's.
#include <random>

#include "limbed.hpp"
#include "robot_models.hpp"

namespace muster::simbody {
namespace {

// Its system in Simbody, and the conversion of our states.
struct AsSimbody {
  explicit AsSimbody(const Robot& robot) : model(robot) {
    bodies = system.add(model);
    for (std::size_t i = 0; i < model.limbs.size(); ++i) {
      const LimbModel& limb = model.limbs[i];
      if (limb.kind != JointKind::ball && limb.damping > 0)
        SimTK::Force::MobilityLinearDamper(system.forces, bodies.limbs[i], SimTK::MobilizerUIndex(0), limb.damping);
    }
    system.finish();
  }

  SimTK::State state_of(const RobotState& s) const {
    SimTK::State state = system.state;
    for (int k = 0; k < 4; ++k) state.updQ()[k] = s.pose[3 + k];
    for (int k = 0; k < 3; ++k) {
      state.updQ()[4 + k] = s.pose[k];
      state.updU()[k] = s.twist[3 + k];
      state.updU()[3 + k] = s.twist[k];
    }
    for (int w = 0; model.has_wheels && w < 2; ++w) {
      state.updQ()[7 + w] = s.angle[w];
      state.updU()[6 + w] = s.rate[w];
    }
    for (std::size_t i = 0; i < model.limbs.size(); ++i)
      set_limb(bodies.limbs[i], model.limbs[i], s.limbs.limb[i], state);
    return state;
  }

  RobotModel model;
  System system;
  RobotBodies bodies;
};

class LimbsAtRandom : public testing::TestWithParam<bool> {
 protected:
  double draw() { return static_cast<double>(random_()) / 2147483648.0 - 1; }
  Robot robot() const { return GetParam() ? tree(hummingbird(), true) : tree(scarab(), false); }

  RobotState draw_state(const RobotModel& model) {
    RobotState s = at_rest(draw(), draw(), 0);
    const auto q = Eigen::Quaterniond(draw(), draw(), draw(), draw()).normalized();
    s.pose = {draw(), draw(), 100 + draw(), q.w(), q.x(), q.y(), q.z()};
    for (double& v : s.twist) v = 3 * draw();
    for (int w = 0; model.has_wheels && w < 2; ++w) s.angle[w] = draw(), s.rate[w] = 5 * draw();
    for (std::size_t i = 0; i < model.limbs.size(); ++i) {
      Limb& limb = s.limbs.limb[i];
      if (model.limbs[i].kind == JointKind::ball) {
        turn(limb, Eigen::Quaterniond(draw(), draw(), draw(), draw()).normalized());
        limb.wx = 3 * draw(), limb.wy = 3 * draw(), limb.wz = 3 * draw();
      } else if (model.limbs[i].kind == JointKind::prismatic) {
        limb.way = draw(), limb.speed = 3 * draw();
      } else {
        limb.angle = 3 * draw(), limb.rate = 3 * draw();
      }
    }
    return s;
  }

  std::mt19937 random_{7};
};

TEST_P(LimbsAtRandom, DynamicsAreSimbodys) {
  Robot free = robot();
  for (auto& joint : free.joints) joint.damping = 0;
  const AsSimbody simbody(free);
  const RobotModel& model = simbody.model;
  for (int trial = 0; trial < 20; ++trial) {
    const RobotState s = draw_state(model);
    const SimTK::State state = simbody.state_of(s);
    simbody.system.system.realize(state, SimTK::Stage::Acceleration);
    const Matrix3d r = Eigen::Quaterniond(s.pose[3], s.pose[4], s.pose[5], s.pose[6]).toRotationMatrix();
    const Posture posture = posture_of(model, s.limbs, r);
    VelocityOf<12> u = VelocityOf<12>::Zero(), expected = u;
    for (int k = 0; k < 3; ++k) u[k] = s.twist[3 + k], u[3 + k] = s.twist[k];
    for (int k = 0; k < (model.has_wheels ? 8 : 6); ++k) expected[k] = state.getUDot()[k];
    for (int w = 0; model.has_wheels && w < 2; ++w) u[6 + w] = s.rate[w];
    take_rates(model, posture, s.limbs, u);
    for (std::size_t i = 0; i < model.limbs.size(); ++i) {
      const SimTK::MobilizedBody& body = simbody.bodies.limbs[i];
      const SimTK::Vec3 spin = body.getBodyAngularVelocity(state), change = body.getBodyAngularAcceleration(state);
      const bool is_ball = model.limbs[i].kind == JointKind::ball;
      for (int k = 0; k < 3 && is_ball; ++k) {
        expected[model.limbs[i].first + k] = change[k];
        EXPECT_NEAR(u[model.limbs[i].first + k], spin[k], 1e-12);
      }
      if (!is_ball) expected[model.limbs[i].first] = body.getOneUDot(state, 0);
    }
    const LimbedMass mine = weigh(model, posture, u, {0, 0, -gravity});
    const double energy = simbody.system.matter.calcKineticEnergy(state);
    EXPECT_NEAR(0.5 * u.dot(mine.mass * u), energy, 1e-10 * energy);
    const VelocityOf<12> found = mine.mass.llt().solve(mine.force);
    EXPECT_LT((found - expected).norm(), 1e-9 * expected.norm()) << found.transpose() << "\n" << expected.transpose();
    Limbs back = s.limbs;
    for (Limb& limb : back.limb) limb.rate = limb.speed = limb.wx = limb.wy = limb.wz = 99;
    leave_rates(model, posture, u, back);
    for (std::size_t i = 0; i < model.limbs.size(); ++i) {
      const Limb &is = back.limb[i], &was = s.limbs.limb[i];
      const JointKind kind = model.limbs[i].kind;
      if (kind == JointKind::ball) {
        EXPECT_NEAR(std::hypot(is.wx - was.wx, is.wy - was.wy, is.wz - was.wz), 0, 1e-12);
      } else {
        EXPECT_EQ(kind == JointKind::prismatic ? is.speed : is.rate,
                  kind == JointKind::prismatic ? was.speed : was.rate);
      }
    }
  }
}

// Through the air with all limbs swinging and one damped, against Simbody's Runge-Kutta method to ten digits.
TEST_P(LimbsAtRandom, FlightConvergesToSimbodysInSecondOrder) {
  Robot flying = robot();
  for (auto& joint : flying.joints) joint.damping *= joint.kind != JointKind::ball;
  if (flying.drive) flying.drive->max_torque = 1e-12;
  const AsSimbody simbody(flying);
  const RobotState start = draw_state(simbody.model);
  constexpr double until = 0.4;
  SimTK::RungeKuttaMersonIntegrator integrator(simbody.system.system);
  integrator.setAccuracy(1e-11);
  integrator.setAllowInterpolation(false);
  integrator.initialize(simbody.state_of(start));
  while (integrator.getTime() < until) integrator.stepTo(until);
  const SimTK::State& truth = integrator.getState();
  const auto error = [&](double h) {
    Fleet run({start}, flying, Integrator::midpoint, h);
    const int ticks = static_cast<int>(std::lround(until / h));
    for (int k = 0; k < ticks; ++k) run.tick(h, {Command{}});
    const SimTK::State end = simbody.state_of(run.states[0]);
    SimTK::Vector off = end.getQ() - truth.getQ();
    for (const auto& limb : simbody.bodies.limbs) {
      if (limb.getNumQ(end) == 4 && ~limb.getQAsVector(end) * limb.getQAsVector(truth) < 0)
        for (int k = 0; k < 4; ++k) off[limb.getFirstQIndex(end) + k] += 2 * truth.getQ()[limb.getFirstQIndex(end) + k];
    }
    return off.norm();
  };
  const double coarse = error(0.002), middle = error(0.001), fine = error(0.0005);
  EXPECT_NEAR(std::log2(coarse / middle), 2, 0.15) << coarse << ' ' << middle;
  EXPECT_NEAR(std::log2(middle / fine), 2, 0.15) << middle << ' ' << fine;
  EXPECT_LT(fine, 2e-6);
}

INSTANTIATE_TEST_SUITE_P(Robots, LimbsAtRandom, testing::Bool(),
                         [](const auto& one) { return one.param ? "Hummingbird" : "Scarab"; });

}  // namespace
}  // namespace muster::simbody
