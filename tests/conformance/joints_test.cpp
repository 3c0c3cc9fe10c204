// Bodies on joints that turn: requirements for any backend with such joints.
#include <muster/limbs.hpp>

#include "tests/conformance/physics_backends.hpp"
#include "text/number.hpp"

namespace muster::test {
namespace {

constexpr double mass = 0.1, arm = 0.08, inertia = 1e-4, own_radius = 0.1;  // [kg], [m], [kg m2] about the centre, [m]

// A body of a thousand tons on four smooth feet, 2 cm under its frame, so that nothing else of it touches the ground;
// its limbs shake it by a ten-millionth of their own motion.
std::string body() {
  std::string text =
      "<link name='body'><inertial><origin xyz='0 0 0.2'/><mass value='1e6'/>"
      "<inertia ixx='1e6' ixy='0' ixz='0' iyy='1e6' iyz='0' izz='1e6'/></inertial>";
  for (const std::string foot : {"1 1", "1 -1", "-1 1", "-1 -1"}) {
    text += "<collision><origin xyz='" + foot + " 0.03'/><geometry><sphere radius='0.05'/></geometry></collision>";
  }
  return text + "</link>";
}

// A pendulum on a joint at `place`, its centre of mass deflected by `angle` from straight down at the joint's position
// 0.
std::string pendulum(const std::string& name, const std::string& place, double angle,
                     const std::string& type = "continuous") {
  const auto number = [](double value) { return print_real(value); };
  const std::string moment = number(inertia);
  return "<link name='" + name + "'><inertial><origin xyz='" + number(arm * std::sin(angle)) + " 0 " +
         number(-arm * std::cos(angle)) + "'/><mass value='" + number(mass) + "'/><inertia ixx='" + moment +
         "' ixy='0' ixz='0' iyy='" + moment + "' iyz='0' izz='" + moment + "'/></inertial></link><joint name='" + name +
         "_joint' type='" + type + "'><parent link='body'/><child link='" + name + "'/><origin xyz='" + place +
         "'/><axis xyz='0 1 0'/></joint>";
}

// A joint's motor holds with almost no torque.
const std::string no_torque = " max_torque='1e-9' max_speed='100' friction='0.8' ";

// Two wheels without balance, clear of the ground.
std::string on_axles(const std::vector<double>& angles) {
  return "<robot name='axles'>" + body() + pendulum("left", "0 0.1 0.3", angles[0]) +
         pendulum("right", "0 -0.1 0.3", angles[1]) +
         "<muster><differential left='left_joint' right='right_joint' wheel_radius='0.05' wheel_base='0.2'" +
         no_torque + "/></muster></robot>";
}

// Six legs, which reach down to the frame's own ground but not to the feet's.
std::string on_hips(const std::vector<double>& angles) {
  std::string links = body(), legs;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string name = "leg" + std::to_string(i), x = std::to_string(static_cast<int>(i / 2) - 1);
    links += pendulum(name, x + (i % 2 ? " -1 " : " 1 ") + std::to_string(2 * own_radius), angles[i]);
    legs += "<leg joint='" + name + "_joint' tripod='" + ((i / 2 + i) % 2 ? "2" : "1") + "'/>";
  }
  return "<robot name='hips'>" + links + "<muster><legs radius='" + std::to_string(own_radius) +
         "' position_gain='1e-9' rate_gain='1e-9'" + no_torque + ">" + legs + "</legs></muster></robot>";
}

// Limbs on a robot with free wheels: a ball with a pendulum each of the angles, or on hinges where so named.
std::string on_limbs(const std::vector<std::pair<std::string, double>>& angles) {
  std::string links = body() + pendulum("left", "0 0.1 0.3", 0) + pendulum("right", "0 -0.1 0.3", 0), balls;
  for (const std::string wheel : {"left", "right"}) {  // balanced
    const std::string offset = "<origin xyz='0 0 " + print_real(-arm) + "'/>";
    const auto at = links.find(offset, links.find("name='" + wheel + "'"));
    links.erase(at, offset.size());
  }
  for (const auto& [type, angle] : angles) {
    const std::string name = type + std::to_string(balls.size());
    links += pendulum(name, "0.5 0 1", angle, type);
    if (type == "floating") balls += "<ball joint='" + name + "_joint'/>";
  }
  return "<robot name='limbs'>" + links +
         "<muster><differential left='left_joint' right='right_joint' wheel_radius='0.05' wheel_base='0.2'" +
         no_torque + "/>" + balls + "</muster></robot>";
}

// By the complete elliptic integral of the first kind.
double period(double amplitude) {
  return 4 * std::sqrt((inertia + mass * arm * arm) / (mass * gravity * arm)) *
         std::comp_ellint_1(std::sin(amplitude / 2));
}

class OnJoints : public EachBackend {
 protected:
  // Joints turn from 0 past the amplitude, at which the pendulum is lowest, to twice of it and back.
  void expect_periods(Started& sim, double dt, const std::vector<double>& amplitudes,
                      const std::function<std::vector<double>()>& angles) const {
    std::vector<std::vector<double>> lowest(amplitudes.size());
    std::vector<double> last = angles(), farthest(amplitudes.size());
    for (int tick = 0; tick < 2000; ++tick) {
      sim.step();
      const std::vector<double> now = angles();
      for (std::size_t i = 0; i < now.size(); ++i) {
        const double before = last[i] - amplitudes[i], after = now[i] - amplitudes[i];
        if (before < 0 && after >= 0) lowest[i].push_back(sim.time() - dt * after / (after - before));
        farthest[i] = std::max(farthest[i], now[i]);
      }
      last = now;
    }
    for (std::size_t i = 0; i < amplitudes.size(); ++i) {
      ASSERT_GT(lowest[i].size(), 2u) << amplitudes[i];
      const double swings = static_cast<double>(lowest[i].size() - 1);
      const double expected = period(amplitudes[i]);
      EXPECT_NEAR((lowest[i].back() - lowest[i].front()) / swings, expected, GetParam().swing * expected)
          << amplitudes[i];
      EXPECT_NEAR(farthest[i], 2 * amplitudes[i], 2e-3) << amplitudes[i];  // the body settles by 0.1 mm first
    }
  }
};

TEST_P(OnJoints, PendulumsTakeTheirPeriod) {
  if (GetParam().pendulum.empty()) GTEST_SKIP() << "claims no pendulum";
  const bool hips = GetParam().pendulum == "hip";
  const std::vector<double> amplitudes = hips ? std::vector{0.1, 0.6, 1.2, 1.8, 2.4, 3.0} : std::vector{0.6, 2.4};
  folder.write("pendulums.urdf", hips ? on_hips(amplitudes) : on_axles(amplitudes));
  const double dt = 0.002;
  Started sim =
      started(GetParam(), "<robot name='a' model='pendulums.urdf' at='0 0 0.02'/><conformance.slack/>", {}, {}, dt);
  expect_periods(sim, dt, amplitudes, [&] {
    if (!hips) return std::vector{row<Wheels>(sim, "robot/a/wheels").left, row<Wheels>(sim, "robot/a/wheels").right};
    const auto legs = row<Legs>(sim, "robot/a/legs");
    return std::vector(std::begin(legs.angle), std::end(legs.angle));
  });
}

const std::string with_limbs = "<robot name='a' model='limbs.urdf' at='0 0 0.02'/>";

TEST_P(OnJoints, LimbsTakeTheirPeriodOrAreRefusedWithTheList) {
  const std::vector<double> amplitudes = {0.6, 1.2};
  folder.write("limbs.urdf", on_limbs({{"continuous", amplitudes[0]}, {"floating", amplitudes[1]}}));
  const double dt = 0.002;
  if (!GetParam().limbs) {
    try {
      started(GetParam(), with_limbs, {}, {}, dt);
      FAIL() << "nothing was thrown";
    } catch (const Error& error) {
      EXPECT_EQ(error.exit(), Exit::invalid_input);
      EXPECT_THAT(error.what(), testing::HasSubstr("it lacks what the world's robots need: robot 'a' (model 'limbs') "
                                                   "needs joint 'continuous0_joint' (continuous) without a motor, "
                                                   "joint 'floating0_joint' (ball) without a motor"));
    }
    return;
  }
  Started sim = started(GetParam(), with_limbs, {}, {}, dt);
  expect_periods(sim, dt, amplitudes, [&] {
    const auto limbs = row<Limbs>(sim, "robot/a/limbs");
    EXPECT_NEAR(std::hypot(limbs.limb[1].qx, limbs.limb[1].qz), 0, 1e-6);
    return std::vector{limbs.limb[0].angle, 2 * std::atan2(limbs.limb[1].qy, limbs.limb[1].qw)};
  });
}

// In a circle at a constant deflection: it only turns about the vertical.
TEST_P(OnJoints, ALimbOnABallGoesInACircle) {
  if (!GetParam().limbs) GTEST_SKIP() << "claims no limbs";
  constexpr double pi = 3.14159265358979, turns = 10, dt = 0.002;
  for (const double deflection : {0.1, 0.9}) {
    const double rate = std::sqrt(gravity / (arm * std::cos(deflection)));
    folder.write("limbs.urdf", on_limbs({{"floating", deflection}}));
    Started sim = started(GetParam(), with_limbs, {{"cone", print_real(rate)}}, {}, dt);
    const double start = sim.time();
    while (sim.time() < start + 2 * pi * turns / rate) sim.step();
    const Limb limb = row<Limbs>(sim, "robot/a/limbs").limb[0];
    const Eigen::Quaterniond turned(limb.qw, limb.qx, limb.qy, limb.qz),
        expected(Eigen::AngleAxisd(rate * (sim.time() - start), Eigen::Vector3d::UnitZ()));
    EXPECT_LT(turned.angularDistance(expected), GetParam().swing * 2 * pi * turns) << deflection;
  }
}

// Carriages of 2 kg on upright rails, with stops 0.1 m from their start: one without friction, one that it brakes, one
// that it holds; and a rail with a damper, whose carriage reaches a steady speed.
TEST_P(OnJoints, LimbsStopAtLimitsStickByFrictionAndAreDamped) {
  if (!GetParam().limbs) GTEST_SKIP() << "claims no limbs";
  constexpr double kilograms = 2, weight = kilograms * gravity, damper = 80;
  std::string links = body();
  const auto carriage = [&](const std::string& name, const std::string& dynamics, const std::string& stop) {
    links += "<link name='" + name + "'><inertial><mass value='2'/><inertia ixx='0.01' ixy='0' ixz='0' iyy='0.01' " +
             "iyz='0' izz='0.01'/></inertial></link><joint name='" + name +
             "_joint' type='prismatic'><parent link='body'/><child link='" + name +
             "'/><origin xyz='0 0 1'/><axis xyz='0 0 1'/><limit lower='-" + stop + "' upper='" + stop +
             "' effort='1e9' velocity='1e9'/><dynamics " + dynamics + "/></joint>";
  };
  carriage("free", "friction='0'", "0.1"), carriage("braked", "friction='15'", "0.1"),
      carriage("held", "friction='25'", "0.1");
  carriage("damped", "damping='" + print_real(damper) + "'", "9");
  folder.write("rails.urdf", "<robot name='rails'>" + links + "</robot>");
  Started sim = run("<robot name='a' model='rails.urdf' at='0 0 0.02'/>", {}, {});
  const auto limb = [&](int i) { return row<Limbs>(sim, "robot/a/limbs").limb[i]; };
  run_for(sim, 10);
  EXPECT_NEAR(limb(0).way, -gravity / 2 * 0.01, 1e-3 * 0.05 + GetParam().fall);
  EXPECT_NEAR(limb(1).way, -(gravity - 15 / kilograms) / 2 * 0.01, 1e-3 * 0.05 + GetParam().fall);
  run_for(sim, 90);
  EXPECT_NEAR(limb(0).way, -0.1, 1e-3);
  EXPECT_NEAR(limb(1).way, -0.1, 1e-3);
  EXPECT_NEAR(limb(2).way, 0, 1e-5);
  EXPECT_NEAR(limb(3).speed, -weight / damper, 1e-4);
}

// A pendulum that swings by 0.05 rad loses its amplitude to a damper.
TEST_P(OnJoints, DampedLimbsLoseWhatTheyShould) {
  if (!GetParam().limbs) GTEST_SKIP() << "claims no limbs";
  const double about = inertia + mass * arm * arm, damper = 1e-3, amplitude = 0.05, dt = 0.002;
  for (const std::string type : {"continuous", "floating"}) {
    std::string link = pendulum("bob", "0.5 0 1", amplitude, type);
    link.insert(link.find("</joint>"), "<dynamics damping='" + print_real(damper) + "'/>");
    const std::string ball = type == "floating" ? "<muster><ball joint='bob_joint'/></muster>" : "";
    folder.write("damped.urdf", "<robot name='damped'>" + body() + link + ball + "</robot>");
    Started sim = started(GetParam(), "<robot name='a' model='damped.urdf' at='0 0 0.02'/>", {}, {}, dt);
    const double start = sim.time(), decay = damper / (2 * about);
    const double rate = std::sqrt(mass * gravity * arm / about - decay * decay);
    double off = 0;
    for (int k = 0; k < 1000; ++k) {
      sim.step();
      const double t = sim.time() - start;
      const double expected =
          -amplitude * std::exp(-decay * t) * (std::cos(rate * t) + decay / rate * std::sin(rate * t));
      const Limb limb = row<Limbs>(sim, "robot/a/limbs").limb[0];
      const double angle = type == "floating" ? 2 * std::atan2(limb.qy, limb.qw) : limb.angle;
      off = std::max(off, std::abs(angle - amplitude - expected));
    }
    EXPECT_LT(off, 10 * GetParam().swing * amplitude) << type;
    EXPECT_GT(decay, 0.5);
  }
}

TEST_P(OnJoints, LimbsGiveTheSameBitsForAnyWorkersRemadeAndRestored) {
  if (!GetParam().limbs) GTEST_SKIP() << "claims no limbs";
  folder.write("limbs.urdf", on_limbs({{"continuous", 0.6}, {"floating", 1.2}}));
  const std::string robots = with_limbs + "<robot name='b' model='limbs.urdf' at='20 0 0.02'/>";
  const auto begun = [&](int workers) { return started(GetParam(), robots, {{"cone", "2"}}, {}, 0.01, workers); };
  expect_same_bits(begun, 30);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(OnJoints);
INSTANTIATE_TEST_SUITE_P(Plugins, OnJoints, testing::ValuesIn(backends()), test_name);

}  // namespace
}  // namespace muster::test
