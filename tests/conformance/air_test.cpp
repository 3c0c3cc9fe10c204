// Robots in the air: requirements for any backend with rotors.
#include "tests/conformance/physics_backends.hpp"

namespace muster::test {
namespace {

class InTheAir : public EachBackend {};

// Rotors that lag speed up from rest, so that thrust grows as (1 - exp(-t / lag))^2: twice integrated.
TEST_P(InTheAir, ClimbsAsItsRotorsSpeedUpOrRefusesWithTheList) {
  const std::string world = bird("a", "1 2 20") + lift(600);
  if (!GetParam().rotors) {
    try {
      run(world, {}, {});
      FAIL() << "nothing was thrown";
    } catch (const Error& error) {
      EXPECT_EQ(error.exit(), Exit::invalid_input);
      EXPECT_THAT(error.what(), testing::HasSubstr("it lacks what the world's robots need: robot 'a' (model "
                                                   "'hummingbird') needs rotors (<quadrotor>), "));
    }
    return;
  }
  Started sim = run(world, {}, {});
  run_for(sim, 100);
  const auto robot = description::read_robot(models + "hummingbird.urdf");
  const double t = 1, lag = robot.quadrotor->lag_up;
  const double rise = t * t / 2 - 2 * lag * (t - lag * (1 - std::exp(-t / lag))) +
                      lag / 2 * (t - lag / 2 * (1 - std::exp(-2 * t / lag)));
  const double up = 4 * robot.quadrotor->thrust_factor * 600 * 600 / whole_mass(robot).mass;
  EXPECT_NEAR(state(sim).pose.z, 20 + up * rise - gravity * t * t / 2, GetParam().climb);
  EXPECT_LT(state(sim).distance(1, 2), 1e-9);
}

// Lifted beside its centre of mass by rotors that speed up together, it rolls by their thrust's moment.
TEST_P(InTheAir, RollsWhereItIsLiftedBesideItsCentreOfMass) {
  if (!GetParam().rotors) GTEST_SKIP() << "claims no rotors";
  std::string urdf = contents(models + "hummingbird.urdf");
  const std::string body = "<mass value=\"0.68\"/>";
  urdf.insert(urdf.find(body), "<origin xyz=\"0 0.002 0\"/>");
  const auto robot = description::read_robot(folder.write("uneven.urdf", urdf).string());
  Started sim = run("<robot name='a' model='uneven.urdf' at='0 0 50'/>" + lift(600), {}, {});
  run_for(sim, 30);
  const auto whole = whole_mass(robot);
  const double t = 0.3, lag = robot.quadrotor->lag_up;
  const double rise = t * t / 2 - 2 * lag * (t - lag * (1 - std::exp(-t / lag))) +
                      lag / 2 * (t - lag / 2 * (1 - std::exp(-2 * t / lag)));
  const double moment = -whole.centre.y() * 4 * robot.quadrotor->thrust_factor * 600 * 600;
  const double roll = moment / whole.inertia(0, 0) * rise;
  const Pose p = state(sim).pose;
  EXPECT_NEAR(2 * std::atan2(p.qx, p.qw), roll, 0.02 * std::abs(roll));
}

TEST_P(InTheAir, TumblesWithItsMomentum) {
  if (!GetParam().rotors) GTEST_SKIP() << "claims no rotors";
  const auto whole = whole_mass(description::read_robot(models + "hummingbird.urdf"));
  Started sim = run(bird("a", "0 0 50") + lift(0), {{"forward", "1"}, {"tumble", "4"}, {"turn", "3"}}, {});
  const auto turned = [&] {
    const Pose p = state(sim).pose;
    return Eigen::Quaterniond(p.qw, p.qx, p.qy, p.qz);
  };
  const auto momentum = [&]() -> Eigen::Vector3d {
    const Twist t = state(sim).twist;
    return turned() * (whole.inertia * (turned().conjugate() * Eigen::Vector3d(t.wx, t.wy, t.wz)));
  };
  const Eigen::Vector3d before = momentum();
  const Eigen::Quaterniond stood = turned();
  run_for(sim, 200);
  EXPECT_LT((momentum() - before).norm(), GetParam().spin * before.norm());
  EXPECT_GT(turned().angularDistance(stood), 0.1);
}

// Two robots that collide while falling, not quite head on: their sideways impulses sum to zero.
TEST_P(InTheAir, KeepsMomentumInACollision) {
  if (!GetParam().rotors) GTEST_SKIP() << "claims no rotors";
  const auto whole = whole_mass(description::read_robot(models + "hummingbird.urdf"));
  const std::string other = "<robot name='b' model='hummingbird' heading='3.5' at='1 0.12 50'/>";
  Started sim = run(bird("a", "0 0 50") + other + lift(0), {{"forward", "1"}}, {});
  const auto momentum = [&](const std::string& robot) -> Eigen::Vector3d {
    const State s = state(sim, robot);
    const Eigen::Quaterniond q(s.pose.qw, s.pose.qx, s.pose.qy, s.pose.qz);
    const Eigen::Vector3d v(s.twist.vx, s.twist.vy, s.twist.vz), w(s.twist.wx, s.twist.wy, s.twist.wz);
    return whole.mass * (v + w.cross(q * whole.centre));
  };
  const Eigen::Vector3d alone = momentum("a"), both = alone + momentum("b");
  run_for(sim, 120);
  EXPECT_LT((momentum("a") + momentum("b") - both).head<2>().norm(), GetParam().collision * alone.norm());
  EXPECT_GT((momentum("a") - alone).head<2>().norm(), 0.3 * alone.norm());  // they did meet
}

TEST_P(InTheAir, ConvergesInItsOrderInTheAir) {
  if (GetParam().flight_order == 0) GTEST_SKIP() << "claims no order in the air";
  const auto end = [&](double step) {
    Started sim = started(GetParam(), bird("a", "0 0 50") + lift(460, 6), {{"forward", "1"}, {"tumble", "0.5"}}, {},
                          0.2, 1, {{"step", std::to_string(step)}});
    run_for(sim, 10);
    const Pose p = state(sim).pose;
    return Eigen::Vector3d(p.x, p.y, p.z);
  };
  const Eigen::Vector3d truth = end(0.0002);
  std::vector<double> errors;
  const double coarsest = GetParam().flight_order > 2 ? 0.0125 : 0.00625;
  for (const double share : {1.0, 0.5, 0.25}) errors.push_back((end(share * coarsest) - truth).norm());
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), GetParam().flight_order, 0.3) << errors[0] << ' ' << errors[1];
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), GetParam().flight_order, 0.3) << errors[1] << ' ' << errors[2];
}

TEST_P(InTheAir, GivesTheSameBitsInTheAirForAnyWorkersRemadeAndRestored) {
  if (!GetParam().rotors) GTEST_SKIP() << "claims no rotors";
  expect_same_bits([&](int workers) { return run(air, {}, wild, workers); }, 40);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(InTheAir);
INSTANTIATE_TEST_SUITE_P(Plugins, InTheAir, testing::ValuesIn(backends()), test_name);

}  // namespace
}  // namespace muster::test
