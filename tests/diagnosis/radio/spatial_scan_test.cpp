// Spatial scan of walls and disks over a plan: the optimum is at the true place.
#include "diagnosis/radio/causes/spatial_scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnosis/radio/causes/place_moves.hpp"
#include "muster/random.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;

// Rows with links across the object score 1, others -1; the gain of a set is that of its mean.
class Scored : public inference::Tally {
 public:
  explicit Scored(std::vector<double> scores) : scores_(std::move(scores)) {}
  Index rows() const override { return static_cast<Index>(scores_.size()); }
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

using Point = Eigen::Vector2d;

struct Plan {
  MeasurementGeometry survey;
  Links links;

  Plan() {
    survey.east = {0, 12};
    survey.north = {0, 9};
    survey.plan_angle = 0.3;
    const Stream stream(5);
    for (uint64_t k = 0; k < 3000; ++k) {
      const double radio = k % 3 == 0 ? 0.5 : k % 3 == 1 ? 11 : 6;
      links.push_back({radio, k % 3 == 2 ? 8.5 : 1, 12 * stream.uniform(k, 0), 9 * stream.uniform(k, 1)});
    }
  }

  // One link a row.
  ReadingLinks readings() const {
    std::vector<std::size_t> first(links.size() + 1);
    std::iota(first.begin(), first.end(), 0);
    return {links, std::move(first)};
  }

  template <class Meets>
  Scored scored(const Meets& meets) const {
    std::vector<double> scores;
    for (const auto& [ax, ay, bx, by] : links) scores.push_back(meets({ax, ay}, {bx, by}) ? 1 : -1);
    return Scored(std::move(scores));
  }
};

bool meets_segment(const Point& a, const Point& b, const Point& from, const Point& to) {
  const auto is_left = [](const Point& p, const Point& q, const Point& at) {
    const Point along = q - p, aside = at - p;
    return along.x() * aside.y() - along.y() * aside.x() > 0;
  };
  return is_left(a, b, from) != is_left(a, b, to) && is_left(from, to, a) != is_left(from, to, b);
}

struct Ends {
  Point from, to;
};

Ends ends_of(const Eigen::VectorXd& theta) {
  const Point middle = theta.segment<2>(1), half = theta[3] / 2 * Point(std::cos(theta[4]), std::sin(theta[4]));
  return {middle - half, middle + half};
}

TEST(SpatialScan, FindsASegment) {
  Plan plan;
  const Point middle(6, 4), half = 1.1 * Point(std::cos(0.4), std::sin(0.4));
  Scored tally =
      plan.scored([&](const Point& a, const Point& b) { return meets_segment(a, b, middle - half, middle + half); });
  const auto swept = SegmentScan(plan.survey, plan.links, plan.readings())(tally);
  ASSERT_FALSE(swept.empty());
  const Ends found = ends_of(swept[0]);
  EXPECT_LT(std::min((found.from - middle + half).norm(), (found.from - middle - half).norm()), 0.5);
  EXPECT_LT(std::min((found.to - middle + half).norm(), (found.to - middle - half).norm()), 0.5);
}

TEST(SpatialScan, ExcludesSegmentsThatWereDrivenAcross) {
  Plan plan;
  const Point middle(6, 4), half = 1.1 * Point(std::cos(0.4), std::sin(0.4));
  for (int y = 2; y < 7; ++y) plan.survey.ways.push_back({6.0, 1.0 * y, 6.0, y + 1.0});
  Scored tally =
      plan.scored([&](const Point& a, const Point& b) { return meets_segment(a, b, middle - half, middle + half); });
  const auto swept = SegmentScan(plan.survey, plan.links, plan.readings())(tally);
  ASSERT_FALSE(swept.empty());
  for (const Eigen::VectorXd& theta : swept) {
    const Ends e = ends_of(theta);
    EXPECT_FALSE(meets_segment({6, 2}, {6, 7}, e.from, e.to)) << theta.transpose();
  }
}

TEST(SpatialScan, CountsWaysAcrossASegmentAndThroughADisk) {
  MeasurementGeometry survey;
  const Stream stream(7);
  for (uint64_t k = 0; k < 2000; ++k) {
    const double x = 12 * stream.uniform(k, 0), y = 9 * stream.uniform(k, 1), to = 7 * stream.uniform(k, 2);
    survey.ways.push_back({x, y, x + 0.7 * std::cos(to), y + 0.7 * std::sin(to)});
  }
  std::sort(survey.ways.begin(), survey.ways.end());
  int across = 0, clear = 0;
  for (uint64_t k = 0; k < 300; ++k) {
    Eigen::VectorXd theta(5);
    theta << 0, 14 * stream.uniform(k, 3) - 1, 9 * stream.uniform(k, 4), 3 * stream.uniform(k, 5),
        6 * stream.uniform(k, 6);
    const Ends e = ends_of(theta);
    const auto crossed = std::count_if(survey.ways.begin(), survey.ways.end(), [&](const auto& w) {
      return meets_segment({w[0], w[1]}, {w[2], w[3]}, e.from, e.to);
    });
    ASSERT_EQ(driven_across(survey, theta[1], theta[2], theta[3], theta[4]), crossed) << theta.transpose();
    const double radius = theta[3] / 3;
    const bool through = std::any_of(survey.ways.begin(), survey.ways.end(), [&](const auto& w) {
      const Point at(theta[1], theta[2]), from(w[0], w[1]), to(w[2], w[3]), way = to - from;
      const bool beside = way.dot(at - from) > 0 && way.dot(to - at) > 0;
      if (way.norm() > std::sqrt(2) * radius) return (at - from).norm() < 0.7 * radius;
      const double aside = std::abs(way.x() * (at - from).y() - way.y() * (at - from).x()) / way.norm();
      return (beside ? aside : std::min((at - from).norm(), (at - to).norm())) < 0.7 * radius;
    });
    ASSERT_EQ(driven_through(survey, theta[1], theta[2], radius), through) << theta.transpose();
    across += static_cast<int>(crossed);
    clear += !through;
  }
  EXPECT_GT(across, 300);
  EXPECT_GT(clear, 20);
  EXPECT_LT(clear, 270);
}

// Scores of links through a disk of this radius at the place.
Scored of_a_disk(const Plan& plan, const Point& at, double radius) {
  return plan.scored([=](const Point& a, const Point& b) {
    const Point way = b - a;
    const double share = std::clamp((at - a).dot(way) / way.squaredNorm(), 0.0, 1.0);
    return (a + share * way - at).norm() < radius;
  });
}

TEST(SpatialScan, FindsADisk) {
  Plan plan;
  plan.survey.ways.push_back({2, 2, 2.1, 2});
  Scored tally = of_a_disk(plan, Point(7.3, 5.1), 0.5);
  const auto swept = DiskScan(plan.survey, plan.links)(tally);
  ASSERT_FALSE(swept.empty());
  EXPECT_NEAR(swept[0][1], 7.3, 0.08);
  EXPECT_NEAR(swept[0][2], 5.1, 0.08);
  EXPECT_NEAR(std::exp(swept[0][3]), 0.5, 0.08);
}

TEST(SpatialScan, ExcludesDisksThatWereDrivenThrough) {
  Plan plan;
  for (double x = 6.8; x < 7.8; x += 0.05) plan.survey.ways.push_back({x, 5.2, x + 0.05, 5.2});
  Scored tally = of_a_disk(plan, Point(7.3, 5.1), 0.5);
  const auto swept = DiskScan(plan.survey, plan.links)(tally);
  ASSERT_FALSE(swept.empty());
  for (const Eigen::VectorXd& theta : swept)
    EXPECT_FALSE(driven_through(plan.survey, theta[1], theta[2], std::exp(theta[3]))) << theta.transpose();
}

// Bearing of an edge of the disk's shadow from a radio, rad.
double edge(const Eigen::VectorXd& theta, const Point& radio, double side) {
  const Point to = theta.segment<2>(1) - radio;
  return std::atan2(to.y(), to.x()) + side * std::asin(std::exp(theta[3]) / to.norm());
}

TEST(MovesOfDisk, TurnOneEdgeOfItsShadowAlone) {
  MeasurementGeometry survey;
  survey.standing = {{0, 0}, {9, 1}, {40, 40}};
  Eigen::VectorXd theta(4);
  theta << 0, 4, 3, std::log(0.5);
  const Eigen::MatrixXd moves = moves_of_disk(survey, theta);
  ASSERT_EQ(moves.cols(), 3 + 2 * 3);  // the two nearby radios
  constexpr double little = 1e-5;
  for (int k = 0; k < 2; ++k) {
    const Point radio = k == 0 ? Point(0, 0) : Point(9, 1);
    const auto turned = [&](Index move, double side) {
      return std::abs(edge(theta + little * moves.col(move), radio, side) - edge(theta, radio, side)) / little;
    };
    const Index first = 3 + 3 * k;
    EXPECT_GT(turned(first, 1), 0.03);
    EXPECT_LT(turned(first, -1), 0.02 * turned(first, 1));
    EXPECT_GT(turned(first + 1, -1), 0.03);
    EXPECT_LT(turned(first + 1, 1), 0.02 * turned(first + 1, -1));
    for (const double side : {1.0, -1.0}) EXPECT_LT(turned(first + 2, side), 1e-4) << "away";
    EXPECT_GT(moves.col(first + 2).segment<2>(1).norm(), 0.5);
  }
}

TEST(SpatialScan, RejectsATallyOfOtherRows) {
  const Plan plan;
  Scored fewer(std::vector<double>(10, 1));
  EXPECT_THROW(SegmentScan(plan.survey, plan.links, plan.readings())(fewer), std::logic_error);
  EXPECT_THROW(DiskScan(plan.survey, plan.links)(fewer), std::logic_error);
}

}  // namespace
}  // namespace muster::diagnosis
