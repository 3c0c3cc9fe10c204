// The laws of a navigation function: 0 at the goal alone, 1 on every edge, no other minimum, and a way down that meets
// nothing.
#include "plugins/tracking/navigation_function.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <muster/random.hpp>
#include <vector>

namespace muster::tracking {
namespace {

constexpr double pi = 3.14159265358979323846;

struct Room {
  Vector2 goal;
  std::vector<Disc> bounds, obstacles;
  NavigationFunction function(double sharpness) const { return {goal, bounds, obstacles, sharpness}; }
};

// The room of worlds/target_tracking, and others of up to five discs that do not touch, drawn at random. In half of
// them a second bound cuts across, as that of reception does.
Room drawn(uint64_t number) {
  if (number == 0) return {{12, -12}, {{0, 0, 29.6}}, {{-4, 5, 2.4}, {6, -6, 2.9}, {10, 7, 2.4}}};
  const Stream draw = Stream(7).of(number);
  Room room{{0, 0}, {{0, 0, 30}}, {}};
  if (number % 2 == 1) room.bounds.push_back({-20, 0, 15 + 15 * draw.uniform(0, 9)});
  const auto place = [&](uint64_t i, double margin) {
    const Disc& within = room.bounds.back();
    for (uint64_t j = 100;; j += 2) {
      const double radius = within.radius * std::sqrt(draw.uniform(i, j)), angle = 2 * pi * draw.uniform(i, j + 1);
      const Vector2 at{within.x + radius * std::cos(angle), within.y + radius * std::sin(angle)};
      if (NavigationFunction({0, 0}, room.bounds, room.obstacles, 5).room(at) > margin) return at;
    }
  };
  for (uint64_t i = 0; i < 1 + number % 5; ++i) {
    const double radius = 0.5 + 1.5 * draw.uniform(i, 0);
    const Vector2 at = place(i, radius + 1.5);
    room.obstacles.push_back({at.x, at.y, radius});
  }
  room.goal = place(50, 0.5);
  return room;
}
constexpr uint64_t rooms = 24;

Vector2 place_in(const Room& room, uint64_t number, uint64_t i) {
  const Stream draw = Stream(11).of(number);
  for (uint64_t j = 0;; j += 2) {
    const Vector2 at{60 * draw.uniform(i, j) - 30, 60 * draw.uniform(i, j + 1) - 30};
    if (room.function(8).room(at) > 0.05) return at;
  }
}

TEST(NavigationFunctions, AreZeroAtTheGoalAlone) {
  for (uint64_t r = 0; r < rooms; ++r) {
    const Room room = drawn(r);
    const auto phi = room.function(4);
    EXPECT_EQ(phi.value(room.goal), 0);
    for (uint64_t i = 0; i < 50; ++i) EXPECT_GT(phi.value(place_in(room, r, i)), 0);
  }
}

// Towards an edge the odds phi^k / (1 - phi^k) grow as one over the distance from it, so that phi goes to 1 there.
TEST(NavigationFunctions, AreOneOnEveryEdgeAndBelowItInside) {
  for (uint64_t r = 0; r < rooms; ++r) {
    const Room room = drawn(r);
    const auto phi = room.function(4);
    const auto edge = [&](const Disc& d, double away) {
      for (int i = 0; i < 60; ++i) {
        const double angle = 2 * pi * i / 60;
        const auto at = [&](double off) {
          return Vector2{d.x + (d.radius + away * off) * std::cos(angle),
                         d.y + (d.radius + away * off) * std::sin(angle)};
        };
        if (phi.room(at(1e-3)) < 0.9e-3) continue;  // another bound's side
        EXPECT_EQ(phi.value(at(-1e-9)), 1);
        EXPECT_LE(phi.value(at(1e-3)), phi.value(at(1e-6)));
        EXPECT_NEAR(phi.log_odds(at(1e-8)) - phi.log_odds(at(1e-4)), std::log(1e4), 0.01) << "room " << r;
      }
    };
    for (const Disc& d : room.bounds) edge(d, -1);
    for (const Disc& d : room.obstacles) edge(d, 1);
    for (uint64_t i = 0; i < 50; ++i) {
      const Vector2 at = place_in(room, r, i);
      const double odds = std::exp(phi.log_odds(at));
      EXPECT_TRUE(std::isfinite(odds));
      EXPECT_NEAR(std::pow(phi.value(at), 4), odds / (1 + odds), 1e-9);
    }
  }
}

TEST(NavigationFunctions, GradientIsThatOfDifferences) {
  for (uint64_t r = 0; r < rooms; ++r) {
    const Room room = drawn(r);
    for (const double sharpness : {2.0, 4.0}) {
      const auto phi = room.function(sharpness);
      for (uint64_t i = 0; i < 50; ++i) {
        const Vector2 at = place_in(room, r, i);
        constexpr double h = 1e-5;
        const double x = (phi.value({at.x + h, at.y}) - phi.value({at.x - h, at.y})) / (2 * h);
        const double y = (phi.value({at.x, at.y + h}) - phi.value({at.x, at.y - h})) / (2 * h);
        const Vector2 slope = phi.gradient(at);
        EXPECT_NEAR(slope.x, x, 1e-7 + 1e-5 * std::hypot(x, y)) << "room " << r << ", place " << i;
        EXPECT_NEAR(slope.y, y, 1e-7 + 1e-5 * std::hypot(x, y)) << "room " << r << ", place " << i;
        const Vector2 down = phi.downhill(at);
        EXPECT_NEAR(std::hypot(down.x, down.y), 1, 1e-12);
        EXPECT_LE(down.x * slope.x + down.y * slope.y, 0);
      }
    }
  }
}

// Follows the way down in steps of at most `step`, shorter close to edges; returns where it ends.
Vector2 descended(const Room& room, const NavigationFunction& phi, Vector2 at, double& least_room) {
  for (int i = 0; i < 40000 && std::hypot(at.x - room.goal.x, at.y - room.goal.y) > 0.02; ++i) {
    const Vector2 down = phi.downhill(at);
    const double step = std::min({0.02, 0.1 * phi.room(at), 0.5 * std::hypot(at.x - room.goal.x, at.y - room.goal.y)});
    at.x += step * down.x, at.y += step * down.y;
    least_room = std::min(least_room, phi.room(at));
  }
  return at;
}

TEST(NavigationFunctions, TheWayDownEndsAtTheGoalAndMeetsNothing) {
  for (uint64_t r = 0; r < rooms; ++r) {
    const Room room = drawn(r);
    const auto phi = room.function(8);
    for (uint64_t i = 0; i < 25; ++i) {
      double least_room = INFINITY;
      const Vector2 end = descended(room, phi, place_in(room, r, i), least_room);
      EXPECT_LT(std::hypot(end.x - room.goal.x, end.y - room.goal.y), 0.03) << "room " << r << ", start " << i;
      EXPECT_GT(least_room, 0) << "room " << r << ", start " << i;
    }
  }
}

// On a grid of 0.15 m a place is a minimum if none of its eight neighbours is lower, by the odds, with which phi rises.
TEST(NavigationFunctions, HaveOneMinimum) {
  for (const uint64_t r : {0, 1, 2, 5}) {
    const Room room = drawn(r);
    const auto phi = room.function(8);
    int minima = 0;
    constexpr double edge = 0.15;
    for (double x = -30; x <= 30; x += edge) {
      for (double y = -30; y <= 30; y += edge) {
        if (phi.room({x, y}) <= 0.3) continue;
        bool lowest = true;
        for (int dx = -1; lowest && dx <= 1; ++dx) {
          for (int dy = -1; lowest && dy <= 1; ++dy) {
            if (dx != 0 || dy != 0) lowest = phi.log_odds({x, y}) <= phi.log_odds({x + dx * edge, y + dy * edge});
          }
        }
        if (!lowest) continue;
        ++minima;
        EXPECT_LT(std::hypot(x - room.goal.x, y - room.goal.y), edge) << "room " << r << " at " << x << ' ' << y;
      }
    }
    EXPECT_GE(minima, 1);
    EXPECT_LE(minima, 4);  // the goal between up to four places of the grid
  }
}

TEST(PlacesInside, KeepTheirMarginAndStayWhereTheyAre) {
  for (uint64_t r = 0; r < rooms; ++r) {
    const Room room = drawn(r);
    const auto phi = room.function(8);
    const Stream draw = Stream(13).of(r);
    for (uint64_t i = 0; i < 50; ++i) {
      const Vector2 at{100 * draw.uniform(i, 0) - 50, 100 * draw.uniform(i, 1) - 50};
      const Vector2 moved = inside(at, room.bounds, room.obstacles, 0.05);
      EXPECT_GT(phi.room(moved), 0.03) << "room " << r;
      if (phi.room(at) > 0.05) {
        EXPECT_EQ(moved.x, at.x);
        EXPECT_EQ(moved.y, at.y);
      }
    }
  }
}

}  // namespace
}  // namespace muster::tracking
