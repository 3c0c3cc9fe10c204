// Entry points of rays into solids, by closed forms and by the definition of "inside"; and a fan that tests all rays
// that matter.
#include "plugins/sensors/fan.hpp"

#include <gtest/gtest.h>

#include <muster/random.hpp>

#include "plugins/sensors/sweep.hpp"

namespace muster {
namespace {

using description::Box;
using description::Cylinder;
using description::Laser;
using description::Mesh;
using description::Shape;
using description::Sphere;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double never = std::numeric_limits<double>::infinity();

TEST(Entry, HasClosedForms) {
  const Ray along{{-5, 0.3, 0.2}, Vector3d::UnitX()};
  EXPECT_DOUBLE_EQ(entry(along, Box{{2, 2, 2}}), 4);
  EXPECT_DOUBLE_EQ(entry(along, Sphere{1}), 5 - std::sqrt(1 - 0.09 - 0.04));
  EXPECT_DOUBLE_EQ(entry(along, Cylinder{1, 2}), 5 - std::sqrt(1 - 0.09));
  const Ray down{{0.3, 0.4, 7}, -Vector3d::UnitZ()};
  EXPECT_DOUBLE_EQ(entry(down, Cylinder{1, 2}), 6);
  EXPECT_EQ(entry({{0.8, 0.8, 7}, -Vector3d::UnitZ()}, Cylinder{1, 2}), never);
  EXPECT_EQ(entry({{0.1, 0.1, 0.1}, Vector3d::UnitX()}, Sphere{1}), 0) << "from inside";
  EXPECT_EQ(entry({{3, 0, 0}, Vector3d::UnitX()}, Box{{2, 2, 2}}), never) << "behind it";
  EXPECT_DOUBLE_EQ(entry({{-1, 0, 0}, Vector3d::UnitX()}, Box{{0, 2, 2}}), 1) << "a box without thickness";
}

bool holds(const Box& box, const Vector3d& p) { return (p.cwiseAbs() - box.size / 2).maxCoeff() <= 0; }
bool holds(const Sphere& sphere, const Vector3d& p) { return p.norm() <= sphere.radius; }
bool holds(const Cylinder& cylinder, const Vector3d& p) {
  return p.head<2>().norm() <= cylinder.radius && std::abs(p.z()) <= cylinder.length / 2;
}

class Random {
 public:
  double uniform(double from, double to) { return from + (to - from) * stream_.uniform(0, count_++); }
  Vector3d vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  Isometry3d pose(double size) {
    return Eigen::Translation3d(vector(size)) * Eigen::AngleAxisd(uniform(0, 6.28), vector(1).normalized());
  }

 private:
  Stream stream_{7};
  unsigned count_ = 0;
};

template <class Solid>
void check_entries(Random& random, const Solid& solid) {
  for (int trial = 0; trial < 500; ++trial) {
    const Ray ray{random.vector(2), random.vector(1).normalized()};
    const double at = entry(ray, solid);
    const auto inside = [&](double t) { return holds(solid, ray.from + t * ray.way); };
    for (double t = 0; t < std::min(at - 1e-9, 6.0); t += 0.01) ASSERT_FALSE(inside(t));
    if (at == never) continue;
    EXPECT_TRUE(at == 0 ? inside(0) : inside(at + 1e-9) || inside(at - 1e-9)) << at;
  }
}

TEST(Entry, IsWhereInsideBegins) {
  Random random;
  check_entries(random, Box{{1, 0.4, 1.6}});
  check_entries(random, Sphere{0.7});
  check_entries(random, Cylinder{0.5, 1.2});
}

// A box as its twelve triangles.
Mesh mesh_of(const Box& box) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(box.size.cwiseProduct(Vector3d(i & 1, i >> 1 & 1, i >> 2 & 1)) - box.size / 2);
  for (const auto& q : {std::array<std::uint32_t, 4>{0, 2, 3, 1},
                        {4, 5, 7, 6},
                        {0, 1, 5, 4},
                        {2, 6, 7, 3},
                        {0, 4, 6, 2},
                        {1, 3, 7, 5}}) {
    mesh.faces.push_back({q[0], q[1], q[2]});
    mesh.faces.push_back({q[0], q[2], q[3]});
  }
  return mesh;
}

TEST(Entry, OfAMeshIsThatOfTheBodyItBounds) {
  Random random;
  const Box box{{1, 0.4, 1.6}};
  const Mesh mesh = mesh_of(box);
  for (int trial = 0; trial < 500; ++trial) {
    const Ray ray{2.2 * random.vector(1).normalized(), random.vector(1).normalized()};
    const double exact = entry(ray, box);
    if (exact == never) {
      EXPECT_EQ(entry(ray, mesh), never);
    } else {
      EXPECT_NEAR(entry(ray, mesh), exact, 1e-12);
    }
  }
}

// Each ray tested separately against all solids.
std::vector<double> one_by_one(const Laser& laser, const std::vector<Solid>& solids, const Isometry3d& frame) {
  std::vector<double> ranges;
  for (int i = 0; i < laser.samples; ++i) {
    const double angle = laser.min_angle + i * laser.step();
    ranges.push_back(never);
    for (const Solid& solid : solids) {
      const Isometry3d seen = (frame * solid.shape.pose).inverse();
      const Ray ray{seen.translation(), seen.linear() * Vector3d(std::cos(angle), std::sin(angle), 0)};
      std::visit([&](const auto& geometry) { ranges.back() = std::min(ranges.back(), entry(ray, geometry)); },
                 solid.shape.geometry);
    }
  }
  return ranges;
}

TEST(Fan, AsksAllTheRaysThatMatter) {
  Random random;
  int met = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Laser laser;
    laser.samples = trial % 7 == 0 ? 1 : 181;
    laser.min_angle = laser.max_angle = random.uniform(-6, 3);
    if (laser.samples > 1) laser.max_angle += trial % 5 == 0 ? 6.283185307179586 : random.uniform(0.1, 3);
    std::vector<Solid> solids;
    for (int i = 0; i < 6; ++i) {
      solids.emplace_back(Shape{random.pose(3), Box{{random.uniform(0, 4), 0.1, 2}}});
      solids.emplace_back(Shape{random.pose(3), Sphere{random.uniform(0.1, 1)}});
      solids.emplace_back(Shape{random.pose(3), Cylinder{random.uniform(0.1, 1), 2}});
      solids.emplace_back(Shape{random.pose(3), mesh_of(Box{{1, 0.4, 1.6}})});
    }
    const Isometry3d frame = random.pose(1);
    Fan fan(laser, 100);
    for (const Solid& solid : solids) fan.meet(solid, frame);
    const auto expected = one_by_one(laser, solids, frame);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_EQ(fan.ranges()[i], expected[i]) << "trial " << trial << ", ray " << i;
      met += expected[i] < never;
    }
  }
  EXPECT_GT(met, 20000);
}

TEST(Fan, MeetsNothingBeyondItsRange) {
  Laser laser;
  Fan fan(laser, 2);
  fan.meet(Solid({Isometry3d(Eigen::Translation3d(5, 0, 0)), Sphere{1}}), Isometry3d::Identity());
  EXPECT_EQ(fan.ranges()[0], never);
}

TEST(Fan, MeetsTheGroundWhereItSinks) {
  Laser laser;
  laser.samples = 3;
  laser.min_angle = -0.5;
  laser.max_angle = 0.5;
  Fan fan(laser, 4), level(laser, 4);
  level.meet_ground(0.2, -Vector3d::UnitZ());
  EXPECT_EQ(level.ranges(), std::vector<double>(3, never));
  Fan below(laser, 4);
  below.meet_ground(-0.1, -Vector3d::UnitZ());
  EXPECT_EQ(below.ranges(), std::vector<double>(3, 0.0)) << "it is in the ground";
  const double pitch = 0.3;
  fan.meet_ground(0.2, Vector3d(std::sin(pitch), 0, -std::cos(pitch)));
  EXPECT_NEAR(fan.ranges()[1], 0.2 / std::sin(pitch), 1e-12);
  EXPECT_NEAR(fan.ranges()[0], 0.2 / (std::sin(pitch) * std::cos(0.5)), 1e-12);
}

TEST(ScanUnderWay, IsHeldWholeByItsBytes) {
  const std::string bytes = bytes_of({{1, 0.5, 3, 0, 0, 0, {4, 5}}, {}});
  const std::vector<Sweep> scans = sweeps_of(bytes, 3);
  EXPECT_EQ(scans[0].ranges, (std::vector<double>{4, 5}));
  EXPECT_EQ(scans[2].is_on, 0);
  for (const double rays : {10.0, 1e18, -1.0, std::nan("")}) {
    std::string bad = bytes;
    std::memcpy(bad.data() + 6 * sizeof rays, &rays, sizeof rays);
    EXPECT_THROW(sweeps_of(bad, 2), std::runtime_error) << rays;
  }
}

}  // namespace
}  // namespace muster
