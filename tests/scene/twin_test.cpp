// The fast predicates against the slow twin, on lattices so small that most links touch a wall's end, post or top.
#include "twin.hpp"

#include <gtest/gtest.h>

#include "adversary.hpp"

namespace muster::scene {
namespace {

std::vector<std::pair<int, int>> wall_and_door(const std::vector<Crossing>& crossings) {
  std::vector<std::pair<int, int>> result;
  for (const Crossing& crossing : crossings) result.emplace_back(crossing.wall, crossing.door);
  return result;
}

TEST(Twin, AgreesOnAMillionLinks) {
  SmallLattice lattice(1);
  std::vector<Crossing> found;
  int through_walls = 0, through_doors = 0;
  for (int building = 0; building < 1000; ++building) {
    const Building drawn(lattice);
    Scene scene(drawn.walls, drawn.doors, materials);
    Twin twin(drawn.walls, drawn.doors);
    for (int link = 0; link < 1000; ++link) {
      if (link == 500) {
        for (std::size_t door = 0; door < drawn.doors.size(); ++door) {
          scene.set_open(static_cast<int>(door), !drawn.doors[door].open);
          twin.set_open(static_cast<int>(door), !drawn.doors[door].open);
        }
      }
      const Point p = lattice.point(), q = lattice.point();
      scene.crossings(p, q, found);
      ASSERT_EQ(wall_and_door(found), twin.crossings(p, q))
          << "building " << building << ", link " << text(p) << text(q);
      std::vector<int> expected(materials, 0);
      for (const Crossing& crossing : found) {
        const int material =
            crossing.door < 0 ? drawn.walls[crossing.wall].material : drawn.doors[crossing.door].material;
        ASSERT_EQ(crossing.material, material);
        ++expected[material];
        ++(crossing.door < 0 ? through_walls : through_doors);
      }
      ASSERT_EQ(counts(scene, p, q), expected);
    }
  }
  EXPECT_GT(through_walls, 500'000);
  EXPECT_GT(through_doors, 20'000);
}

}  // namespace
}  // namespace muster::scene
