// Many triangles in Embree's scene, against separate tests of each, and against walls.
#include <gtest/gtest.h>

#include <thread>

#include "drawn.hpp"
#include "radio_meshes/mesh_scene.hpp"
#include "scene/lattice.hpp"
#include "scene/walls.hpp"

namespace muster {
namespace {

std::vector<int> by_scene(const MeshScene& scene, std::size_t meshes, const Vector& p, const Vector& q) {
  std::vector<int> result(meshes);
  scene.count(p, q, result.data());
  return result;
}

std::vector<int> one_by_one(const std::vector<PlacedMesh>& meshes, const Vector& p, const Vector& q) {
  std::vector<int> result(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    for (const Triangle& t : meshes[i].triangles) result[i] += t.is_crossed(p, q);
  }
  return result;
}

// Embree may neither miss a crossed triangle, nor report one twice: on a small lattice where links run along edges and
// through corners, and over the whole kilometre.
TEST(MeshScene, MissesNoTriangleAndCountsNoneTwice) {
  Drawing drawing(5);
  for (const auto& [places, step] :
       std::vector<std::pair<std::int64_t, std::int64_t>>{{8, 4096}, {8, 1}, {1 << 21, 3}}) {
    std::vector<PlacedMesh> meshes(3);
    const auto centred = [&] {
      Vector p = drawing.point(places, step);
      return places > 8 ? p - Vector{3 << 20, 3 << 20, 3 << 20} : p;
    };
    for (int i = 0; i < 600; ++i) meshes[i % 3].triangles.push_back({centred(), centred(), centred()});
    const MeshScene scene(meshes);
    long crossed = 0;
    for (int i = 0; i < 8000; ++i) {
      const Vector p = centred(), q = centred();
      const auto expected = one_by_one(meshes, p, q);
      ASSERT_EQ(by_scene(scene, 3, p, q), expected) << places;
      ASSERT_EQ(by_scene(scene, 3, q, p), expected) << places;
      for (const int each : expected) crossed += each;
    }
    EXPECT_GT(crossed, 8000) << places;
  }
}

// A wall as two triangles: the same counts in every degenerate case.
TEST(MeshScene, CountsUprightSheetsAsWallsAreCounted) {
  Drawing drawing(6);
  constexpr double metre = scene::steps_per_metre;
  for (int building = 0; building < 60; ++building) {
    std::vector<scene::Wall> walls;
    std::vector<PlacedMesh> meshes(1);
    while (walls.size() < 12) {
      const Vector a = drawing.point(8, 1), b = drawing.point(8, 1);
      if (a.x == b.x && a.y == b.y) continue;
      const std::int64_t low = a.z / 2, high = low + 1 + b.z / 2;
      walls.push_back({static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(b.x),
                       static_cast<double>(b.y), static_cast<double>(low), static_cast<double>(high - low), 0.1, 0});
      const auto at = [&](const Vector& p, std::int64_t z) {
        return Vector{p.x * 4096, p.y * 4096, z * static_cast<std::int64_t>(metre)};
      };
      meshes[0].triangles.push_back({at(a, low), at(b, low), at(b, high)});
      meshes[0].triangles.push_back({at(a, low), at(b, high), at(a, high)});
    }
    const scene::Scene as_walls(walls, {}, 1);
    const MeshScene as_meshes(meshes);
    for (int i = 0; i < 2000; ++i) {
      const Vector p = drawing.point(8, 4096), q = drawing.point(8, 4096);
      int expected = 0;
      const auto metres = [](const Vector& v) -> scene::Point {
        return {static_cast<double>(v.x) / metre, static_cast<double>(v.y) / metre, static_cast<double>(v.z) / metre};
      };
      as_walls.counts(metres(p), metres(q), &expected);
      ASSERT_EQ(by_scene(as_meshes, 1, p, q)[0], expected);
    }
  }
}

TEST(MeshScene, IsReadFromManyThreadsAlike) {
  Drawing drawing(7);
  std::vector<PlacedMesh> meshes(1);
  for (int i = 0; i < 400; ++i) meshes[0].triangles.push_back(drawing.triangle(8, 4096));
  const MeshScene scene(meshes);
  std::vector<std::pair<Vector, Vector>> links;
  for (int i = 0; i < 4000; ++i) links.push_back({drawing.point(8, 4096), drawing.point(8, 4096)});
  std::vector<std::vector<int>> found(3);
  std::vector<std::thread> threads;
  for (auto& counts : found) {
    threads.emplace_back([&] {
      for (const auto& [p, q] : links) counts.push_back(by_scene(scene, 1, p, q)[0]);
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(found[0], found[1]);
  EXPECT_EQ(found[0], found[2]);
}

TEST(MeshScene, OfNothingIsNotCrossed) {
  const MeshScene scene({});
  int none = 0;
  scene.count({0, 0, 0}, {4096, 0, 0}, &none);
  EXPECT_EQ(none, 0);
}

}  // namespace
}  // namespace muster
