// What hangs on a joint that turns: what any backend with such joints must keep.
#include "tests/conformance/physics_backends.hpp"
#include "text/number.hpp"

namespace muster::test {
namespace {

constexpr double mass = 0.1, arm = 0.08, inertia = 1e-4, own_radius = 0.1;  // [kg], [m], [kg m2] about the centre, [m]

// A body of a thousand tons on four smooth feet, 2 cm under its frame, so that nothing else of it touches the ground;
// what hangs on it shakes it by a ten-millionth of its own way.
std::string body() {
  std::string text =
      "<link name='body'><inertial><origin xyz='0 0 0.2'/><mass value='1e6'/>"
      "<inertia ixx='1e6' ixy='0' ixz='0' iyy='1e6' iyz='0' izz='1e6'/></inertial>";
  for (const std::string foot : {"1 1", "1 -1", "-1 1", "-1 -1"}) {
    text += "<collision><origin xyz='" + foot + " 0.03'/><geometry><sphere radius='0.05'/></geometry></collision>";
  }
  return text + "</link>";
}

// Hangs on a joint at `place`, its centre of mass deflected by `angle` from straight down where the joint stands at 0.
std::string pendulum(const std::string& name, const std::string& place, double angle) {
  const auto number = [](double value) { return print_real(value); };
  const std::string moment = number(inertia);
  return "<link name='" + name + "'><inertial><origin xyz='" + number(arm * std::sin(angle)) + " 0 " +
         number(-arm * std::cos(angle)) + "'/><mass value='" + number(mass) + "'/><inertia ixx='" + moment +
         "' ixy='0' ixz='0' iyy='" + moment + "' iyz='0' izz='" + moment + "'/></inertial></link><joint name='" + name +
         "_joint' type='continuous'><parent link='body'/><child link='" + name + "'/><origin xyz='" + place +
         "'/><axis xyz='0 1 0'/></joint>";
}

// A joint's motor holds against next to nothing.
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

// By the complete elliptic integral of the first kind.
double period(double amplitude) {
  return 4 * std::sqrt((inertia + mass * arm * arm) / (mass * gravity * arm)) *
         std::comp_ellint_1(std::sin(amplitude / 2));
}

class OnJoints : public EachBackend {};

TEST_P(OnJoints, PendulumsTakeTheirPeriod) {
  if (GetParam().pendulum.empty()) return;
  const bool hips = GetParam().pendulum == "hip";
  const std::vector<double> amplitudes = hips ? std::vector{0.1, 0.6, 1.2, 1.8, 2.4, 3.0} : std::vector{0.6, 2.4};
  folder.write("pendulums.urdf", hips ? on_hips(amplitudes) : on_axles(amplitudes));
  const double dt = 0.002;
  Started sim =
      started(GetParam(), "<robot name='a' model='pendulums.urdf' at='0 0 0.02'/><conformance.slack/>", {}, {}, dt);
  const auto angles = [&] {
    if (!hips) return std::vector{row<Wheels>(sim, "robot/a/wheels").left, row<Wheels>(sim, "robot/a/wheels").right};
    const auto legs = row<Legs>(sim, "robot/a/legs");
    return std::vector(std::begin(legs.angle), std::end(legs.angle));
  };
  // Joints turn from 0 past the amplitude, where what hangs on them is lowest, to twice of it and back.
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

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(OnJoints);
INSTANTIATE_TEST_SUITE_P(Plugins, OnJoints, testing::ValuesIn(backends()), test_name);

}  // namespace
}  // namespace muster::test
