// The solver of one step, against Coulomb's law itself.
#include "contact_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <random>

namespace muster::simbody {
namespace {

// Kept alive while the tests run.
const Inertia* kept(const MassMatrix& mass) {
  static std::deque<Inertia> all;
  all.push_back({mass, mass.inverse()});
  return &all.back();
}

// A point mass of 2 kg as the linear part; the rotational inertia is 1, without forces.
Problem point(const Eigen::Vector3d& velocity, double friction) {
  Problem p;
  p.bodies.resize(1);
  Body& body = p.bodies[0];
  MassMatrix mass = MassMatrix::Identity();
  mass.diagonal().segment<3>(3).setConstant(2);
  body.inertia = kept(mass);
  body.free.setZero();
  body.free.segment<3>(3) = velocity;
  body.previous = body.free;
  Contact c;
  c.normal.setZero();
  c.normal[5] = 1;
  for (int k = 0; k < 2; ++k) {
    c.tangent[k].setZero();
    c.tangent[k][3 + k] = 1;
  }
  c.friction = friction;
  c.softness = 1e-6;
  p.contacts = {c};
  return p;
}

TEST(ContactSolver, SticksInsideTheCone) {
  Problem p = point({0.3, 0.4, -1}, 0.6);
  const Outcome out = ContactSolver().solve(p);
  EXPECT_TRUE(out.direct);
  EXPECT_LT(p.bodies[0].velocity.segment<3>(3).norm(), 1e-5);
  EXPECT_NEAR(p.contacts[0].push, 2, 1e-4);
  EXPECT_NEAR(p.contacts[0].grip.norm(), 1, 1e-4);
}

TEST(ContactSolver, SlidesAgainstItsSlipOutsideTheCone) {
  for (double angle = 0; angle < 6.3; angle += 0.37) {
    const Eigen::Vector2d way(std::cos(angle), std::sin(angle));
    Problem p = point({way.x(), way.y(), -1}, 0.25);
    const Outcome out = ContactSolver().solve(p);
    EXPECT_FALSE(out.direct);
    EXPECT_TRUE(out.converged);
    // 2 kg: the push of 2 N s allows 0.5 N s of friction, which takes 0.25 m/s.
    EXPECT_LT((p.bodies[0].velocity.segment<2>(3) - 0.75 * way).norm(), 1e-4) << angle;
  }
}

TEST(ContactSolver, PullsAtNothing) {
  Problem p = point({1, 0, 0.5}, 0.6);
  ContactSolver().solve(p);
  EXPECT_EQ(p.contacts[0].push, 0);
  EXPECT_LT((p.bodies[0].velocity - p.bodies[0].free).norm(), 1e-9);
}

TEST(ContactSolver, MotorsStopAtTheirLimit) {
  Problem p = point({0, 0, 1}, 0.6);
  p.bodies[0].motors = {Motor{3, 0.5}, Motor{0.2, 0.5}};
  ContactSolver().solve(p);
  EXPECT_NEAR(p.bodies[0].velocity[6], 0.5, 1e-9);  // inertia 1: the impulse itself
  EXPECT_NEAR(p.bodies[0].velocity[7], 0.2, 1e-4);
}

// Random masses and contacts.
Problem random_problem(std::mt19937& random) {
  const auto draw = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
  Problem p = point({draw(), draw(), -std::abs(draw())}, 0.1 + 0.4 * std::abs(draw()));
  MassMatrix a = MassMatrix::NullaryExpr([&](Eigen::Index, Eigen::Index) { return draw(); });
  p.bodies[0].inertia = kept(a * a.transpose() + MassMatrix::Identity());
  const Contact base = p.contacts[0];
  for (int c = 0; c < 2; ++c) {
    Contact more = base;
    more.normal.head<3>() << draw(), draw(), draw();
    for (auto& t : more.tangent) t.head<3>() << draw(), draw(), draw();
    more.softness = 0.01;
    p.contacts.push_back(more);
  }
  p.bodies[0].motors = {Motor{draw(), 0.2 * std::abs(draw())}, Motor{draw(), 0.2 * std::abs(draw())}};
  return p;
}

// Every result satisfies the law.
TEST(ContactSolver, ObeysCoulombOnRandomProblems) {
  std::mt19937 random(3);
  int slipping = 0, unsettled = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Problem p = random_problem(random);
    const Outcome out = ContactSolver().solve(p);
    slipping += !out.direct;
    unsettled += !out.converged;
    double largest = 0;
    for (const Contact& c : p.contacts) largest = std::max(largest, c.friction * c.push);
    Velocity impulse = Velocity::Zero();
    for (const Contact& c : p.contacts) {
      EXPECT_GE(c.push, 0);
      if (out.converged) {
        EXPECT_LE(c.grip.norm(), c.friction * c.push + 1.01e-3 * largest + 1e-6);
      }
      const Eigen::Vector2d slip(c.tangent[0].dot(p.bodies[0].velocity), c.tangent[1].dot(p.bodies[0].velocity));
      if (slip.norm() > 1e-4 && c.grip.norm() > 1e-9) {
        EXPECT_LT(c.grip.dot(slip), -0.999 * c.grip.norm() * slip.norm());
      }
      impulse += c.push * c.normal + c.grip[0] * c.tangent[0] + c.grip[1] * c.tangent[1];
    }
    const Velocity rest = p.bodies[0].inertia->mass * (p.bodies[0].velocity - p.bodies[0].free) - impulse;
    EXPECT_LT(rest.head<6>().norm(), 1e-5);  // momentum
    for (int m = 0; m < 2; ++m) EXPECT_LE(std::abs(rest[6 + m]), p.bodies[0].motors[m].limit + 1e-6);
  }
  EXPECT_GT(slipping, 500);
  EXPECT_LT(unsettled, 200);  // couplings this extreme need not have a solution
}

// Warm start: from the solution of a step the next one is found at the first try, and equals that of all passes.
TEST(ContactSolver, GoesOnAsBefore) {
  std::mt19937 random(5);
  int found = 0, slipping = 0, asked = 0;
  for (int trial = 0; trial < 500; ++trial) {
    Problem p = random_problem(random);
    for (Motor& motor : p.bodies[0].motors) motor.limit = 100;  // the mode of the last step is unknown
    p.search.bound_tolerance = 1e-8;
    p.search.passes = 100;
    const Outcome before = ContactSolver().solve(p);
    if (!before.converged) continue;
    Body& body = p.bodies[0];
    body.previous = body.velocity;
    body.free *= 1.001;
    Problem on = p;
    on.search.first = Search::First::as_before;
    if (!ContactSolver().solve(p).converged) continue;
    const bool direct = ContactSolver().solve(on).direct;
    ++asked;
    slipping += !before.direct;
    found += direct;
    if (direct) {
      EXPECT_LT((on.bodies[0].velocity - body.velocity).norm(), 1e-5) << trial;
    }
  }
  EXPECT_GT(slipping, 200);
  EXPECT_GT(found, 0.9 * asked);
}

// A linear iteration whose matrix has three eigenvalues converges in one step more.
TEST(Mixing, EndsALinearIteration) {
  const Velocity rates{{0.5, -0.9, 0.2, 0.5, -0.9, 0.2, 0.5, 0.2}};  // factor of each unknown in a step
  Blocks<Velocity> u{Velocity::Ones(), 2 * Velocity::Ones()}, d(2);
  MixingOf<unknowns> mixing;
  for (int step = 0; step < 4; ++step) {
    for (std::size_t b = 0; b < 2; ++b) d[b] = (rates.array() - 1) * u[b].array();
    mixing.mix(u, d, Velocity::Ones());
    for (std::size_t b = 0; b < 2; ++b) u[b] += d[b];
  }
  EXPECT_LT(u[0].norm() + u[1].norm(), 1e-6);
}

}  // namespace
}  // namespace muster::simbody
