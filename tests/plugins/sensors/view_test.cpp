// A camera's picture against rays that are cast one by one, and against closed forms.
#include "plugins/sensors/view.hpp"

#include <gtest/gtest.h>

#include <random>

#include "plugins/sensors/ray.hpp"

namespace {

using namespace muster;
using description::Box;
using description::Shape;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double infinite = std::numeric_limits<double>::infinity();

Shape shape_at(const Vector3d& at, double yaw, const decltype(Shape::geometry)& geometry) {
  Shape shape;
  shape.pose = Eigen::Translation3d(at) * Eigen::AngleAxisd(yaw, Vector3d::UnitZ());
  shape.geometry = geometry;
  return shape;
}

struct Scene {
  std::vector<Shape> shapes;
  std::vector<Facets> facets;
  void add(const Shape& shape, const Colour& colour = {1, 1, 1}) {
    shapes.push_back(shape);
    facets.push_back(facets_of(shape, colour));
  }
  std::vector<Seen> seen() const {
    std::vector<Seen> result;
    for (const Facets& each : facets) result.push_back({&each, Isometry3d::Identity()});
    return result;
  }
};

Isometry3d camera_at(const Vector3d& at, double yaw = 0, double pitch = 0, double roll = 0) {
  return Eigen::Translation3d(at) * Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch, Vector3d::UnitY()) * Eigen::AngleAxisd(roll, Vector3d::UnitX());
}

// Depth by casting the ray of one pixel.
double cast(const Scene& scene, const Isometry3d& camera, int x, int y, int width, int height, double angle) {
  const double focal = width / 2.0 / std::tan(angle / 2);
  const Vector3d way =
      camera.linear() * Vector3d(1, -(x - (width - 1) / 2.0) / focal, -(y - (height - 1) / 2.0) / focal);
  double nearest = way.z() < 0 ? camera.translation().z() / -way.z() : infinite;
  for (const Shape& shape : scene.shapes) {
    const Isometry3d back = shape.pose.inverse();
    const Ray ray{back * camera.translation(), (back.linear() * way).normalized()};
    std::visit([&](const auto& geometry) { nearest = std::min(nearest, entry(ray, geometry) / way.norm()); },
               shape.geometry);
  }
  return nearest;
}

TEST(View, DepthIsThatOfRaysInEveryPixel) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(-8, 8), angle(-3, 3), size(0.1, 2);
  const int width = 96, height = 64;
  int other = 0, compared = 0;
  for (int n = 0; n < 30; ++n) {
    Scene scene;
    for (int i = 0; i < 25; ++i) {
      const Vector3d edges(size(random), size(random), size(random));
      const Vector3d at(place(random), place(random), edges.z() / 2 + std::abs(place(random)) / 8);
      if (at.norm() < 2.5) continue;
      scene.add(shape_at(at, angle(random), Box{edges}));
    }
    const Isometry3d camera = camera_at({0, 0, 0.7}, angle(random), 0.2 * angle(random), 0.2 * angle(random));
    View view(width, height, 1.3);
    view.look(camera, scene.seen(), {});
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double expected = cast(scene, camera, x, y, width, height, 1.3), depth = view.depth(x, y);
        ++compared;
        const bool same = std::isinf(expected) ? std::isinf(depth) || depth > 1e4
                                               : std::abs(depth - expected) <= 1e-9 * std::max(1.0, expected);
        if (!same && !(expected > 1e4)) ++other;
      }
    }
  }
  EXPECT_LE(other, compared / 50000) << "rays that graze an edge to the last bit";
}

// Cylinders and spheres have flat sides: at 24 of them they are at most 0.9 % of the radius inside.
TEST(View, RoundThingsAreRoundEnough) {
  Scene scene;
  scene.add(shape_at({4, 0, 1}, 0, description::Cylinder{0.5, 2}));
  scene.add(shape_at({4, 2, 1}, 0, description::Sphere{0.5}));
  const Isometry3d camera = camera_at({0, 0, 1});
  View view(160, 120, 1.2);
  view.look(camera, scene.seen(), {});
  int hits = 0, off = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const double expected = cast(scene, camera, x, y, 160, 120, 1.2), depth = view.depth(x, y);
      if (expected > 4.3 || depth > 4.3) continue;
      ++hits;
      off += std::abs(depth - expected) > 0.02;
    }
  }
  EXPECT_GT(hits, 1000);
  EXPECT_LT(off, hits / 20);  // at their limbs
}

// A sheet of many triangles whose corners lie anywhere: no pixel between two of them is missed.
TEST(View, NoPixelIsMissedBetweenFacets) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> off(-0.45, 0.45);
  description::Mesh mesh;
  const int n = 12, middle = n / 2;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const bool edge = i == 0 || j == 0 || i == n || j == n;
      mesh.vertices.emplace_back(3 + 0.2 * off(random), i - middle + (edge ? 0 : off(random)),
                                 j - middle + 1 + (edge ? 0 : off(random)));
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      mesh.faces.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  Scene scene;
  scene.add(shape_at({0, 0, 0}, 0, mesh));
  for (int turn = 0; turn < 20; ++turn) {
    View view(200, 150, 1.0);
    view.look(camera_at({0, 0.01 * turn, 1}, 0.02 * turn, 0.01 * turn, 0.05 * turn), scene.seen(), {});
    for (int y = 0; y < 150; ++y) {
      for (int x = 0; x < 200; ++x) ASSERT_LT(view.depth(x, y), 8) << x << ' ' << y;
    }
  }
}

TEST(View, AMarkersBearingIsRightToAPixel) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> angle(-0.5, 0.5), range(1.5, 9);
  for (int n = 0; n < 200; ++n) {
    const double bearing = angle(random), away = range(random);
    Scene scene;
    scene.add(shape_at({10, 0, 1}, 0, Box{{0.1, 40, 2}}), {0.7f, 0.7f, 0.7f});
    scene.add(shape_at({away * std::cos(bearing), away * std::sin(bearing), 1}, bearing, Box{{0.05, 0.2, 0.2}}),
              {0.9f, 0.05f, 0.05f});
    View view(320, 240, 1.2);
    view.look(camera_at({0, 0, 1}), scene.seen(), {.sun = {-0.6, 0, 0.8}});
    double sum = 0, count = 0;
    for (int y = 0; y < 240; ++y) {
      for (int x = 0; x < 320; ++x) {
        const Colour seen = view.colour(x, y);
        if (seen.red > 4 * seen.green) sum += x, ++count;
      }
    }
    ASSERT_GT(count, 0);
    const double focal = 160 / std::tan(0.6), told = std::atan((159.5 - sum / count) / focal);
    EXPECT_NEAR(told, bearing, 1 / focal) << away;
  }
}

// A post 2 m high under a sun at 45 degrees: its shadow is 2 m long, and as wide as the post.
TEST(View, AShadowIsWhereTheSunPutsIt) {
  Scene scene;
  scene.add(shape_at({6, 0, 1}, 0, Box{{0.3, 0.3, 2}}));
  const double root = std::sqrt(0.5);
  const Isometry3d camera = camera_at({6, 0, 12}, 0, 1.5707963);  // straight down: up in the picture is x
  View view(400, 400, 0.8);
  const Light light{.sun = {0, -root, root}, .ambient = 0.4};
  view.look(camera, scene.seen(), light);
  const double focal = 200 / std::tan(0.4), texel = 1.5 * light.shadows / 512;
  const float lit = view.colour(10, 10).red;
  int dark = 0;
  for (int v = 0; v < 400; ++v) {
    for (int u = 0; u < 400; ++u) {
      const double x = 6 - (v - 199.5) / focal * 12, y = -(u - 199.5) / focal * 12;  // on the ground
      const double inside = std::min({y - 0.15, 0.15 + 2 - y, 0.15 - std::abs(x - 6)});
      const bool on_post = std::abs(x - 6) < 0.2 && std::abs(y) < 0.2;
      if (on_post || std::abs(inside) < 2 * texel + 0.01) continue;
      const bool is_dark = view.colour(u, v).red < 0.8f * lit;
      EXPECT_EQ(is_dark, inside > 0) << x << ' ' << y;
      dark += is_dark;
    }
  }
  EXPECT_GT(dark, 300);
}

TEST(View, FogTakesColoursIntoTheSkysAndLambertDarkensThem) {
  Scene scene;
  scene.add(shape_at({5.05, 0, 1}, 0, Box{{0.1, 30, 10}}), {0.8f, 0.4f, 0.2f});
  const double towards = 0.6;
  const Light light{.sun = {-towards, 0, 0.8}, .ambient = 0.3, .fog = 0.1, .shadows = 0};
  View view(101, 81, 1.0);
  view.look(camera_at({0, 0, 3}), scene.seen(), light);
  const double focal = 50.5 / std::tan(0.5);
  for (const int x : {10, 50, 90}) {
    const double distance = 5 * std::hypot(1, (x - 50) / focal), clear = std::exp(-0.1 * distance);
    const double bright = 0.3 + 0.7 * towards;
    EXPECT_NEAR(view.colour(x, 40).red, clear * bright * 0.8 + (1 - clear) * light.sky.red, 1e-6);
    EXPECT_NEAR(view.colour(x, 40).blue, clear * bright * 0.2 + (1 - clear) * light.sky.blue, 1e-6);
  }
}

TEST(View, TheHorizonIsAtTheHeightOfTheCamera) {
  View view(64, 48, 1.0);
  view.look(camera_at({0, 0, 2}), {}, {});
  for (int x = 0; x < 64; ++x) {
    EXPECT_TRUE(std::isinf(view.depth(x, 23)));
    EXPECT_NEAR(view.depth(x, 24), 2 / (0.5 / (32 / std::tan(0.5))), 1e-6);
  }
}

}  // namespace
