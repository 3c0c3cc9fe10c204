// A camera's pictures: depth and shade with shadows, as sensors.camera makes them, against Embree's packets of rays
// with a shadow ray for each hit. Both sides in one run, by the CPU time of this process; depths compared. Counter:
// pictures a second.
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <cmath>
#include <cstring>
#include <muster/random.hpp>
#include <stdexcept>
#include <vector>

#include "cpu_seconds.hpp"
#include "plugins/sensors/view.hpp"

namespace {

using namespace muster;
using bench::cpu_seconds;
using Eigen::Vector3d;

constexpr int width = 320, height = 240, pictures = 60;
constexpr double angle = 1.2;

// 50 walls and 20 small boxes on 40 x 40 m.
std::vector<Facets> boxes() {
  const Stream random(1);
  std::vector<Facets> result;
  for (std::uint64_t i = 0; i < 70; ++i) {
    const bool is_wall = i < 50;
    description::Shape shape;
    shape.pose =
        Eigen::Translation3d(40 * random.uniform(i, 0) - 20, 40 * random.uniform(i, 1) - 20, is_wall ? 1.25 : 0.11) *
        Eigen::AngleAxisd(is_wall ? (i % 2 ? 1.5707963267948966 : 0) : 6 * random.uniform(i, 2), Vector3d::UnitZ());
    shape.geometry = description::Box{is_wall ? Vector3d(6, 0.1, 2.5) : Vector3d(0.2, 0.135, 0.22)};
    result.push_back(facets_of(shape, {0.7f, 0.7f, 0.7f}));
  }
  return result;
}

Eigen::Isometry3d camera(int picture) {
  return Eigen::Translation3d(0, 0, 0.3) * Eigen::AngleAxisd(0.1 * picture, Vector3d::UnitZ());
}

class Peer {
 public:
  explicit Peer(const std::vector<Facets>& all) : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    std::vector<float> corners;
    std::vector<unsigned> indices;
    const auto add = [&](const Vector3d& at) {
      for (int i = 0; i < 3; ++i) corners.push_back(static_cast<float>(at[i]));
    };
    for (const Facets& each : all) {
      const auto first = static_cast<unsigned>(corners.size() / 3);
      for (const Vector3d& at : each.corners) add(at);
      for (const Facet& facet : each.facets)
        for (const unsigned corner : facet.corners) indices.push_back(first + corner);
    }
    const auto ground = static_cast<unsigned>(corners.size() / 3);
    for (const auto& [x, y] : {std::pair(-1e3, -1e3), std::pair(1e3, -1e3), std::pair(1e3, 1e3), std::pair(-1e3, 1e3)})
      add({x, y, 0});
    for (const unsigned corner : {0u, 1u, 2u, 0u, 2u, 3u}) indices.push_back(ground + corner);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    std::memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, corners.size() / 3),
                corners.data(), corners.size() * sizeof(float));
    std::memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, indices.size() / 3),
                indices.data(), indices.size() * sizeof(unsigned));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~Peer() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  // Packets of eight, 4 x 2 pixels.
  void look(const Eigen::Isometry3d& from, const Vector3d& sun, std::vector<float>& depth, std::vector<float>& bright) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    const float focal = static_cast<float>(width / 2.0 / std::tan(angle / 2));
    const Eigen::Matrix3f axes = from.linear().cast<float>();
    const Eigen::Vector3f eye = from.translation().cast<float>(), way = sun.cast<float>();
    for (int y = 0; y < height; y += 2) {
      for (int x = 0; x < width; x += 4) {
        RTCRayHit8 seen;
        alignas(32) int valid[8];
        for (int i = 0; i < 8; ++i) {
          const int column = x + i % 4, row = y + i / 4;
          const float right = (static_cast<float>(column) - (width - 1) / 2.0f) / focal;
          const float down = (static_cast<float>(row) - (height - 1) / 2.0f) / focal;
          const Eigen::Vector3f ray = axes * Eigen::Vector3f(1, -right, -down);
          valid[i] = -1;
          seen.ray.org_x[i] = eye.x(), seen.ray.org_y[i] = eye.y(), seen.ray.org_z[i] = eye.z();
          seen.ray.dir_x[i] = ray.x(), seen.ray.dir_y[i] = ray.y(), seen.ray.dir_z[i] = ray.z();
          seen.ray.tnear[i] = 0, seen.ray.tfar[i] = std::numeric_limits<float>::infinity(), seen.ray.time[i] = 0;
          seen.ray.mask[i] = ~0u, seen.ray.flags[i] = 0;
          seen.hit.geomID[i] = seen.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect8(valid, scene_, &context, &seen);
        RTCRay8 shadow;
        for (int i = 0; i < 8; ++i) {
          const float t = seen.ray.tfar[i];
          valid[i] = seen.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID ? -1 : 0;
          shadow.org_x[i] = eye.x() + t * seen.ray.dir_x[i], shadow.org_y[i] = eye.y() + t * seen.ray.dir_y[i];
          shadow.org_z[i] = eye.z() + t * seen.ray.dir_z[i];
          shadow.dir_x[i] = way.x(), shadow.dir_y[i] = way.y(), shadow.dir_z[i] = way.z();
          shadow.tnear[i] = 1e-3f, shadow.tfar[i] = 1e9f, shadow.time[i] = 0, shadow.mask[i] = ~0u, shadow.flags[i] = 0;
        }
        rtcOccluded8(valid, scene_, &context, &shadow);
        for (int i = 0; i < 8; ++i) {
          const int column = x + i % 4, row = y + i / 4;
          const std::size_t at =
              static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
          const Eigen::Vector3f normal =
              Eigen::Vector3f(seen.hit.Ng_x[i], seen.hit.Ng_y[i], seen.hit.Ng_z[i]).normalized();
          depth[at] = seen.ray.tfar[i];
          bright[at] = valid[i] && shadow.tfar[i] > 0 ? std::abs(normal.dot(way)) : 0;
        }
      }
    }
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

void camera_pictures(benchmark::State& state) {
  const auto facets = boxes();
  std::vector<Seen> scene;
  for (const Facets& each : facets) scene.push_back({&each, Eigen::Isometry3d::Identity()});
  Light light;
  light.sun = Vector3d(0.4, 0.3, 0.866).normalized();
  View view(width, height, angle);
  Peer peer(facets);
  std::vector<float> depth(width * height), bright = depth, peers = depth, peers_bright = depth;
  double own = 0, other = 0;
  for (auto _ : state) {
    std::size_t different = 0;
    for (int n = 0; n < pictures; ++n) {
      double from = cpu_seconds();
      view.look(camera(n), scene, light);
      for (int y = 0, i = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x, ++i) {
          depth[static_cast<std::size_t>(i)] = static_cast<float>(view.depth(x, y));
          const Colour colour = view.colour(x, y);
          bright[static_cast<std::size_t>(i)] = colour.red + colour.green + colour.blue;
        }
      }
      own += cpu_seconds() - from;
      from = cpu_seconds();
      peer.look(camera(n), light.sun, peers, peers_bright);
      other += cpu_seconds() - from;
      for (std::size_t i = 0; i < depth.size(); ++i)
        different += peers[i] < 100 && std::abs(depth[i] - peers[i]) > 1e-3f * peers[i];
    }
    if (different > pictures * depth.size() / 500) throw std::runtime_error("the pictures differ");
    benchmark::DoNotOptimize(bright.data());
  }
  const double all = static_cast<double>(pictures) * static_cast<double>(state.iterations());
  state.counters["pictures/s"] = all / own;
  state.counters["embree pictures/s"] = all / other;
  state.counters["ratio"] = other / own;
}
BENCHMARK(camera_pictures)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
