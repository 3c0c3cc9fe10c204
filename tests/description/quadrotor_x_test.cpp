// Rotors in X, and at any other angle: sums over the rotors one by one, and the mixing in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "description/quadrotor.hpp"
#include "files.hpp"

namespace muster::description {
namespace {

using Eigen::Vector3d;

std::string text_of(const std::string& angle) {
  return "<robot name='x'><link name='a'><inertial><mass value='0.5'/><inertia ixx='0.01' ixy='0' ixz='0' iyy='0.01' "
         "iyz='0' izz='0.01'/></inertial></link><muster><quadrotor arm='0.2' height='0.03' " +
         angle +
         " thrust_factor='8e-6' torque_factor='1e-7' drag_factor='8e-5' max_speed='800' lag_up='0.02' lag_down='0.03' "
         "attitude_p='200' attitude_d='20' yaw_p='4'/></muster></robot>";
}

Quadrotor drive_of(double angle) {
  const Files files;
  return *read_robot(files.write("x.urdf", text_of("rotor_angle='" + std::to_string(angle) + "'"))).quadrotor;
}

const double eighth = M_PI / 4;

// Places of the rotors front, left, back, right, which turn clockwise and against it in turn.
Vector3d place(const Quadrotor& drive, std::size_t rotor) {
  const double angle = drive.rotor_angle + M_PI / 2 * static_cast<double>(rotor);
  return {drive.arm * std::cos(angle), drive.arm * std::sin(angle), drive.height};
}

TEST(RotorsInX, WrenchIsTheSumOverRotors) {
  for (const double declared : {0.0, 0.785398, -0.3, 2.0}) {
    const Quadrotor drive = drive_of(declared);
    EXPECT_EQ(drive.rotor_angle, declared);
    const RotorRates rates = {300, 450, 600, 200};
    const Vector3d v(1, -2, 3), w(0.5, -1.5, 2.5);
    Vector3d force(0, 0, 0), torque(0, 0, 0);
    for (std::size_t i = 0; i < 4; ++i) {
      Vector3d air = v + w.cross(place(drive, i));
      air.z() = 0;
      const Vector3d own =
          Vector3d(0, 0, drive.thrust_factor * rates[i] * rates[i]) - drive.drag_factor * rates[i] * air;
      force += own;
      torque += place(drive, i).cross(own) +
                Vector3d(0, 0, (i % 2 == 0 ? 1 : -1) * drive.torque_factor * rates[i] * rates[i]);
    }
    const Wrench sum = drive.wrench(rates, v, w);
    EXPECT_LT((sum.force - force).norm(), 1e-12) << declared;
    EXPECT_LT((sum.torque - torque).norm(), 1e-12) << declared;
  }
}

// Thrust of a rotor at (x, y): T / 4 + (y tau_x - x tau_y) / (2 arm2), and the share of the turn, against its own
// sense.
TEST(RotorsInX, RatesAreTheMixingInClosedForm) {
  for (const double declared : {0.785398, -0.3, 2.0}) {
    const Quadrotor drive = drive_of(declared);
    const Vector3d torque(0.1, -0.15, 0.02);
    const RotorRates rates = drive.rates_for(8, torque);
    for (std::size_t i = 0; i < 4; ++i) {
      const Vector3d at = place(drive, i);
      const double thrust = 8.0 / 4 + (at.y() * torque.x() - at.x() * torque.y()) / (2 * drive.arm * drive.arm) +
                            (i % 2 == 0 ? 1 : -1) * torque.z() * drive.thrust_factor / (4 * drive.torque_factor);
      EXPECT_NEAR(drive.thrust_factor * rates[i] * rates[i], thrust, 1e-12) << declared << ' ' << i;
    }
    const Wrench given = drive.wrench(rates, Vector3d::Zero(), Vector3d::Zero());
    EXPECT_NEAR(given.force.z(), 8, 1e-12);
    EXPECT_LT((given.torque - torque).norm(), 1e-12);
  }
}

// In X a roll is the work of both rotors of a side, alike, and hovering of all four.
TEST(RotorsInX, RollIsSharedByBothRotorsOfASide) {
  Quadrotor drive = drive_of(0);
  drive.rotor_angle = eighth;
  const RotorRates roll = drive.rates_for(8, {0.1, 0, 0}), pitch = drive.rates_for(8, {0, 0.1, 0}),
                   hover = drive.rates_for(8, Vector3d::Zero()), turn = drive.rates_for(8, {0, 0, 0.01});
  EXPECT_NEAR(roll[0], roll[1], 1e-9);  // in front and behind on the left
  EXPECT_NEAR(roll[2], roll[3], 1e-9);
  EXPECT_GT(roll[0], roll[2]);
  EXPECT_NEAR(pitch[0], pitch[3], 1e-9);  // in front: down
  EXPECT_NEAR(pitch[1], pitch[2], 1e-9);
  EXPECT_LT(pitch[0], pitch[1]);
  for (const double rate : hover) EXPECT_NEAR(rate, std::sqrt(2 / drive.thrust_factor), 1e-9);
  EXPECT_NEAR(turn[0], turn[2], 1e-9);
  EXPECT_GT(turn[0], turn[1]) << "those that turn clockwise speed up for a turn to the left";
}

TEST(RotorsInX, AnAngleThatIsNoneIsNamed) {
  const Files files;
  const std::string path = files.write("bad.urdf", text_of("rotor_angle='45'"));
  EXPECT_EQ(message_of([&] { read_robot(path); }),
            path +
                ":1: <quadrotor> rotor_angle=\"45\" is wrong; expected an angle from -pi to pi [rad]: 0 is a plus, "
                "0.7853981633974483 an X");
}

}  // namespace
}  // namespace muster::description
