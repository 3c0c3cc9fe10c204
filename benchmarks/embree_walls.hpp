// The same counts by a ray tracer: a quad a wall, and a filter that counts each hit and lets the ray go on.
#pragma once

#include <embree3/rtcore.h>

#include <stdexcept>
#include <vector>

#include "scene/walls.hpp"

namespace muster::bench {

class EmbreeWalls {
 public:
  static constexpr int packet = 16;

  EmbreeWalls(const std::vector<scene::Wall>& walls, int materials) : materials_(materials) {
    device_ = rtcNewDevice("threads=1");
    scene_ = rtcNewScene(device_);
    // Not the highest quality: that splits walls in space and then counts some twice.
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_QUAD);
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), 4 * walls.size()));
    auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4,
                                                                 4 * sizeof(unsigned), walls.size()));
    unsigned number = 0;
    for (const scene::Wall& wall : walls) {
      const double corners[4][3] = {{wall.x0, wall.y0, wall.base},
                                    {wall.x1, wall.y1, wall.base},
                                    {wall.x1, wall.y1, wall.base + wall.height},
                                    {wall.x0, wall.y0, wall.base + wall.height}};
      for (const auto& corner : corners) {
        for (const double metres : corner) *vertex++ = static_cast<float>(metres);
        *index++ = number++;
      }
      material_.push_back(wall.material);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree refused the walls");
  }
  EmbreeWalls(const EmbreeWalls&) = delete;
  EmbreeWalls& operator=(const EmbreeWalls&) = delete;
  ~EmbreeWalls() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  // by_material[link x materials + material], one ray at a time.
  void count(const std::vector<scene::Point>& points, const std::vector<scene::Pair>& links,
             std::vector<int>& by_material) const {
    by_material.assign(links.size() * static_cast<std::size_t>(materials_), 0);
    Context context(*this, by_material.data());
    for (std::size_t i = 0; i < links.size(); ++i) {
      const scene::Point &p = points[links[i].from], &q = points[links[i].to];
      RTCRay ray = {};
      ray.org_x = static_cast<float>(p.x), ray.org_y = static_cast<float>(p.y), ray.org_z = static_cast<float>(p.z);
      ray.dir_x = static_cast<float>(q.x) - ray.org_x, ray.dir_y = static_cast<float>(q.y) - ray.org_y;
      ray.dir_z = static_cast<float>(q.z) - ray.org_z;
      ray.tfar = 1, ray.mask = ~0u, ray.id = static_cast<unsigned>(i);
      rtcOccluded1(scene_, &context.embree, &ray);
    }
  }

  // The same, sixteen rays at a time. Incoherent: packets that are said to be coherent report hits twice.
  void count_packets(const std::vector<scene::Point>& points, const std::vector<scene::Pair>& links,
                     std::vector<int>& by_material) const {
    by_material.assign(links.size() * static_cast<std::size_t>(materials_), 0);
    Context context(*this, by_material.data());
    for (std::size_t first = 0; first < links.size(); first += packet) {
      alignas(64) int valid[packet];
      alignas(64) RTCRay16 ray = {};
      for (std::size_t lane = 0; lane < packet; ++lane) {
        const std::size_t i = first + lane < links.size() ? first + lane : first;
        valid[lane] = first + lane < links.size() ? -1 : 0;
        const scene::Point &p = points[links[i].from], &q = points[links[i].to];
        ray.org_x[lane] = static_cast<float>(p.x), ray.dir_x[lane] = static_cast<float>(q.x) - ray.org_x[lane];
        ray.org_y[lane] = static_cast<float>(p.y), ray.dir_y[lane] = static_cast<float>(q.y) - ray.org_y[lane];
        ray.org_z[lane] = static_cast<float>(p.z), ray.dir_z[lane] = static_cast<float>(q.z) - ray.org_z[lane];
        ray.tfar[lane] = 1, ray.mask[lane] = ~0u, ray.id[lane] = static_cast<unsigned>(i);
      }
      rtcOccluded16(valid, scene_, &context.embree, &ray);
    }
  }

 private:
  struct Context {
    RTCIntersectContext embree;
    const EmbreeWalls& walls;
    int* counts;

    Context(const EmbreeWalls& scene, int* into) : walls(scene), counts(into) {
      rtcInitIntersectContext(&embree);
      embree.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
      embree.filter = count_hit;
    }
  };

  static void count_hit(const RTCFilterFunctionNArguments* hit) {
    const auto& context = *reinterpret_cast<const Context*>(hit->context);
    for (unsigned lane = 0; lane < hit->N; ++lane) {
      if (hit->valid[lane] == 0) continue;
      const unsigned link = RTCRayN_id(hit->ray, hit->N, lane), wall = RTCHitN_primID(hit->hit, hit->N, lane);
      ++context.counts[link * static_cast<unsigned>(context.walls.materials_) +
                       static_cast<unsigned>(context.walls.material_[wall])];
      hit->valid[lane] = 0;
    }
  }

  RTCDevice device_;
  RTCScene scene_;
  std::vector<int> material_;
  int materials_;
};

}  // namespace muster::bench
