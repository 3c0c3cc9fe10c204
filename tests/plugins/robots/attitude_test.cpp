// robots.attitude on the true motion of a quadrotor, against closed forms of its linear loop: gains are angular
// accelerations, so that with rotors without lag roll and pitch are a second-order system.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "robot_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

using Changes = std::vector<std::pair<std::string, std::string>>;  // attributes of <quadrotor>

std::string hummingbird(const Folder& folder, const Changes& changes) {
  std::string urdf = contents(MUSTER_SOURCE_DIR "/plugins/robots/models/hummingbird.urdf");
  for (const auto& [attribute, value] : changes) {
    const auto at = urdf.find(attribute + "=\"", urdf.find("<quadrotor")) + attribute.size() + 2;
    urdf.replace(at, urdf.find('"', at) - at, value);
  }
  return folder.write("bird.urdf", urdf).string();
}

const Changes no_integral = {{"attitude_i", "0"}, {"drag_factor", "0"}};  // lateral air flow turns the body, too
Changes lagging(const std::string& lag, Changes more = no_integral) {
  more.push_back({"lag_up", lag});
  more.push_back({"lag_down", lag});
  return more;
}

double roll_of(const Pose& p) {
  return std::atan2(2 * (p.qw * p.qx + p.qy * p.qz), 1 - 2 * (p.qx * p.qx + p.qy * p.qy));
}
double pitch_of(const Pose& p) { return std::asin(2 * (p.qw * p.qy - p.qz * p.qx)); }

constexpr double weight = 0.716 * 9.81, step_at = 0.5;  // [N], [s]

Simulation commanded(const Folder& folder, const Changes& changes, const std::string& step, const std::string& dt) {
  const std::string lift = std::to_string(weight);
  return world_of(folder,
                  "<robot name=\"r\" model=\"" + hummingbird(folder, changes) +
                      "\" at=\"0 0 50\"/><physics.simbody/><robots.attitude/>"
                      "<control.attitude robot=\"r\" file=\"steps.csv\"/>",
                  {{"steps.csv", "t[s],cmd_thrust[N],cmd_roll[rad],cmd_pitch[rad],cmd_yaw_rate[rad/s]\n0," + lift +
                                     ",0,0,0\n0.5," + lift + "," + step + "\n"}},
                  "dt=\"" + dt + "\" until=\"9\" seed=\"1\"");
}

struct Sample {
  double t, y;  // since the step [s]; of the step
};

// Response to a step of `size`.
std::vector<Sample> response(const Changes& changes, const std::string& step, double size,
                             const std::function<double(const Simulation&)>& measured, const std::string& dt = "0.001",
                             double until = 1.5) {
  const Folder folder;
  Simulation run = commanded(folder, changes, step, dt);
  std::vector<Sample> result;
  while (run.time() < step_at + until) {
    run.step();
    if (run.time() >= step_at) result.push_back({run.time() - step_at, measured(run) / size});
  }
  return result;
}

double roll(const Simulation& run) { return roll_of(row<Pose>(run, "robot/r/pose")); }
double pitch(const Simulation& run) { return pitch_of(row<Pose>(run, "robot/r/pose")); }

double largest_difference(const std::vector<Sample>& samples, const std::function<double(double)>& truth) {
  double most = 0;
  for (const Sample& s : samples) most = std::max(most, std::abs(s.y - truth(s.t)));
  return most;
}

double first_time_above(const std::vector<Sample>& samples, double level) {
  const auto after = std::find_if(samples.begin(), samples.end(), [&](const Sample& s) { return s.y >= level; });
  if (after == samples.end() || after == samples.begin()) return -1;
  const auto before = after - 1;
  return before->t + (level - before->y) / (after->y - before->y) * (after->t - before->t);
}
// From 10 to 90 % of the step.
double rise(const std::vector<Sample>& samples) {
  return first_time_above(samples, 0.9) - first_time_above(samples, 0.1);
}
double overshoot(const std::vector<Sample>& samples) {
  return std::max_element(samples.begin(), samples.end(), [](auto& a, auto& b) { return a.y < b.y; })->y - 1;
}

// 14 rad/s and a damping ratio of 0.8: attitude_p = 196, attitude_d = 22.4.
double second_order(double t) {
  const double omega = 14, zeta = 0.8, damped = omega * std::sqrt(1 - zeta * zeta);
  return 1 - std::exp(-zeta * omega * t) * (std::cos(damped * t) + zeta * omega / damped * std::sin(damped * t));
}
std::vector<Sample> ideal() {
  std::vector<Sample> samples;
  for (int k = 0; k < 1500; ++k) samples.push_back({k * 1e-3, second_order(k * 1e-3)});
  return samples;
}

TEST(Attitude, WithRotorsThatFollowAtOnceStepsAreTheSecondOrderIdeal) {
  EXPECT_NEAR(overshoot(ideal()), std::exp(-M_PI * 0.8 / 0.6), 1e-4);
  for (const auto& [step, axis] : {std::pair("0.2,0,0", &roll), std::pair("0,0.2,0", &pitch)}) {
    const auto samples = response(lagging("0.0001"), step, 0.2, axis, "0.0005");
    EXPECT_LT(largest_difference(samples, second_order), 0.01) << step;
    EXPECT_NEAR(rise(samples), rise(ideal()), 0.01 * rise(ideal())) << step;
    EXPECT_NEAR(overshoot(samples), overshoot(ideal()), 0.002) << step;
  }
}

// lag s^3 + s^2 + d s + p with all three poles at -20 / s. A small step: thrust is the square of the lagging rate.
TEST(Attitude, WithRotorsThatLagStepsAreOfThirdOrder) {
  const auto samples =
      response(lagging("0.016666666667",
                       {{"attitude_i", "0"}, {"drag_factor", "0"}, {"attitude_p", "133.333333"}, {"attitude_d", "20"}}),
               "0.01,0,0", 0.01, roll, "0.0005");
  const auto triple = [](double t) { return 1 - std::exp(-20 * t) * (1 + 20 * t + 200 * t * t); };
  EXPECT_LT(largest_difference(samples, triple), 0.01);
}

// The unmodified model: rotors' lags reduce the damping, so that it rises in 0.14 s instead of 0.18.
TEST(Attitude, HummingbirdIsNearTheIdeal) {
  const auto at_1_khz = response({}, "0.2,0,0", 0.2, roll), at_100_hz = response({}, "0.2,0,0", 0.2, roll, "0.01");
  for (const auto* samples : {&at_1_khz, &at_100_hz}) {
    EXPECT_LT(largest_difference(*samples, second_order), 0.12);
    EXPECT_NEAR(rise(*samples), 0.135, 0.01);
    EXPECT_LT(overshoot(*samples), 0.02);
    EXPECT_NEAR(samples->back().y, 1, 0.01);
  }
}

// A PI on a rate that follows its acceleration: (4 s + 4) / (s + 2)^2.
TEST(Attitude, TurnRateIsASecondOrderSystemToo) {
  const auto samples = response(
      lagging("0.001", {{"drag_factor", "0"}, {"attitude_i", "0"}}), "0,0,0.5", 0.5,
      [](const Simulation& run) { return row<Twist>(run, "robot/r/twist").wz; }, "0.001", 3);
  const auto law = [](double t) { return 1 - std::exp(-2 * t) * (1 - 2 * t); };
  EXPECT_LT(largest_difference(samples, law), 0.01);
}

TEST(Attitude, RollAndPitchAreOfTheHeadingThatItHas) {
  const Folder folder;
  Simulation run = commanded(folder, {}, "0.1,-0.2,1", "0.01");
  while (run.time() < 6) run.step();
  const Pose p = row<Pose>(run, "robot/r/pose");
  EXPECT_NEAR(roll_of(p), 0.1, 0.003);
  EXPECT_NEAR(pitch_of(p), -0.2, 0.003);
}

// Mass that is off by 5 mm: the integral removes the residual of the proportional part.
TEST(Attitude, TheIntegralLevelsAnUnevenBody) {
  std::vector<double> left;
  for (const std::string integral : {"0", "200"}) {
    const Folder folder;
    std::string urdf = contents(hummingbird(folder, {{"attitude_i", integral}}));
    const std::string body = "<mass value=\"0.68\"/>";
    urdf.replace(urdf.find(body), body.size(), "<origin xyz=\"0 0.005 0\"/>" + body);
    Simulation run = commanded(folder, {{"attitude_i", integral}}, "0,0,0", "0.01");
    folder.write("bird.urdf", urdf);
    Simulation uneven(read_world(folder / "world.xml", standard()), standard(), options());
    while (uneven.time() < 6) uneven.step();
    left.push_back(std::abs(roll(uneven)));
  }
  const double inertia = 0.0075, torque = 0.68 * 9.81 * 0.005;
  EXPECT_NEAR(left[0], torque / (inertia * 196), 0.1 * left[0]);
  EXPECT_LT(left[1], 0.05 * left[0]);
}

TEST(Attitude, NobodysRobotAndNoThrustLeaveRotorsAtRest) {
  const Folder folder;
  Simulation run = world_of(folder,
                            "<robot name=\"r\" model=\"hummingbird\" at=\"0 0 0.06\"/><robot name=\"s\" at=\"3 0 0\"/>"
                            "<physics.simbody/><robots.attitude/>");
  for (int k = 0; k < 20; ++k) run.step();
  for (const char* robot : {"r", "s"}) {
    const auto asked = row<RotorDrive>(run, std::string("robot/") + robot + "/rotor_drive");
    EXPECT_EQ(asked.front + asked.left + asked.back + asked.right, 0) << robot;
  }
}

TEST(Attitude, IntegralsDoNotWindUpWhileRotorsStand) {
  const Folder folder;
  commanded(folder, {}, "0,0,0", "0.01");
  folder.write("steps.csv", "t[s],cmd_thrust[N],cmd_roll[rad],cmd_pitch[rad],cmd_yaw_rate[rad/s]\n0,0,0.2,0,1\n");
  Simulation run(read_world(folder / "world.xml", standard()), standard(), options());
  for (int k = 0; k < 20; ++k) run.step();
  for (unsigned c = 0; c < 3; ++c) EXPECT_EQ(run.table("robot/r/attitude_integral").at(0, c), 0);
}

TEST(Attitude, AFileOfSeveralRobotsServesEach) {
  const Folder folder;
  Simulation run = world_of(folder,
                            "<robot name=\"a\" model=\"hummingbird\" at=\"0 0 9\"/><robot name=\"b\" "
                            "model=\"hummingbird\" at=\"3 0 9\"/><physics.simbody/><robots.attitude/>"
                            "<control.attitude name=\"fly_a\" robot=\"a\" file=\"both.csv\"/>"
                            "<control.attitude name=\"fly_b\" robot=\"b\" file=\"both.csv\"/>",
                            {{"both.csv",
                              "t[s],robot,x[m],cmd_thrust[N],cmd_roll[rad],cmd_pitch[rad],cmd_yaw_rate[rad/s]\n"
                              "0,a,1,5,0,0,0\n0,b,1,6,0,0,0\n0.2,a,1,7,0,0,0\n0.3,b,1,8,0,0,0\n"}});
  const auto thrust = [&](const std::string& robot) {
    return row<AttitudeThrust>(run, "robot/" + robot + "/attitude_thrust").thrust;
  };
  for (int k = 0; k < 5; ++k) run.step();  // of 0.05 s: this one begins at 0.2 s
  EXPECT_EQ(thrust("a"), 7);
  EXPECT_EQ(thrust("b"), 6);
  for (int k = 0; k < 2; ++k) run.step();
  EXPECT_EQ(thrust("b"), 8);
}

TEST(Attitude, CommandsThatTheRunNeverComesToAreWarnedOf) {
  const Folder folder;
  commanded(folder, {}, "0,0,0", "0.01");
  folder.write(
      "steps.csv",
      "t[s],cmd_thrust[N],cmd_roll[rad],cmd_pitch[rad],cmd_yaw_rate[rad/s]\n1717401234,0,0,0,0\n1717401235,0,0,0,0\n");
  Simulation run(read_world(folder / "world.xml", standard()), standard(), options());
  run.step();
  run.step();
  std::vector<std::string> said;
  for (const auto& event : run.events())
    if (const auto at = event.message.find("steps.csv:2:1: "); at != std::string::npos)
      said.push_back(event.message.substr(at));
  ASSERT_EQ(said.size(), 1u);
  EXPECT_THAT(said[0], testing::HasSubstr(" are from t = 1717401234 to 1717401235 s, and the run is from 0 to "));
  EXPECT_THAT(said[0],
              testing::EndsWith(" s, so that none is ever given; are these seconds since 1970? expected seconds of "
                                "the run: the time less that of its start"));
}

TEST(Attitude, CommandsMustRiseInTime) {
  const Folder folder;
  commanded(folder, {}, "0,0,0", "0.01");
  folder.write("steps.csv",
               "t[s],cmd_thrust[N],cmd_roll[rad],cmd_pitch[rad],cmd_yaw_rate[rad/s]\n1,0,0,0,0\n1,0,0,0,0\n");
  Simulation run(read_world(folder / "world.xml", standard()), standard(), options());
  try {
    run.step();
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit(), Exit::invalid_input);
    EXPECT_THAT(error.what(), testing::HasSubstr("steps.csv:3:1: t does not rise"));
  }
}

TEST(Attitude, AFileWithoutCommandsForTheRobotIsRefused) {
  const Folder folder;
  commanded(folder, {}, "0,0,0", "0.01");
  for (const std::string other : {"", "1,b,0,0,0,0\n"}) {
    folder.write("steps.csv", "t[s],robot,cmd_thrust[N],cmd_roll[rad],cmd_pitch[rad],cmd_yaw_rate[rad/s]\n" + other);
    try {
      std::string world = folder.read("world.xml");
      if (!other.empty())
        world.insert(world.find("<physics"), "<robot name=\"b\" model=\"hummingbird\" at=\"5 5 9\"/>");
      Simulation run = load(folder.write("two.xml", world));
      run.step();
      FAIL() << "nothing was thrown";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("the file has no commands for it"));
    }
  }
}

// As from an autopilot that counts thrust from 0 to 1.
TEST(AttitudeTable, ThrustThatNeverLiftsIsWarnedOf) {
  const auto warned = [](const std::string& thrust, const std::string& every = "1") {
    const Folder folder;
    Simulation run = world_of(folder,
                              "<robot name=\"r\" model=\"hummingbird\" at=\"0 0 2\"/><physics.simbody/>"
                              "<robots.attitude/><control.attitude robot=\"r\" file=\"s.csv\" every=\"" +
                                  every + "\"/>",
                              {{"s.csv", "t[s],cmd_thrust[N],cmd_roll[rad],cmd_pitch[rad],cmd_yaw_rate[rad/s]\n0," +
                                             thrust + ",0,0,0\n0.1,0.2,0,0,0\n"}});
    for (int k = 0; k < 4; ++k) run.step();
    for (const Event& event : run.events())
      if (event.message.find("cmd_thrust") != std::string::npos)
        return event.message.substr(event.message.rfind("s.csv"));
    return std::string();
  };
  EXPECT_EQ(
      warned("0.55"),
      "s.csv:2:3: cmd_thrust is at most 0.55 N, and hovering takes 7.02 N, so that robot 'r' never flies; expected "
      "newtons; is it a share of the largest thrust, from 0 to 1? multiply it by that");
  EXPECT_EQ(warned("5"),
            "s.csv:2:3: cmd_thrust is at most 5 N, and hovering takes 7.02 N, so that robot 'r' never flies; expected "
            "newtons");
  EXPECT_EQ(warned("5", "2"), warned("5"));
  EXPECT_EQ(warned("7.1"), "");
}

TEST(AttitudeTable, ARobotOnWheelsIsRefused) {
  const Folder folder;
  try {
    world_of(folder,
             "<robot name=\"r\" model=\"scarab\" at=\"0 0 0\"/><physics.simbody/>"
             "<control.attitude robot=\"r\" file=\"s.csv\"/>",
             {{"s.csv", "t[s],cmd_thrust[N],cmd_roll[rad],cmd_pitch[rad],cmd_yaw_rate[rad/s]\n0,1,0,0,0\n"}});
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("has no rotors (<muster>, <quadrotor>) and does not fly; expected "
                                                 "<control.recorded/>, which drives by a table of v and w"));
  }
}

TEST(Mocap, SeesThePoseAndAddsTheNoiseDeclared) {
  const Folder folder;
  const std::string still =
      "<robot name=\"r\" model=\"hummingbird\" at=\"1 2 0.06\" heading=\"0.7\"/><physics.simbody/>";
  Simulation plain = world_of(folder, still + "<robots.mocap/>");
  plain.step();
  const auto pose = row<Pose>(plain, "robot/r/pose");
  EXPECT_EQ(row<Position3d>(plain, "robot/r/position3d").y, pose.y);
  EXPECT_NEAR(row<Position3d>(plain, "robot/r/position3d").yaw, 0.7, 1e-9);
  Simulation noisy = world_of(folder, still + "<robots.mocap place=\"0.01\" angle=\"0.02\" speed=\"0.03\"/>", {},
                              "dt=\"0.05\" until=\"600\" seed=\"1\"");
  double places = 0, angles = 0, speeds = 0, product = 0;
  constexpr int draws = 4000;
  for (int i = 0; i < draws; ++i) {
    noisy.step();
    const auto seen = row<Position3d>(noisy, "robot/r/position3d");
    const auto at = row<Pose>(noisy, "robot/r/pose");
    const double x = (seen.x - at.x) / 0.01, angle = seen.roll / 0.02, v = seen.vz / 0.03;
    places += x * x, angles += angle * angle, speeds += v * v, product += x * angle;
  }
  const double sd = 5 * std::sqrt(2.0 * draws);
  for (const double squares : {places, angles, speeds}) EXPECT_NEAR(squares, draws, sd);
  EXPECT_NEAR(product, 0, sd);
}

}  // namespace
