// Inertial measurement: closed forms before noise, and the laws of its errors.
#include <Eigen/Geometry>

#include "sense_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;
using Eigen::Vector3d;

constexpr double g = 9.81;  // m/s2
const std::string fast = "dt=\"0.01\" until=\"600\" seed=\"3\"";

Imu reading(const Simulation& run, const std::string& robot = "r") { return row<Imu>(run, "robot/" + robot + "/imu"); }
Vector3d force(const Imu& imu) { return {imu.fx, imu.fy, imu.fz}; }
Vector3d rate(const Imu& imu) { return {imu.wx, imu.wy, imu.wz}; }

TEST(Imu, AtRestTellsGravityInItsOwnAxes) {
  for (const std::string physics : {"planar", "simbody"}) {
    Folder folder;
    Simulation run = world_of(folder,
                              "<robot name=\"r\" at=\"1 2 0\" heading=\"0.7\"/><physics." + physics +
                                  "/><robots.drive/><sensors.imu x=\"0.1\" y=\"0.2\" z=\"0.3\" roll=\"0.3\" "
                                  "pitch=\"-0.4\" yaw=\"1.1\"/>",
                              {}, fast);
    EXPECT_TRUE(is_null(reading(run).t)) << "no places before";
    run_ticks(run, 300);
    const Eigen::Matrix3d sensor =
        (Eigen::AngleAxisd(1.1, Vector3d::UnitZ()) * Eigen::AngleAxisd(-0.4, Vector3d::UnitY()) *
         Eigen::AngleAxisd(0.3, Vector3d::UnitX()))
            .toRotationMatrix();
    const Pose stands = row<Pose>(run, "robot/r/pose");  // simbody's wheels give way a little
    const Eigen::Quaterniond attitude(stands.qw, stands.qx, stands.qy, stands.qz);
    const Vector3d expected = sensor.transpose() * (attitude.conjugate() * Vector3d(0, 0, g));
    EXPECT_LT((force(reading(run)) - expected).norm(), physics == "planar" ? 1e-9 : 1e-6) << physics;
    EXPECT_LT(rate(reading(run)).norm(), 1e-9) << physics;
    EXPECT_NEAR(reading(run).t, time_of(run) - 0.01, 1e-12);
  }
}

// On a circle about (0, v/w) the point p of the body is accelerated by -w^2 (p - centre).
TEST(Imu, InAConstantTurnTellsTheCentripetalForceAtItsPlace) {
  const double v = 0.3, w = 1.3;
  for (const double heading : {0.0, 2.0}) {
    Folder folder;
    Simulation run =
        world_of(folder,
                 "<robot name=\"r\" at=\"5 -7 0\" heading=\"" + std::to_string(heading) +
                     "\"/><physics.planar/><robots.drive/><control.steady robot=\"r\" v=\"0.3\" w=\"1.3\"/>"
                     "<sensors.imu x=\"0.1\" y=\"-0.05\" z=\"0.2\"/>",
                 {}, "dt=\"0.05\" until=\"60\" seed=\"1\"");
    run_ticks(run, 200);
    const Imu imu = reading(run);
    EXPECT_NEAR(imu.fx, -w * w * 0.1, 1e-9);
    EXPECT_NEAR(imu.fy, -w * w * (-0.05 - v / w), 1e-9);
    EXPECT_NEAR(imu.fz, g, 1e-9);
    EXPECT_NEAR(imu.wz, w, 1e-9);
    EXPECT_LT(std::hypot(imu.wx, imu.wy), 1e-9);
  }
}

TEST(Imu, InFreeFallTellsNothing) {
  Folder folder;
  Simulation run =
      world_of(folder, "<robot name=\"r\" model=\"crate\" at=\"0 0 90\"/><physics.simbody/><sensors.imu/>", {}, fast);
  run.step();
  EXPECT_TRUE(is_null(reading(run).t));
  for (int i = 0; i < 200; ++i) {
    run.step();
    EXPECT_LT(force(reading(run)).norm(), 1e-9);
  }
}

// What a uniform acceleration along a course makes, on a body that neither turns nor stands upright.
TEST(Imu, AlongACourseTellsItsAcceleration) {
  Folder folder;
  std::string course = "t[s],robot,x[m],y[m],z[m],qw,qx,qy,qz\n";
  std::ostringstream lines;
  lines.precision(17);
  for (int i = 0; i <= 400; ++i) {
    const double t = 0.01 * i;
    lines << t << ",r," << 0.4 * t * t << ",0,1," << std::cos(0.15) << ",0," << std::sin(0.15) << ",0\n";
  }
  Simulation run =
      world_of(folder, "<robot name=\"r\" at=\"0 0 1\"/><physics.replay file=\"course.csv\"/><sensors.imu/>",
               {{"course.csv", course + lines.str()}}, "dt=\"0.01\" until=\"3\" seed=\"1\"");
  run_ticks(run, 150);
  const Eigen::Quaterniond attitude(std::cos(0.15), 0, std::sin(0.15), 0);
  EXPECT_LT((force(reading(run)) - attitude.conjugate() * Vector3d(0.8, 0, g)).norm(), 1e-6);
}

std::vector<Imu> readings(const std::string& attributes, int ticks, const std::string& more = "", double dt = 0.01) {
  Folder folder;
  std::ostringstream world;
  world << "dt=\"" << dt << "\" until=\"100000\" seed=\"3\"";
  Simulation run =
      world_of(folder, "<robot name=\"r\" at=\"0 0 0\"/>" + more + "<physics.planar/><sensors.imu " + attributes + "/>",
               {}, world.str());
  std::vector<Imu> result;
  for (int i = 0; i < ticks; ++i) {
    run.step();
    const Imu now = reading(run);
    if (!is_null(now.t) && (result.empty() || now.t != result.back().t)) result.push_back(now);
  }
  return result;
}

// Allan variance of numbers at `m` of their periods, from overlapping means.
double allan(const std::vector<double>& numbers, std::size_t m) {
  std::vector<double> sum(numbers.size() + 1, 0);
  for (std::size_t i = 0; i < numbers.size(); ++i) sum[i + 1] = sum[i] + numbers[i];
  double squares = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i + 2 * m < sum.size(); ++i, ++count) {
    const double difference = (sum[i + 2 * m] - 2 * sum[i + m] + sum[i]) / static_cast<double>(m);
    squares += difference * difference;
  }
  return squares / (2 * static_cast<double>(count));
}

TEST(Imu, NoiseHasTheAllanVarianceThatIsStated) {
  const double density = 0.02, walk = 0.05, period = 0.01;
  for (const bool walks : {false, true}) {
    const auto all =
        readings(walks ? "accel_walk=\"0.05\" gyro_walk=\"0.05\"" : "accel_noise=\"0.02\" gyro_noise=\"0.02\"", 40001);
    ASSERT_EQ(all.size(), 40000u);
    for (const bool turns : {false, true}) {
      std::vector<double> numbers;
      for (const Imu& imu : all) numbers.push_back(turns ? imu.wx : imu.fx);
      for (const std::size_t m : {std::size_t{1}, std::size_t{10}, std::size_t{40}}) {
        const double md = static_cast<double>(m), tau = md * period;
        // The walk moves in steps: tau/3 in the limit of many.
        const double expected = walks ? walk * walk * period * (2 * md * md + 1) / (6 * md) : density * density / tau;
        EXPECT_NEAR(allan(numbers, m) / expected, 1, 5 * std::sqrt(2 * md / 40000))
            << walks << ' ' << turns << ' ' << m;
      }
    }
  }
}

TEST(Imu, HasBiasScaleAndRange) {
  const auto at_rest =
      readings("accel_bias_x=\"0.1\" accel_bias_y=\"-0.2\" gyro_bias_z=\"0.03\" accel_scale=\"0.01\"", 3).back();
  EXPECT_NEAR(at_rest.fx, 0.1, 1e-12);
  EXPECT_NEAR(at_rest.fy, -0.2, 1e-12);
  EXPECT_NEAR(at_rest.fz, 1.01 * g, 1e-12);
  EXPECT_NEAR(at_rest.wz, 0.03, 1e-12);
  EXPECT_EQ(readings("accel_range=\"5\"", 3).back().fz, 5);
  EXPECT_EQ(readings("accel_range=\"5\" roll=\"3.141592653589793\"", 3).back().fz, -5);
  EXPECT_EQ(readings("gyro_range=\"0.5\" gyro_bias_x=\"-3\"", 3).back().wx, -0.5);
}

TEST(Imu, TellsAtItsRate) {
  EXPECT_EQ(readings("rate=\"20\"", 200).size(), 40u);
  EXPECT_EQ(readings("rate=\"1000\"", 200).size(), 199u) << "once a step, from the second on";
  double squares = 0;
  const auto seldom = readings("rate=\"20\" gyro_noise=\"0.02\"", 20000);
  for (const Imu& imu : seldom) squares += imu.wy * imu.wy;
  EXPECT_NEAR(squares / static_cast<double>(seldom.size()) / (0.02 * 0.02 * 20), 1, 0.15);
}

TEST(Imu, ServesEachRobotOnce) {
  Folder folder;
  Simulation run = world_of(folder,
                            "<robot name=\"r\" at=\"0 0 0\"/><robot name=\"s\" at=\"3 0 0\"/><physics.planar/>"
                            "<sensors.imu name=\"own\" robot=\"s\" accel_bias_x=\"1\"/>"
                            "<sensors.imu name=\"rest\" accel_bias_x=\"2\" gyro_noise=\"0.1\"/>");
  run_ticks(run, 3);
  EXPECT_NEAR(reading(run, "s").fx, 1, 1e-12);
  EXPECT_NEAR(reading(run, "r").fx, 2, 1e-12);
  EXPECT_EQ(reading(run, "s").wx, 0);
  EXPECT_NE(reading(run, "r").wx, 0);
}

TEST(Imu, IsTheSameRun) {
  Folder folder;
  expect_one_run(
      [&] {
        return world_in(folder,
                        "<robot name=\"r\" at=\"0 0 0\"/><robot name=\"s\" at=\"3 0 0\"/><physics.planar/>"
                        "<robots.drive/><control.wander/><sensors.imu name=\"i\" rate=\"7\" accel_noise=\"0.1\" "
                        "accel_walk=\"0.1\" gyro_walk=\"0.1\" x=\"0.1\"/>");
      },
      "i");
}

}  // namespace
