// Merges pieces of one wall, but not two walls.
#include "diagnosis/inference/select/merge_duplicates.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/diagnosis/inference/guessed.hpp"

namespace muster::inference {
namespace {

TEST(MergeDuplicates, TwoHalvesOfAWallBecomeOne) {
  const auto world = world_of(varied(11, 4000));
  const auto causes = causes_of(world);
  const Candidate& wall = causes[causes.size() - 2];
  ASSERT_EQ(wall.id, "unmapped_wall");
  const Eigen::VectorXd whole = Eigen::Vector4d(12, 8, 5, 0.35);
  const Eigen::VectorXd effect = -scaled_to(world, wall.design.columns(whole), 400);
  const Problem problem = problem_of(world, effect, causes);
  ModelState state(problem, {});
  score(state);
  const double x = 1.25 * std::cos(0.35), y = 1.25 * std::sin(0.35);
  state.terms.push_back(term_at(state, "unmapped_wall", Eigen::Vector4d(12 - x, 8 - y, 2.5, 0.35)));
  state.terms.push_back(term_at(state, "unmapped_wall", Eigen::Vector4d(12 + x, 8 + y, 2.5, 0.35)));
  state.refit();
  ASSERT_TRUE(merge_pieces(state, "place"));
  ASSERT_EQ(state.terms.size(), 1u);
  const Eigen::VectorXd& found = state.terms[0].theta;
  EXPECT_EQ(state.terms[0].candidate->id, "unmapped_wall");
  EXPECT_LT(std::hypot(found[0] - 12, found[1] - 8), 0.5);
  EXPECT_NEAR(found[2], 5, 1);
}

TEST(MergeDuplicates, TwoSeparateWallsRemainTwo) {
  const auto world = world_of(varied(12, 4000));
  const auto causes = causes_of(world);
  const Candidate& wall = causes[causes.size() - 2];
  const Eigen::VectorXd one = Eigen::Vector4d(6, 5, 4, 0), other = Eigen::Vector4d(18, 10, 4, M_PI / 2);
  const Eigen::VectorXd effect =
      -scaled_to(world, wall.design.columns(one), 150) - scaled_to(world, wall.design.columns(other), 150);
  const Problem problem = problem_of(world, effect, causes);
  ModelState state(problem, {});
  score(state);
  state.terms = {term_at(state, "unmapped_wall", one), term_at(state, "unmapped_wall", other)};
  state.refit();
  EXPECT_FALSE(merge_pieces(state, "place"));
  EXPECT_EQ(state.terms.size(), 2u);
}

}  // namespace
}  // namespace muster::inference
