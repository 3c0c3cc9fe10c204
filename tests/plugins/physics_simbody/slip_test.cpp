// Wheels that slip: end points of Scarabs on arcs that exceed friction, against Coulomb's isotropic law.
#include "benchmarks/smooth_coulomb.hpp"
#include "scarabs.hpp"

namespace muster::simbody {
namespace {

using Place = std::array<double, 2>;

double apart(const Place& a, const Place& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

Place coulomb(const bench::Arc& arc, double friction, const bench::SmoothCoulomb::Fineness& fineness) {
  return bench::SmoothCoulomb(scarab(), friction, fineness).drive(arc);
}

Place ours(const bench::Arc& arc, double friction, double h) {
  description::Robot robot = scarab();
  robot.drive->friction = friction;
  Fleet fleet({at_rest(arc.x, arc.y, arc.heading)}, robot, Integrator::midpoint, h);
  fleet.drive(bench::until, h, [&](double t) { return Command{arc.left(t), arc.right(t), 0, 0}; });
  return {fleet.states[0].pose[0], fleet.states[0].pose[1]};
}

// End point at a friction; the bound is on its distance from that without slip.
struct Goal {
  double friction, at_10_ms;
};
class Slip : public testing::TestWithParam<Goal> {};

TEST_P(Slip, FollowsCoulombsLaw) {
  const double friction = GetParam().friction;
  const bench::SmoothCoulomb::Fineness fine;
  double slipped = 0, uncertain = 0, at_10_ms = 0, at_1_ms = 0;
  for (const int robot : {0, 3, 10, 21}) {
    const bench::Arc arc = bench::arc(robot);
    const Place law = coulomb(arc, friction, fine);
    slipped = std::max(slipped, apart(law, ours(arc, 0.8, 0.01)));
    uncertain = std::max(uncertain, apart(law, coulomb(arc, friction, fine.coarser())));
    at_10_ms = std::max(at_10_ms, apart(law, ours(arc, friction, 0.01)));
    at_1_ms = std::max(at_1_ms, apart(law, ours(arc, friction, 0.001)));
  }
  EXPECT_GT(slipped, 0.5);
  EXPECT_LT(uncertain, 0.004 * slipped);
  EXPECT_LT(at_10_ms, GetParam().at_10_ms * slipped);
  EXPECT_LT(at_1_ms, 0.005 * slipped);
}

INSTANTIATE_TEST_SUITE_P(Friction, Slip, testing::Values(Goal{0.03, 0.01}, Goal{0.05, 0.015}, Goal{0.1, 0.015}),
                         [](const auto& made) { return std::to_string(std::lround(100 * made.param.friction)); });

}  // namespace
}  // namespace muster::simbody
