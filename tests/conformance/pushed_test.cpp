// Robots without a drive, on flat ground: requirements for any backend in which others push them.
#include "tests/conformance/physics_backends.hpp"

namespace muster::test {
namespace {

constexpr double mu = 0.3;  // the default between bodies and ground

std::string crate(const std::string& heading, const std::string& at = "0 0 0") {
  return "<robot name='a' model='crate' at='" + at + "' heading='" + heading + "'/>";
}

class Pushed : public EachBackend {
 protected:
  // A homogeneous ball with its frame in the middle.
  std::string ball() const {
    folder.write("ball.urdf",
                 "<robot name='ball'><link name='ball'><inertial><mass value='1'/><inertia ixx='0.004' ixy='0' ixz='0' "
                 "iyy='0.004' iyz='0' izz='0.004'/></inertial><collision><geometry><sphere radius='0.1'/></geometry>"
                 "</collision></link></robot>");
    return "<robot name='a' model='ball.urdf' at='0 0 0.1' heading='0.3'/>";
  }
};

TEST_P(Pushed, IsRefusedWithTheListWhereNothingPushes) {
  if (GetParam().pushed) GTEST_SKIP() << "claims to push";
  try {
    run(crate("0"), {}, {});
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit(), Exit::invalid_input);
    EXPECT_THAT(error.what(), testing::HasSubstr("it lacks what the world's robots need: robot 'a' (model 'crate') "
                                                 "needs motion without a drive"));
  }
}

TEST_P(Pushed, ACrateStandsStillAtRest) {
  if (!GetParam().pushed) GTEST_SKIP() << "claims no pushing";
  Started sim = run(crate("1", "3 -2 0"), {}, {});
  run_for(sim, 200);
  EXPECT_LT(state(sim).distance(3, -2), GetParam().rest);
  EXPECT_NEAR(2 * std::atan2(state(sim).pose.qz, state(sim).pose.qw), 1, GetParam().rest);
  EXPECT_LT(state(sim).speed(), 1e-3);
  EXPECT_NEAR(state(sim).pose.z, 0, 1e-4);
}

// On four corners, whose friction shifts weight to the front: in sum it equals the friction of its weight.
TEST_P(Pushed, ACrateSlidesTheSquareOfItsSpeedOverTwiceFrictionAndGravity) {
  if (!GetParam().pushed) GTEST_SKIP() << "claims no pushing";
  const double expected = 1 / (2 * mu * gravity);
  std::vector<double> headings{0};
  if (GetParam().round_friction) headings = {0, 0.3, 0.7853981633974483, 2};
  for (const double heading : headings) {
    Started sim = run(crate(std::to_string(heading)), {{"forward", "1"}}, {});
    run_for(sim, 100);
    const Pose p = state(sim).pose;
    const double along = p.x * std::cos(heading) + p.y * std::sin(heading);
    EXPECT_NEAR(along, expected, GetParam().slide * expected) << heading;
    EXPECT_NEAR(p.y * std::cos(heading), p.x * std::sin(heading), GetParam().slide * expected) << heading;
  }
}

// Thrown without spin it slides until it rolls, with five sevenths of its speed: the moment of momentum about its
// contact point is conserved.
TEST_P(Pushed, ABallThatSlidesRollsWithFiveSeventhsOfItsSpeed) {
  if (!GetParam().pushed) GTEST_SKIP() << "claims no pushing";
  const double v = 1, until = 2 * v / (7 * mu * gravity), end = 0.5;
  Started sim = run(ball(), {{"forward", "1"}}, {});
  run_for(sim, 50);
  const State now = state(sim);
  const double expected = v * until - mu * gravity * until * until / 2 + 5 * v / 7 * (end - until);
  EXPECT_NEAR(now.speed(), 5 * v / 7, GetParam().slide);
  EXPECT_NEAR(std::hypot(now.twist.wx, now.twist.wy), 5 * v / 7 / 0.1, 10 * GetParam().slide);
  EXPECT_NEAR(now.distance(0, 0), expected, GetParam().slide * expected);
}

// Two wheels pull with torque over radius, against the rolling mass and the pushed one. Where the two touch they stick,
// so friction may shift weight from one to the other, by up to its bound.
TEST_P(Pushed, ARobotPushesACrateWithWhatItsMotorsGive) {
  if (!GetParam().pushed || !GetParam().torque) GTEST_SKIP() << "claims no pushing or no torque";
  const double torque = 0.4, wheel_inertia = 0.00025, way = 0.02, nose = 0.1, half = 0.2;
  std::string urdf = contents(models + "scarab.urdf");
  const std::string asked = "max_torque=\"2.765\"";
  urdf.replace(urdf.find(asked), asked.size(), "max_torque=\"0.4\"");
  std::filesystem::copy_file(models + "hokuyo.stl", folder / "hokuyo.stl");
  folder.write("pusher.urdf", urdf);
  Started sim =
      run(crate("0", std::to_string(nose + half + way) + " 0 0") + "<robot name='b' model='pusher.urdf' at='0 0 0'/>",
          {}, {{"v", "9"}});
  run_for(sim, 30);  // they have met, and are far from the motors' fastest
  const double before = state(sim).twist.vx;
  run_for(sim, 30);
  const double acceleration = (state(sim).twist.vx - before) / 0.3;
  const double pull = 2 * torque / radius - mu * 2 * gravity, all = 8 + 2 + 2 * wheel_inertia / (radius * radius);
  const double shifted = mu * mu * (2 * acceleration + mu * 2 * gravity) / (1 - mu * mu);
  EXPECT_LT(std::abs(acceleration - pull / all), shifted / all + GetParam().force * pull / all);
  EXPECT_NEAR(state(sim, "b").twist.vx, state(sim).twist.vx, 1e-3);
  EXPECT_NEAR(state(sim).pose.x - state(sim, "b").pose.x, nose + half, 1e-3);
}

TEST_P(Pushed, GivesTheSameBitsForAnyWorkersRemadeAndRestored) {
  if (!GetParam().pushed) GTEST_SKIP() << "claims no pushing";
  const std::string robots =
      crate("0.4", "0.35 0.05 0") + "<robot name='b' at='0 0 0'/>" + "<robot name='c' model='crate' at='4 0 0'/>";
  const auto begun = [&](int workers) { return run(robots, {}, wild, workers); };
  expect_same_bits(begun, 60);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Pushed);
INSTANTIATE_TEST_SUITE_P(Plugins, Pushed, testing::ValuesIn(backends()), test_name);

}  // namespace
}  // namespace muster::test
