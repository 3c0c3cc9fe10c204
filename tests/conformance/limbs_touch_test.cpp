// Limbs that meet walls, the ground and other robots: requirements for any backend with limbs.
#include <muster/limbs.hpp>

#include "tests/conformance/physics_backends.hpp"
#include "text/number.hpp"

namespace muster::test {
namespace {

constexpr double mass = 0.5, length = 0.3, ball = 0.05, inertia = 1e-3;  // [kg], [m], [m], [kg m2] about the centre
constexpr double about_hinge = inertia + mass * length * length;
constexpr double mu = 0.3;  // the default between bodies

std::string number(double value) { return print_real(value); }

std::string inertial(const std::string& at, double kilograms, double moment) {
  const std::string i = number(moment);
  return "<inertial><origin xyz='" + at + "'/><mass value='" + number(kilograms) + "'/><inertia ixx='" + i +
         "' ixy='0' ixz='0' iyy='" + i + "' iyz='0' izz='" + i + "'/></inertial>";
}

std::string sphere(const std::string& at, double size) {
  return "<collision><origin xyz='" + at + "'/><geometry><sphere radius='" + number(size) +
         "'/></geometry></collision>";
}

// A ball on an arm about the y axis, on a body of a thousand tons whose feet are 2 cm under its frame. At 0 it is
// deflected by `angle` from straight down; the hinge is at `height` above the feet.
std::string arm(double height, double angle, const std::string& more = {}) {
  std::string text = "<robot name='arm'><link name='body'>" + inertial("0 0 0.2", 1e6, 1e6);
  for (const std::string foot : {"3 3", "3 -3", "-3 3", "-3 -3"}) text += sphere(foot + " 0.03", 0.05);
  const std::string end = number(-length * std::sin(angle)) + " 0 " + number(-length * std::cos(angle));
  text += "</link><link name='arm'>" + inertial(end, mass, inertia) + sphere(end, ball) + "</link>";
  return text + "<joint name='hinge' type='continuous'><parent link='body'/><child link='arm'/><origin xyz='0 0 " +
         number(height - 0.02) + "'/><axis xyz='0 -1 0'/></joint>" + more + "</robot>";
}

class LimbsTouch : public EachBackend {
 protected:
  // An arm and its surroundings, in ticks of 2 ms.
  Started swinging(double height, double angle, const std::string& around, const Attributes& more = {},
                   const std::string& also = {}) const {
    folder.write("arm.urdf", arm(height, angle, also));
    return started(GetParam(), around + "<robot name='arm' model='arm.urdf' at='0 0 0.02'/>", {}, {}, 0.002, 1, more);
  }
  static double angle_of(const Simulation& sim) { return row<Limbs>(sim, "robot/arm/limbs").limb[0].angle; }
};

// From 1 rad it falls until its ball touches, and stays.
TEST_P(LimbsTouch, AnArmComesToLieOnTheGround) {
  if (!GetParam().limbs) GTEST_SKIP() << "claims no limbs";
  const double height = 0.3, expected = std::acos((height - ball) / length);
  Started sim = swinging(height, 1, "");
  run_for(sim, 1000);
  EXPECT_NEAR(1 - angle_of(sim), expected, 2e-3);
  EXPECT_NEAR(row<Limbs>(sim, "robot/arm/limbs").limb[0].rate, 0, std::max(1e-3, GetParam().rest));
}

const std::string wall =
    "<material name='brick' loss='5'/><wall name='w' from='0.15 -1' to='0.15 1' material='brick'/>";
const double at_wall = std::asin((0.1 - ball) / length);  // past straight down

TEST_P(LimbsTouch, AWallStopsAnArm) {
  if (!GetParam().limbs) GTEST_SKIP() << "claims no limbs";
  Started sim = swinging(1, 1, wall);
  double farthest = 0;
  for (int k = 0; k < 1000; ++k) {
    sim.step();
    farthest = std::max(farthest, angle_of(sim) - 1);
  }
  EXPECT_NEAR(farthest, at_wall, 2e-3);
}

// With half of its rate it has a quarter of its energy before the wall.
TEST_P(LimbsTouch, AnArmBouncesOffAWall) {
  if (!GetParam().limbs || !GetParam().bouncing) GTEST_SKIP() << "claims no limbs or no bouncing";
  Started sim = swinging(1, 1, wall, GetParam().smooth, "<muster restitution='0.5'/>");
  while (angle_of(sim) - 1 < 0.9 * at_wall && sim.time() < 2) sim.step();
  double back = 0;
  for (int k = 0; k < 300; ++k) {
    sim.step();
    back = std::max(back, 1 - angle_of(sim));
  }
  const double met = std::cos(at_wall) - std::cos(1), expected = std::acos(std::cos(at_wall) - met / 4);
  EXPECT_NEAR(back, expected, GetParam().apex * expected);
}

// At its lowest point it meets a crate at rest. Without bounce or friction the moment of momentum about the hinge is
// conserved, of the arm before and of both after.
TEST_P(LimbsTouch, AnArmGivesACrateItsMomentum) {
  if (!GetParam().limbs) GTEST_SKIP() << "claims no limbs";
  const double height = length + 0.125, amplitude = 1.2, crate = 2;
  Started sim = swinging(height, amplitude, "<robot name='crate' model='crate' at='" + number(ball + 0.2) + " 0 0'/>",
                         GetParam().smooth);
  run_for(sim, 300);
  const double rate = std::sqrt(2 * mass * gravity * length * (1 - std::cos(amplitude)) / about_hinge);
  const double expected = about_hinge * rate * length / (about_hinge + crate * length * length);
  const double parting = GetParam().parting * about_hinge / (about_hinge + crate * length * length);
  EXPECT_NEAR(state(sim, "crate").twist.vx, expected, GetParam().force * expected + parting);
}

// A sled on one foot behind a Scarab: its hinge carries the rest of its weight.
TEST_P(LimbsTouch, ASledIsDraggedAlong) {
  if (!GetParam().limbs) GTEST_SKIP() << "claims no limbs";
  const double torque = 0.2, wheel_inertia = 0.00025;
  const double height = 0.1, back = 0.3, centre = 0.2, kilograms = 1;  // of the hinge; of foot and mass behind it
  std::string urdf = contents(models + "scarab.urdf");
  const std::string asked = "max_torque=\"2.765\"";
  urdf.replace(urdf.find(asked), asked.size(), "max_torque=\"0.2\"");
  urdf.insert(urdf.find("<muster>"),
              "<link name='sled'>" + inertial(number(-centre) + " 0 0", kilograms, 0.01) +
                  sphere(number(-back) + " 0 " + number(0.02 - height), 0.02) +
                  "</link><joint name='hitch' type='continuous'><parent link='base'/><child link='sled'/><origin xyz='"
                  "-0.12 0 " +
                  number(height) + "'/><axis xyz='0 1 0'/></joint>");
  std::filesystem::copy_file(models + "hokuyo.stl", folder / "hokuyo.stl");
  folder.write("towing.urdf", urdf);
  Started sim = run("<robot name='a' model='towing.urdf' at='0 0 0'/>", {}, {{"v", "9"}});
  run_for(sim, 30);
  const double before = state(sim).twist.vx;
  run_for(sim, 40);
  const double shifted = GetParam().load_transfer ? mu * height : 0;
  const double carried = kilograms * gravity * centre / (back + shifted);
  const double expected =
      (2 * torque / radius - mu * carried) / (8 + kilograms + 2 * wheel_inertia / (radius * radius));
  EXPECT_NEAR((state(sim).twist.vx - before) / 0.4, expected, GetParam().force * expected);
  EXPECT_NEAR(row<Limbs>(sim, "robot/a/limbs").limb[0].angle, 0, 2e-3);
}

TEST_P(LimbsTouch, GiveTheSameBitsForAnyWorkersRemadeAndRestored) {
  if (!GetParam().limbs) GTEST_SKIP() << "claims no limbs";
  const auto begun = [&](int workers) {
    folder.write("arm.urdf", arm(0.36, 1.2));
    return started(GetParam(),
                   "<robot name='arm' model='arm.urdf' at='0 0 0.02'/><robot name='crate' model='crate' at='0.2 0.05 "
                   "0' heading='0.3'/><robot name='other' model='crate' at='9 0 0'/>",
                   {}, {}, 0.01, workers);
  };
  expect_same_bits(begun, 60);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(LimbsTouch);
INSTANTIATE_TEST_SUITE_P(Plugins, LimbsTouch, testing::ValuesIn(backends()), test_name);

}  // namespace
}  // namespace muster::test
