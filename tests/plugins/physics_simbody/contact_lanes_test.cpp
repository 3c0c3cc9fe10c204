// Eight contacts at a time equal friction.hpp for each, in the same bits for every instruction set.
#include "contact_lanes.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

#include "block_kernel.hpp"
#include "friction.hpp"

namespace muster::simbody {
namespace {

using Eigen::Vector2d;

constexpr int width = ContactLanes::width;

// Contacts that are open or push, stick or slide, some without friction; the last lane of all is left empty.
std::vector<ContactLanes> some_contacts() {
  std::mt19937 random(4);
  const auto draw = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
  std::vector<ContactLanes> all(5, ContactLanes{});
  for (ContactLanes& c : all) {
    for (int k = 0; k < width; ++k) {
      if (&c == &all.back() && k + 1 == width) continue;
      c.target[k] = draw(), c.speed[k] = draw(), c.speed_ahead[k] = draw();
      c.hardness[k] = 100 * (1.5 + draw()), c.grip_softness[k] = 0.5 + 0.4 * draw();
      c.bound[k] = k % 4 == 3 ? 0 : 2 + draw();
      Vector2d dual = within(2 * Vector2d(draw(), draw()), c.bound[k]);
      for (int way : {0, 1}) c.dual[way][k] = dual[way], c.slip[way][k] = 2 * draw(), c.slip_ahead[way][k] = draw();
    }
  }
  return all;
}

Vector2d of(const double (&lanes)[2][width], int k) { return {lanes[0][k], lanes[1][k]}; }

// The primal-dual Hessian: where it slides, friction's own, except that the unit vector along the slip is replaced half
// by the dual (Chan, Golub, Mulet 1999).
Eigen::Matrix2d answer_to_slip(const Vector2d& slip, double bound, const Vector2d& dual, double softness) {
  if (bound <= 0) return Eigen::Matrix2d::Zero();
  const double size = slip.norm();
  if (sticks(size, bound, softness)) return Eigen::Matrix2d::Identity() / softness;
  const Eigen::Matrix2d along = dual * slip.transpose() / (size * size);
  return bound / size * Eigen::Matrix2d::Identity() + 0.5 * (along + along.transpose());
}

// Runs it by every kernel: all must agree in all bits.
template <class Operation>
std::vector<ContactLanes> in_all_kernels(Operation operation) {
  const BlockKernels kernels = block_kernels();
  std::vector<ContactLanes> first;
  for (int i = 0; i < kernels.number; ++i) {
    std::vector<ContactLanes> result = some_contacts();
    operation(kernels.all[i]->lanes, result);
    if (i == 0) first = result;
    EXPECT_EQ(std::memcmp(result.data(), first.data(), first.size() * sizeof(ContactLanes)), 0) << kernels.all[i]->name;
  }
  return first;
}

TEST(ContactLanes, ImpulsesAndHessianAreThoseOfOneContact) {
  const auto all = in_all_kernels([](const LaneArithmetic& by, std::vector<ContactLanes>& contacts) {
    by.respond(contacts.data(), static_cast<int>(contacts.size()));
  });
  int sticking = 0, sliding = 0, open = 0;
  for (const ContactLanes& c : all) {
    for (int k = 0; k < width; ++k) {
      const Vector2d slip = of(c.slip, k), grip = grip_of(slip, c.bound[k], c.grip_softness[k]);
      const Eigen::Matrix2d stiffness = answer_to_slip(slip, c.bound[k], of(c.dual, k), c.grip_softness[k]);
      const double lacks = c.target[k] - c.speed[k];
      EXPECT_NEAR(c.push[k], lacks > 0 ? lacks * c.hardness[k] : 0, 1e-12);
      EXPECT_EQ(c.stiffness[k], lacks > 0 ? c.hardness[k] : 0);
      EXPECT_LT((of(c.grip, k) - grip).norm(), 1e-12);
      EXPECT_NEAR(c.grip_xx[k], stiffness(0, 0), 1e-12);
      EXPECT_NEAR(c.grip_xy[k], stiffness(0, 1), 1e-12);
      EXPECT_NEAR(c.grip_yy[k], stiffness(1, 1), 1e-12);
      open += lacks <= 0;
      (sticks(slip.norm(), c.bound[k], c.grip_softness[k]) ? sticking : sliding) += c.bound[k] > 0;
    }
  }
  EXPECT_GT(sticking, 5);
  EXPECT_GT(sliding, 5);
  EXPECT_GT(open, 5);
}

// Contribution of the impulses to the energy's slope at a fraction of the step.
TEST(ContactLanes, SlopeIsThatOfTheImpulses) {
  for (const double a : {0.0, 0.3, 1.0}) {
    double slope = 0, first = 0;
    const auto all = in_all_kernels([&](const LaneArithmetic& by, std::vector<ContactLanes>& contacts) {
      slope = by.slope(contacts.data(), static_cast<int>(contacts.size()), a);
      if (first == 0) first = slope;
      EXPECT_EQ(slope, first);
      by.go_ahead(contacts.data(), static_cast<int>(contacts.size()), a);
      by.respond(contacts.data(), static_cast<int>(contacts.size()));
    });
    double expected = 0;
    for (const ContactLanes& c : all) {
      for (int k = 0; k < width; ++k) expected += c.push[k] * c.speed_ahead[k] + of(c.grip, k).dot(of(c.slip_ahead, k));
    }
    EXPECT_NEAR(slope, expected, 1e-10 * (1 + std::abs(expected)));
  }
}

// A dual moves to the linearised friction at the end of the step (Chan, Golub, Mulet 1999), within friction's bound.
TEST(ContactLanes, DualsMoveAsFrictionDoes) {
  const std::vector<ContactLanes> before = some_contacts();
  const auto all = in_all_kernels([](const LaneArithmetic& by, std::vector<ContactLanes>& contacts) {
    by.move_duals(contacts.data(), static_cast<int>(contacts.size()));
  });
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (int k = 0; k < width; ++k) {
      const ContactLanes& c = before[i];
      const Vector2d slip = of(c.slip, k), change = of(c.slip_ahead, k), dual = of(c.dual, k);
      Vector2d expected = Vector2d::Zero();
      if (c.bound[k] > 0) {
        const double size = slip.norm();
        expected = sticks(size, c.bound[k], c.grip_softness[k])
                       ? Vector2d(-(slip + change) / c.grip_softness[k])
                       : Vector2d(-(c.bound[k] / size) * (slip + change) - (slip.dot(change) / (size * size)) * dual);
        expected = within(expected, c.bound[k]);
      }
      EXPECT_LT((of(all[i].dual, k) - expected).norm(), 1e-12);
      EXPECT_LE(of(all[i].dual, k).norm(), c.bound[k] * (1 + 1e-12));
    }
  }
}

}  // namespace
}  // namespace muster::simbody
