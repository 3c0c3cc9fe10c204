// Refusals of the scene, word for word.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "drawing.hpp"

namespace muster::scene {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string refusal(const std::vector<Wall>& walls, const std::vector<Door>& doors = {}) {
  try {
    const Scene scene(walls, doors, 2);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

Wall shaped(double base, double height, double thickness = 0.1, int material = 0) {
  return {0, 0, 5, 0, base, height, thickness, material};
}

TEST(Refusal, OfAWall) {
  EXPECT_EQ(refusal({shaped(0, 3), wall(0, 0, 1000, 0)}),
            "wall row 1: reaches beyond the scene; expected coordinates within 1000 m");
  EXPECT_EQ(refusal({wall(0, nan, 1, 0)}), "wall row 0: reaches beyond the scene; expected coordinates within 1000 m");
  EXPECT_EQ(refusal({shaped(600, 600)}), "wall row 0: reaches beyond the scene; expected coordinates within 1000 m");
  EXPECT_EQ(refusal({wall(1, 1, 1, 1.0001)}), "wall row 0: has no length; expected ends at least 2^-12 m apart");
  EXPECT_EQ(refusal({shaped(1, 0)}), "wall row 0: has no height; expected at least 2^-12 m");
  EXPECT_EQ(refusal({shaped(1, -1)}), "wall row 0: has no height; expected at least 2^-12 m");
  EXPECT_EQ(refusal({shaped(0, 3, -1)}), "wall row 0: thickness is not a length; expected 0 m to 1000 m");
  EXPECT_EQ(refusal({shaped(0, 3, 0, 2)}), "wall row 0: material row 2 does not exist; expected one of the first 2");
  EXPECT_EQ(refusal({shaped(0, 3, 0, -1)}), "wall row 0: material row -1 does not exist; expected one of the first 2");
}

TEST(Refusal, OfADoor) {
  const std::vector<Wall> walls{shaped(0, 3)};
  EXPECT_EQ(refusal(walls, {{1, 0, 1, 2, 0, false}}), "door row 0: wall row 1 does not exist");
  EXPECT_EQ(refusal(walls, {{-1, 0, 1, 2, 0, false}}), "door row 0: wall row -1 does not exist");
  EXPECT_EQ(refusal(walls, {{0, 0, 1, 2, 5, false}}),
            "door row 0: material row 5 does not exist; expected one of the first 2");
  EXPECT_EQ(refusal(walls, {{0, -1, 1, 2, 0, false}}), "door row 0: begins or ends beyond its wall, wall row 0");
  EXPECT_EQ(refusal(walls, {{0, nan, 1, 2, 0, false}}), "door row 0: begins or ends beyond its wall, wall row 0");
  EXPECT_EQ(refusal(walls, {{0, 4.5, 1, 2, 0, false}}), "door row 0: ends 5.5 m along its wall, which is 5 m long");
  EXPECT_EQ(refusal(walls, {{0, 1, 0, 2, 0, false}}),
            "door row 0: has no width or no height; expected at least 2^-12 m");
  EXPECT_EQ(refusal(walls, {{0, 1, 1, 0, 0, false}}),
            "door row 0: has no width or no height; expected at least 2^-12 m");
  EXPECT_EQ(refusal(walls, {{0, 1, 1, nan, 0, false}}), "door row 0: height is not below 1000 m");
  EXPECT_EQ(refusal(walls, {{0, 1, 1, 2, 0, false}, {0, 1.5, 1, 2, 0, false}}), "door row 1: overlaps door row 0");
  EXPECT_EQ(refusal(walls, {{0, 1, 0.9, 2, 0, false}, {0, 1.9, 0.9, 2, 0, false}}), "accepted");
}

TEST(Refusal, OfARadioOutside) {
  const Scene scene({shaped(0, 3)}, {}, 2);
  try {
    counts(scene, {0, 0, 0}, {120000, 0.5, 0});
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the point 120000 0.5 0 lies beyond the scene; expected coordinates within 100 km");
  }
  EXPECT_THROW(counts(scene, {0, 0, nan}, {1, 0, 0}), std::runtime_error);
}

TEST(Scene, WithoutWallsCountsNothing) {
  const Scene scene({}, {}, 2);
  EXPECT_THAT(counts(scene, {0, 0, 0}, {1, 1, 1}), testing::ElementsAre(0, 0));
}

}  // namespace
}  // namespace muster::scene
