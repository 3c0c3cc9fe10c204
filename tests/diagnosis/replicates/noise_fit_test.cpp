// Noise of a plugin as a fitted parameter: logs that the simulator drew are given back their noise, and what is no
// noise is told.
#include "diagnosis/replicates/noise_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drawn_log.hpp"
#include "text/error.hpp"

namespace muster::test {
namespace {

using diagnosis::NoiseFit;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::string fault(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

// A 95 % interval misses 5 or more of 24 once in 150 times.
TEST(NoiseFit, Row32IntervalsCoverTheTruth) {
  const Folder folder;
  int covered = 0, doubted = 0, full = 0;
  double sum = 0;
  constexpr int logs = 24;
  for (uint64_t i = 0; i < logs; ++i) {
    drive(folder, 100 + i, "0.02");
    const NoiseFit fit = fitted_odometry(folder);
    ASSERT_THAT(fit.parameters, SizeIs(1));
    EXPECT_EQ(fit.parameters[0].path, "robots.odometry/noise");
    covered += fit.parameters[0].lower95 <= 0.02 && 0.02 <= fit.parameters[0].upper95;
    doubted += !fit.doubts.empty();
    sum += fit.parameters[0].value * fit.parameters[0].value;
    EXPECT_THAT(fit.left_out, ElementsAre("across"));
    full += fit.parameters[0].freedom > 160;  // of 200: weights of 32 runs cost some
  }
  EXPECT_GE(covered, logs - 4);
  EXPECT_LE(doubted, 2);
  EXPECT_GE(full, logs - 6);  // the law is normal: tails take no freedom
  // Variances of 200 degrees of freedom: along and turn of 100 intervals.
  EXPECT_NEAR(sum / logs / 4e-4, 1, 4 * std::sqrt(2.0 / (200 * logs)));
}

TEST(NoiseFit, Row32NoiseOfActuationIsFittedFromCommandsAndPoses) {
  const Folder folder;
  const World world =
      world_in(folder, "drive.xml", "  <physics.planar/><robots.drive noise=\"0.4\"/><control.wander/>");
  Simulation commands(world, standard(), running());
  log_table(folder, commands, "command", "v[m/s],w[rad/s]", 1, "commands.csv");
  Simulation poses(world, standard(), running());
  log_table(folder, poses, "pose", "x[m],y[m],z[m],qw,qx,qy,qz", 5, "poses.csv");
  const World given =
      world_in(folder, "given.xml",
               "  <physics.planar/><robots.drive/><control.recorded robot=\"rover\" file=\"commands.csv\"/>");
  const NoiseFit fit = diagnosis::fit_noise(given, running(), "robot/*/pose", folder / "poses.csv", {});
  ASSERT_THAT(fit.parameters, SizeIs(1));
  EXPECT_EQ(fit.parameters[0].path, "robots.drive/noise");
  EXPECT_EQ(fit.parameters[0].unit, "rad/s");
  EXPECT_LE(fit.parameters[0].lower95, 0.4);
  EXPECT_GE(fit.parameters[0].upper95, 0.4);
  EXPECT_THAT(fit.doubts, IsEmpty());
}

// Values and not increments: a gyroscope and an accelerometer, that read nothing before the second tick.
TEST(NoiseFit, NoiseOfASensorIsThatOfItsValues) {
  const Folder folder;
  const std::string moved = "  <physics.planar/><robots.drive/><control.steady robot=\"rover\" v=\"0.2\" w=\"0.3\"/>";
  Simulation run(
      world_in(folder, "drive.xml", moved + "<sensors.imu name=\"imu\" accel_noise=\"0.02\" gyro_noise=\"0.003\"/>"),
      standard(), running());
  log_table(folder, run, "imu", "robot_t[s],fx[m/s2],fy[m/s2],fz[m/s2],wx[rad/s],wy[rad/s],wz[rad/s]", 1, "imu.csv");
  const NoiseFit fit =
      diagnosis::fit_noise(world_in(folder, "given.xml", moved + "<sensors.imu name=\"imu\"/>"), running(),
                           "robot/*/imu", folder / "imu.csv", {{}, {"robots.drive/noise", "imu/accel_walk"}});
  ASSERT_THAT(fit.parameters, SizeIs(3));
  EXPECT_EQ(fit.parameters[0].path, "imu/accel_noise");
  EXPECT_NEAR(fit.parameters[0].value, 0.02, 0.001);
  EXPECT_NEAR(fit.parameters[1].value, 0.003, 0.00015);
  EXPECT_EQ(fit.parameters[2].path, "imu/gyro_walk");  // which is not there
  EXPECT_EQ(fit.parameters[2].lower95, 0);
  EXPECT_GT(fit.parameters[2].upper95, 0);
  EXPECT_LT(fit.parameters[2].upper95, 0.02);
  EXPECT_THAT(fit.doubts, IsEmpty());
  EXPECT_THAT(fit.checks, SizeIs(6));
}

// Stamps between ticks, and any start that the world has.
TEST(NoiseFit, DoesNotDependOnTheStart) {
  const Folder folder;
  drive(folder, 7, "0.05");
  const NoiseFit from_zero = fitted_odometry(folder);
  const NoiseFit from_more =
      fitted_odometry(folder, "  <physics.replay file=\"poses.csv\"/><robots.odometry noise=\"0.3\"/>");
  EXPECT_NEAR(from_zero.parameters[0].value, from_more.parameters[0].value, 0.03 * from_zero.parameters[0].value);
  EXPECT_NEAR(from_zero.parameters[0].value, 0.05, 0.01);
}

// What is hidden in the data and is no noise of the world: a wheel that is larger than the model says.
TEST(NoiseFit, AScaleIsToldAsWhatItIs) {
  const Folder folder;
  drive(folder, 5, "0.01", [](double, std::vector<double>& cells) { cells[0] *= 1.04, cells[1] *= 1.04; });
  const NoiseFit fit = fitted_odometry(folder);
  ASSERT_FALSE(fit.doubts.empty());
  EXPECT_THAT(fit.doubts[0], AllOf(HasSubstr("\"along\" is "), HasSubstr("more than the world's: a scale")));
  EXPECT_NEAR(fit.checks[0].scale, 0.04, 4 * fit.checks[0].scale_stderr);
  EXPECT_LT(fit.checks[0].scale_stderr, 0.01);
}

// A gyroscope in the place of wheels: its noise grows with time, not with the way, and turns alone have it.
// A heading that creeps by the same angle in each interval.
TEST(NoiseFit, ABiasIsToldAsWhatItIs) {
  const Folder folder;
  drive(folder, 15, "0.01", [](double t, std::vector<double>& cells) { cells[2] += 0.03 * t; });
  const NoiseFit fit = fitted_odometry(folder);
  EXPECT_THAT(fit.doubts, testing::Contains(AllOf(HasSubstr("\"turn\" is off by 0.00"), HasSubstr("a bias"))));
}

TEST(NoiseFit, NoiseOfAnotherKindIsTold) {
  const Folder folder;
  double heading = 0;
  int step = 0;
  drive(folder, 6, "0.01",
        [&](double, std::vector<double>& cells) { cells[2] += heading += 0.03 * std::sin(2.1 * ++step); });
  const NoiseFit fit = fitted_odometry(folder);
  EXPECT_THAT(fit.doubts, testing::Contains(HasSubstr("of another kind than the world's")));
}

// An error that the world has not, in half of the pieces far larger than their noise, for the robot creeps there.
TEST(NoiseFit, OtherErrorsAtRestDoNotCountForAll) {
  const Folder folder;
  folder.write("commands.csv", "t[s],robot,v[m/s],w[rad/s]\n0,rover,0.2,0\n5,rover,1e-6,0\n");
  const World world = world_in(folder, "drive.xml",
                               "  <physics.planar/><robots.drive/><robots.odometry noise=\"0.05\"/>"
                               "<control.recorded robot=\"rover\" file=\"commands.csv\"/>");
  Simulation poses(world, standard(), running());
  log_table(folder, poses, "pose", "x[m],y[m],z[m],qw,qx,qy,qz", 1, "poses.csv");
  Simulation again(world, standard(), running());
  double error = 1e-4;
  log_table(folder, again, "odometry", "x[m],y[m],yaw[rad],v[m/s],w[rad/s]", 5, "odometry.csv",
            [&](double, std::vector<double>& cells) { cells[0] += error = -error; });
  const NoiseFit fit = fitted_odometry(folder);
  EXPECT_NEAR(fit.parameters[0].value, 0.05, 0.015);
}

TEST(NoiseFit, ErrorsThatFollowOneAnotherAreTold) {
  const Folder folder;
  drive(folder, 8, "0.01", [](double t, std::vector<double>& cells) { cells[2] += 0.05 * std::sin(t); });
  const NoiseFit fit = fitted_odometry(folder);
  EXPECT_THAT(fit.doubts, testing::Contains(HasSubstr("follow one another")));
}

TEST(NoiseFit, SaysWhyThereIsNothingToFit) {
  const Folder folder;
  drive(folder, 9, "0.01");
  EXPECT_THAT(fault([&] {
                diagnosis::fit_noise(world_in(folder, "given.xml", replayed), running(), "link/*/rssi",
                                     folder / "odometry.csv", {});
              }),
              HasSubstr("radio readings are fitted without --table"));
  EXPECT_THAT(
      fault([&] { fitted_odometry(folder, "  <physics.planar/><robots.drive/><robots.odometry/><control.wander/>"); }),
      HasSubstr("is drawn anew by each seed"));
  EXPECT_THAT(
      fault([&] {
        fitted_odometry(folder, replayed, {{}, {"robots.odometry/noise"}});
      }),
      AllOf(HasSubstr("no free parameter is a noise of robot/*/odometry"), HasSubstr("robots.odometry/turn_share")));
  EXPECT_THAT(fault([&] {
                fitted_odometry(folder, replayed, {{"robots.odometry/turn_share"}, {}});
              }),
              HasSubstr("--free robots.odometry/turn_share: it is at least 0.1, and noise may be 0"));
  EXPECT_THAT(fault([&] {
                fitted_odometry(folder, replayed, {{"robots.odometry/noice"}, {}});
              }),
              HasSubstr("robots.odometry/noise"));
}

}  // namespace
}  // namespace muster::test
