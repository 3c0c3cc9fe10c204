// A hexapod walks: stride of rigid legs, tripods, feet, slabs, neighbours.
#include "walkers.hpp"

namespace muster::simbody {
namespace {

double tilt(const RobotState& s) { return 2 * std::hypot(s.pose[4], s.pose[5]); }

// From one whole cycle to another, without the startup.
double travel(const description::Robot& robot, double frequency, double step) {
  Fleet fleet({at_rest(0, 0, 0)}, robot, Integrator::midpoint, step);
  const Walk gait{frequency};
  const double first = Walk::begin + 1.75 / frequency;
  double x = 0;
  const double dt = 0.01;
  walk(fleet, gait, 0, first + 3 / frequency, dt, [&](double t) {
    if (std::abs(t - first) < dt / 2) x = fleet.states[0].pose[0];
  });
  return (fleet.states[0].pose[0] - x) / 3;
}

// Controllers yield under the weight, by some hundredths of a radian in a stance of one; stiffer ones by less.
TEST(Walking, RigidLegsGoAsFarAsTheyRoll) {
  description::Robot stiff = rigid_rdk();
  stiff.legs->position_gain *= 10, stiff.legs->rate_gain *= 10, stiff.legs->max_torque *= 10;
  for (const double frequency : {0.25, 0.5, 1.0}) {
    const double stride = Walk{frequency}.stride();
    EXPECT_NEAR(travel(rigid_rdk(), frequency, 0.001), stride, 0.015 * stride) << frequency;
    EXPECT_NEAR(travel(stiff, frequency, 0.001), stride, 0.002 * stride) << frequency;
  }
}

// Limit of the approximation of rigid legs: docs/explanation/hexapod.md.
TEST(Walking, FasterGaitsAreFasterAndLeaveRigidLegsBehind) {
  double before = 0;
  for (const double frequency : {0.25, 0.5, 1.0, 1.6}) {
    const double compliant = frequency * travel(rdk(), frequency, 0.001);
    const double rigid = frequency * travel(rigid_rdk(), frequency, 0.001);
    EXPECT_GT(compliant, before);
    before = compliant;
    const double gap = compliant / rigid - 1;
    if (frequency <= 0.5) {
      EXPECT_LT(std::abs(gap), 0.025) << frequency;
    }
    if (frequency > 1.5) {
      EXPECT_GT(gap, 0.05) << frequency;
    }
  }
}

TEST(Walking, ShortStepsChangeLittle) {
  const double fine = travel(rdk(), 1, 0.0005);
  EXPECT_NEAR(travel(rdk(), 1, 0.002), fine, 0.002 * fine);
}

TEST(Walking, TripodsTakeTurns) {
  Fleet fleet({at_rest(0, 0, 0)}, rdk(), Integrator::midpoint, 0.002);
  const RobotModel model(rdk());
  const Walk gait{0.5};
  int seen = 0;
  double least = 1e9, most = -1e9, lean = 0;
  walk(fleet, gait, 0, 8, 0.01, [&](double t) {
    const RobotState& s = fleet.states[0];
    if (t < 2) return;
    least = std::min(least, s.pose[2]), most = std::max(most, s.pose[2]), lean = std::max(lean, tilt(s));
    for (int tripod = 0; tripod < 2; ++tripod) {
      const double phase = gait.phase(t) + 0.5 * tripod;
      if (std::abs(phase - std::round(phase)) > 0.1) continue;  // upright, while the others swing
      ++seen;
      for (std::size_t leg = 0; leg < 6; ++leg) {
        const double height = foot_height(s, leg, model);
        if (rdk().legs->legs[leg].tripod == tripod) {
          EXPECT_LT(height, 0) << t << ' ' << leg;
        } else {
          EXPECT_GT(height, 0.01) << t << ' ' << leg;
        }
      }
    }
  });
  EXPECT_GT(seen, 100);
  // Between the lowest hips of a stride and the highest, less the deflection of three legs.
  const double sink = gravity * 2.7 / (3 * 2000);
  EXPECT_GT(least, 0.06 * (1 + std::cos(0.5)) - 0.12 - 2 * sink);
  EXPECT_LT(most, 0.001);
  EXPECT_LT(lean, 0.05);
  EXPECT_LT(std::abs(fleet.states[0].pose[1]), 0.05);
  EXPECT_LT(std::abs(yaw(fleet.states[0])), 0.05);
}

TEST(Walking, CarriesItsPayload) {
  description::Robot loaded = rdk();
  description::Mass& base = loaded.links[0].mass;
  const double scale = (base.mass + 3) / base.mass;
  base.mass *= scale, base.inertia *= scale;
  EXPECT_NEAR(travel(loaded, 0.5, 0.002), Walk{0.5}.stride(), 0.1 * Walk{0.5}.stride());
}

TEST(Walking, StepsOverSlabs) {
  std::vector<scene::Wall> slabs;
  slabs.push_back({0.4, 0, 0.8, 0, 0, 0.02, 2, 0});
  slabs.push_back({1.0, 0, 1.3, 0, 0, 0.03, 2, 0});
  Fleet fleet({at_rest(0, 0, 0)}, rdk(), Integrator::midpoint, 0.002);
  fleet.among(slabs, 0.8);
  double highest = 0, lean = 0;
  walk(fleet, {1}, 0, 12, 0.01, [&](double) {
    highest = std::max(highest, fleet.states[0].pose[2]);
    lean = std::max(lean, tilt(fleet.states[0]));
  });
  EXPECT_GT(fleet.states[0].pose[0], 1.5);
  EXPECT_GT(highest, 0.015);
  EXPECT_LT(lean, 0.3);
}

TEST(Walking, StandsOnASlab) {
  Fleet fleet({at_rest(0, 0, 0)}, rdk(), Integrator::midpoint, 0.002);
  fleet.among({{-1, 0, 1, 0, 0, 0.04, 2, 0}}, 0.8);
  fleet.states[0].pose[2] = 0.04;
  for (int k = 0; k < 200; ++k) fleet.tick(0.01, {Command{}});
  EXPECT_NEAR(fleet.states[0].pose[2], 0.04 - gravity * 2.7 / 12000, 1e-4);
}

TEST(Walking, RemadeEngineGivesTheSameBits) {
  const std::vector<scene::Wall> slab = {{0.3, 0, 0.6, 0, 0, 0.02, 2, 0}};
  Fleet straight({at_rest(0, 0, 0.1)}, rdk(), Integrator::midpoint, 0.002);
  Fleet remade(straight.states, rdk(), Integrator::midpoint, 0.002);
  straight.among(slab, 0.8);
  remade.among(slab, 0.8);
  int ticks = 0;
  const Walk gait{1};
  for (int k = 0; k < 400; ++k) {
    const Command c = gait.over(k * 0.01, 0.01);
    straight.tick(0.01, {c});
    if (++ticks % 7 == 3) remade.remake();
    remade.tick(0.01, {c});
  }
  expect_same_bits(straight.states[0], remade.states[0]);
  EXPECT_EQ(straight.states[0].leg_angle, remade.states[0].leg_angle);
  EXPECT_EQ(straight.states[0].leg_rate, remade.states[0].leg_rate);
  EXPECT_GT(straight.states[0].pose[0], 0.4);  // over the slab
}

TEST(Walking, AScarabInTheWayIsPushedAndNotPassed) {
  const auto both = make_engine({{"walker", &rdk()}, {"roller", &scarab()}}, Integrator::midpoint, 0.001);
  both->set_surroundings({}, 0.3);
  std::vector<RobotState> states = {at_rest(0, 0, 0), at_rest(0.45, 0, 1.5707963267948966)};
  for (int k = 0; k < 500; ++k) both->step(0.01, {Walk{1}.over(k * 0.01, 0.01), Command{}}, states);
  // The walker's front and the Scarab's side; a leg may reach under its box.
  EXPECT_GT(states[1].pose[0] - states[0].pose[0], 0.175 + 0.06);
  EXPECT_LT(states[0].pose[0], 0.6);  // 0.9 m without the Scarab
}

}  // namespace
}  // namespace muster::simbody
