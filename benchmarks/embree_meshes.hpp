// Triangles as radio.meshes gives them to Embree, met by packets and streams of rays instead of one ray at a time.
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <vector>

#include "plugins/radio_meshes/embree_scene.hpp"
#include "scene/triangle.hpp"

namespace muster::bench {

using scene::Triangle;
using scene::Vector;

struct MeshLink {
  Vector p, q;
  int crossings;
};

class EmbreeMeshes {
 public:
  explicit EmbreeMeshes(const std::vector<Triangle>& triangles) : triangles_(triangles) {
    device_ = rtcNewDevice(nullptr);
    scene_ = scene_of_triangles(device_, triangles_.size(), this, bounds, cross_some);
  }
  EmbreeMeshes(const EmbreeMeshes&) = delete;
  EmbreeMeshes& operator=(const EmbreeMeshes&) = delete;
  ~EmbreeMeshes() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  // Adds to the crossings of each link.
  template <class Packet, std::size_t width, class Cast>
  void count(std::vector<MeshLink>& links, const Cast& cast) const {
    Context context(links.data());
    alignas(64) Packet rays = {};
    alignas(64) int valid[width];
    for (std::size_t first = 0; first < links.size(); first += width) {
      for (std::size_t i = 0; i < width; ++i) {
        const std::size_t number = std::min(first + i, links.size() - 1);
        valid[i] = first + i < links.size() ? -1 : 0;
        const RTCRay ray = ray_of(links[number], number);
        rays.org_x[i] = ray.org_x, rays.org_y[i] = ray.org_y, rays.org_z[i] = ray.org_z;
        rays.dir_x[i] = ray.dir_x, rays.dir_y[i] = ray.dir_y, rays.dir_z[i] = ray.dir_z;
        rays.tfar[i] = ray.tfar, rays.mask[i] = ray.mask, rays.id[i] = ray.id;
      }
      cast(valid, scene_, &context.embree, &rays);
    }
  }

  void count_streams(std::vector<MeshLink>& links) const {
    constexpr std::size_t length = 256;
    Context context(links.data());
    std::vector<RTCRay> rays(length);
    for (std::size_t first = 0; first < links.size(); first += length) {
      const std::size_t number = std::min(length, links.size() - first);
      for (std::size_t i = 0; i < number; ++i) rays[i] = ray_of(links[first + i], first + i);
      rtcOccluded1M(scene_, &context.embree, rays.data(), static_cast<unsigned>(number), sizeof(RTCRay));
    }
  }

 private:
  struct Context {
    RTCIntersectContext embree;
    MeshLink* links;

    explicit Context(MeshLink* all) : links(all) {
      rtcInitIntersectContext(&embree);
      embree.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    }
  };

  static RTCRay ray_of(const MeshLink& link, std::size_t number) {
    RTCRay ray = {};
    ray.org_x = static_cast<float>(link.p.x), ray.dir_x = static_cast<float>(link.q.x - link.p.x);
    ray.org_y = static_cast<float>(link.p.y), ray.dir_y = static_cast<float>(link.q.y - link.p.y);
    ray.org_z = static_cast<float>(link.p.z), ray.dir_z = static_cast<float>(link.q.z - link.p.z);
    ray.tfar = 1, ray.mask = ~0u, ray.id = static_cast<unsigned>(number);
    return ray;
  }

  static void bounds(const RTCBoundsFunctionArguments* asked) {
    constexpr float margin = 8;  // steps, as the plugin has it
    const Triangle& t = static_cast<const EmbreeMeshes*>(asked->geometryUserPtr)->triangles_[asked->primID];
    const auto [low_x, high_x] = std::minmax({t.a.x, t.b.x, t.c.x});
    const auto [low_y, high_y] = std::minmax({t.a.y, t.b.y, t.c.y});
    const auto [low_z, high_z] = std::minmax({t.a.z, t.b.z, t.c.z});
    RTCBounds& box = *asked->bounds_o;
    box.lower_x = static_cast<float>(low_x) - margin, box.upper_x = static_cast<float>(high_x) + margin;
    box.lower_y = static_cast<float>(low_y) - margin, box.upper_y = static_cast<float>(high_y) + margin;
    box.lower_z = static_cast<float>(low_z) - margin, box.upper_z = static_cast<float>(high_z) + margin;
  }

  static void cross_some(const RTCOccludedFunctionNArguments* met) {
    const auto& scene = *static_cast<const EmbreeMeshes*>(met->geometryUserPtr);
    MeshLink* const links = reinterpret_cast<const Context*>(met->context)->links;
    for (unsigned i = 0; i < met->N; ++i) {
      if (met->valid[i] == 0) continue;
      MeshLink& link = links[RTCRayN_id(met->ray, met->N, i)];
      link.crossings += scene.triangles_[met->primID].is_crossed(link.p, link.q);
    }
  }

  const std::vector<Triangle> triangles_;
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace muster::bench
