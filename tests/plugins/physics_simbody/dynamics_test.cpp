// The stepper's block of eight velocities is Simbody's own dynamics.
#include <random>

#include "robot_models.hpp"
#include "scarabs.hpp"

namespace muster::simbody {
namespace {

TEST(Dynamics, FreeAccelerationIsSimbodys) {
  const RobotModels crew({{"r", &scarab()}});
  std::mt19937 random(7);
  const auto draw = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
  for (int trial = 0; trial < 20; ++trial) {
    SimTK::State state = crew.system().state;
    Eigen::Quaterniond q(draw(), draw(), draw(), draw());
    q.normalize();
    const double values[] = {q.w(), q.x(), q.y(), q.z(), draw(), draw(), draw(), 3 * draw(), 3 * draw()};
    for (int k = 0; k < 9; ++k) state.updQ()[k] = values[k];
    for (int k = 0; k < 8; ++k) state.updU()[k] = 5 * draw();
    crew.system().system.realize(state, SimTK::Stage::Acceleration);
    const Eigen::Matrix3d r = q.toRotationMatrix();
    Eigen::Map<const Eigen::Matrix<double, 8, 1>> u(&state.getU()[0]), udot(&state.getUDot()[0]);
    Velocity body = u, expected = udot;
    body.head<3>() = r.transpose() * u.head<3>();
    body.segment<3>(3) = r.transpose() * u.segment<3>(3);
    expected.head<3>() = r.transpose() * udot.head<3>();
    expected.segment<3>(3) = r.transpose() * udot.segment<3>(3);
    Velocity mine = crew[0].free_acceleration(r, body);
    const Eigen::Vector3d w = body.head<3>();
    mine.segment<3>(3) -= w.cross(w.cross(crew[0].whole.centre));  // the origin's motion about the mass centre
    EXPECT_LT((mine - expected).norm(), 1e-9 * (1 + expected.norm())) << mine.transpose() << "\n"
                                                                      << expected.transpose();
  }
}

TEST(Dynamics, SimbodyWeighsTheScarab) {
  const RobotModels crew({{"r", &scarab()}});
  SimTK::State state = crew.system().state;
  crew.system().system.realize(state, SimTK::Stage::Position);
  EXPECT_NEAR(crew.system().matter.calcSystemMass(state), 8, 1e-12);
  const auto centre = crew.system().matter.calcSystemMassCenterLocationInGround(state);
  const description::Mass whole = whole_mass(scarab());
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(centre[k], whole.centre[k], 1e-12);
}

}  // namespace
}  // namespace muster::simbody
