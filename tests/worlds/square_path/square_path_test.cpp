// The square of UMBmark (Borenstein and Feng, "Measurement and Correction of Systematic Odometry Errors in Mobile
// Robots", 1996): driven both ways by wrong odometry, the ends of the two ways tell the errors.
#include <gtest/gtest.h>

#include <cmath>
#include <muster/tables.hpp>

#include "tests/backends.hpp"
#include "tests/run_world.hpp"
#include "text/number.hpp"

namespace muster::test {
namespace {

constexpr double side = 4, wheel_base = 0.21;  // [m]
constexpr double pi = 3.14159265358979323846;

enum class Way { left, right };

struct Errors {
  double base = 1;       // true wheel base over the believed one
  double diameters = 1;  // true diameter of the right wheel over the left one's, as the robot believes them alike
};

InstanceDeclaration plugin(const std::string& id, const std::vector<std::pair<std::string, double>>& attributes = {}) {
  InstanceDeclaration result{id, id, 1, {}, {}, {}, {"test"}};
  for (const auto& [name, value] : attributes)
    result.attributes.push_back({name, print_real(value), {"test"}, {"test"}});
  return result;
}

Pose end_of(const std::string& physics, Way way, const Errors& errors) {
  World world = read_world(
      std::filesystem::path(MUSTER_SOURCE_DIR) / "worlds/square_path" / (way == Way::left ? "world.xml" : "right.xml"),
      standard());
  Simulation run(std::move(world), standard(), options());
  run.swap("physics", plugin(physics));
  if (errors.base != 1 || errors.diameters != 1)
    run.swap("odometry", plugin("test.odometry", {{"base", errors.base}, {"diameters", errors.diameters}}));
  while (!run.done()) run.step();
  EXPECT_EQ(run.table("instance/steer/progress").at(0, 1), 4) << "the four way points are not reached in time";
  return row<Pose>(run, "robot/scarab/pose");
}

class Umbmark : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Backends, Umbmark,
                         testing::ValuesIn(test::built({"physics.planar", "physics.simbody", "physics.ode",
                                                        "physics.mujoco"})),
                         [](const auto& made) { return std::string(made.param).substr(8); });

// The last way point counts as reached 0.01 m before it, which is how far 2 m/s2 takes from 0.2 m/s to rest.
TEST_P(Umbmark, TheSquareClosesWithoutErrors) {
  for (const Way way : {Way::left, Way::right}) {
    const Pose end = end_of(GetParam(), way, {});
    EXPECT_LT(std::hypot(end.x, end.y), 0.002) << (way == Way::left ? "left" : "right");
  }
}

// What UMBmark makes of the ends of both ways, its equations (4) to (9), angles in radians.
Errors measured(const Pose& left, const Pose& right) {
  const double alpha = (left.x + right.x) / (-4 * side);  // by which a turn falls short, from the wheel base
  const double beta = (left.x - right.x) / (4 * side);    // by which a side bends to the left, from the diameters
  const double bend = wheel_base / 2 * std::sin(beta / 2) / (side / 2);  // half a wheel base over the radius of a side
  return {pi / 2 / (pi / 2 - alpha), (1 + bend) / (1 - bend)};
}

// The equations hold for turns on the spot, where this robot drives arcs of a twentieth of a side, and to first order
// in alpha and beta, which are at most 0.05 and 0.01 here.
TEST_P(Umbmark, TellsTheErrorsThatTheOdometryHas) {
  for (const Errors& given : {Errors{1.02, 1}, Errors{0.97, 1}, Errors{1, 1.0005}, Errors{1.02, 0.9995}}) {
    const Errors found = measured(end_of(GetParam(), Way::left, given), end_of(GetParam(), Way::right, given));
    EXPECT_NEAR(found.base - 1, given.base - 1, 0.1 * std::abs(given.base - 1) + 5e-4);
    EXPECT_NEAR(found.diameters - 1, given.diameters - 1, 0.1 * std::abs(given.diameters - 1) + 5e-5);
  }
}

}  // namespace
}  // namespace muster::test
