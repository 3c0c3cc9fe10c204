// Walls and things swept over a plan: the best place is where they were put.
#include "diagnosis/place_sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "muster/random.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;

// Rows whose links meet the object score 1, others -1; the gain of a set is that of its mean.
class Scored : public search::Tally {
 public:
  explicit Scored(std::vector<double> scores) : scores_(std::move(scores)) {}
  Index rows() const override { return static_cast<Index>(scores_.size()); }
  Index reading(Index row) const override { return row; }
  void clear() override { sum_ = squares_ = 0; }
  void add(Index row, double value) override {
    sum_ -= value * scores_[static_cast<std::size_t>(row)];
    squares_ += value * value;
  }
  double gain() const override { return sum_ > 0 ? sum_ * sum_ / squares_ : 0; }

 private:
  std::vector<double> scores_;
  double sum_ = 0, squares_ = 0;
};

struct Plan {
  Survey survey;
  LinkEnds ends;

  Plan() {
    survey.east = {0, 12};
    survey.north = {0, 9};
    survey.plan_angle = 0.3;
    const Stream stream(5);
    for (uint64_t k = 0; k < 3000; ++k) {
      const double radio = k % 3 == 0 ? 0.5 : k % 3 == 1 ? 11 : 6;
      ends.push_back({End{radio, k % 3 == 2 ? 8.5 : 1, 1, 0, 0},
                      End{12 * stream.uniform(k, 0), 9 * stream.uniform(k, 1), 0.4, 0, 1}});
    }
  }

  template <class Meets>
  Scored scored(const Meets& meets) const {
    std::vector<double> scores;
    for (const auto& [a, b] : ends) scores.push_back(meets(a, b) ? 1 : -1);
    return Scored(std::move(scores));
  }
};

bool meets_segment(const End& a, const End& b, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const auto side = [](double ax, double ay, double bx, double by, double px, double py) {
    return (bx - ax) * (py - ay) - (by - ay) * (px - ax) > 0;
  };
  return side(a.x, a.y, b.x, b.y, from.x(), from.y()) != side(a.x, a.y, b.x, b.y, to.x(), to.y()) &&
         side(from.x(), from.y(), to.x(), to.y(), a.x, a.y) != side(from.x(), from.y(), to.x(), to.y(), b.x, b.y);
}

struct Ends {
  Eigen::Vector2d from, to;
};

Ends ends_of(const Eigen::VectorXd& theta) {
  const Eigen::Vector2d middle = theta.segment<2>(1),
                        half = theta[3] / 2 * Eigen::Vector2d(std::cos(theta[4]), std::sin(theta[4]));
  return {middle - half, middle + half};
}

TEST(PlaceSweep, FindsASegment) {
  Plan plan;
  const Eigen::Vector2d middle(6, 4), half = 1.1 * Eigen::Vector2d(std::cos(0.4), std::sin(0.4));
  Scored tally =
      plan.scored([&](const End& a, const End& b) { return meets_segment(a, b, middle - half, middle + half); });
  const auto swept = swept_segments(plan.survey, plan.ends, tally);
  ASSERT_FALSE(swept.empty());
  const Ends found = ends_of(swept[0]);
  EXPECT_LT(std::min((found.from - middle + half).norm(), (found.from - middle - half).norm()), 0.5);
  EXPECT_LT(std::min((found.to - middle + half).norm(), (found.to - middle - half).norm()), 0.5);
}

TEST(PlaceSweep, LeavesOutWhatWasDrivenAcross) {
  Plan plan;
  const Eigen::Vector2d middle(6, 4), half = 1.1 * Eigen::Vector2d(std::cos(0.4), std::sin(0.4));
  plan.survey.ways.push_back({6, 2, 6, 7});
  Scored tally =
      plan.scored([&](const End& a, const End& b) { return meets_segment(a, b, middle - half, middle + half); });
  for (const Eigen::VectorXd& theta : swept_segments(plan.survey, plan.ends, tally)) {
    const Ends e = ends_of(theta);
    End from{}, to{};
    from.x = 6, from.y = 2, to.x = 6, to.y = 7;
    EXPECT_FALSE(meets_segment(from, to, e.from, e.to)) << theta.transpose();
  }
}

TEST(PlaceSweep, FindsADisk) {
  Plan plan;
  plan.survey.ways.push_back({2, 2, 2.1, 2});
  Scored tally = plan.scored([&](const End& a, const End& b) {
    const Eigen::Vector2d from(a.x, a.y), way = Eigen::Vector2d(b.x, b.y) - from, to(7.3, 5.1);
    const double share = std::clamp((to - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
    return (from + share * way - to).norm() < 0.5;
  });
  const auto swept = swept_disks(plan.survey, plan.ends, tally);
  ASSERT_FALSE(swept.empty());
  EXPECT_NEAR(swept[0][1], 7.3, 0.4);
  EXPECT_NEAR(swept[0][2], 5.1, 0.4);
  EXPECT_NEAR(std::exp(swept[0][3]), 0.5, 0.31);
}

}  // namespace
}  // namespace muster::diagnosis
