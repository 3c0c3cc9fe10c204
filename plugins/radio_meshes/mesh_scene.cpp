#include "mesh_scene.hpp"

#include <algorithm>
#include <stdexcept>

#include "embree_scene.hpp"

namespace muster {
namespace {

// Context of a ray for the triangles that it may meet.
struct Link {
  RTCIntersectContext embree;  // first: Embree passes its address on
  const Vector *p, *q;
  int* crossings;
};

void count_error(void* failed, RTCError, const char*) { *static_cast<bool*>(failed) = true; }

}  // namespace

MeshScene::MeshScene(const std::vector<PlacedMesh>& meshes) {
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    triangles_.insert(triangles_.end(), meshes[i].triangles.begin(), meshes[i].triangles.end());
    mesh_.resize(triangles_.size(), static_cast<int>(i));
  }
  bool failed = false;
  device_ = rtcNewDevice(nullptr);  // a number of threads would limit the whole process, see TBB
  if (!device_) throw std::runtime_error("Embree does not start on this machine");
  rtcSetDeviceErrorFunction(device_, count_error, &failed);
  scene_ = scene_of_triangles(device_, triangles_.size(), this, bounds, cross_one);
  rtcSetDeviceErrorFunction(device_, nullptr, nullptr);
  if (!failed) return;
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
  throw std::runtime_error("Embree refused the meshes");
}

MeshScene::~MeshScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

void MeshScene::count(const Vector& p, const Vector& q, int* crossings) const {
  // In lattice steps all of these are whole numbers below 2^24, which a float holds exactly.
  RTCRay ray = {};
  ray.org_x = static_cast<float>(p.x), ray.org_y = static_cast<float>(p.y), ray.org_z = static_cast<float>(p.z);
  ray.dir_x = static_cast<float>(q.x - p.x), ray.dir_y = static_cast<float>(q.y - p.y);
  ray.dir_z = static_cast<float>(q.z - p.z);
  ray.tfar = 1, ray.mask = ~0u;
  Link link{{}, &p, &q, crossings};
  rtcInitIntersectContext(&link.embree);
  rtcOccluded1(scene_, &link.embree, &ray);
}

// Wider than the triangle by more than the rounding of a ray's position in a box: 2^-22 of 2^23 steps.
void MeshScene::bounds(const RTCBoundsFunctionArguments* asked) {
  constexpr float margin = 8;
  const Triangle& t = static_cast<const MeshScene*>(asked->geometryUserPtr)->triangles_[asked->primID];
  const auto low = [](std::int64_t a, std::int64_t b, std::int64_t c) {
    return static_cast<float>(std::min({a, b, c})) - margin;
  };
  const auto high = [](std::int64_t a, std::int64_t b, std::int64_t c) {
    return static_cast<float>(std::max({a, b, c})) + margin;
  };
  RTCBounds& box = *asked->bounds_o;
  box.lower_x = low(t.a.x, t.b.x, t.c.x), box.upper_x = high(t.a.x, t.b.x, t.c.x);
  box.lower_y = low(t.a.y, t.b.y, t.c.y), box.upper_y = high(t.a.y, t.b.y, t.c.y);
  box.lower_z = low(t.a.z, t.b.z, t.c.z), box.upper_z = high(t.a.z, t.b.z, t.c.z);
}

// Never reports an occlusion, so the ray continues to all triangles.
void MeshScene::cross_one(const RTCOccludedFunctionNArguments* met) {
  if (met->valid[0] == 0) return;
  const auto& scene = *static_cast<const MeshScene*>(met->geometryUserPtr);
  const Link& link = *reinterpret_cast<const Link*>(met->context);
  if (scene.triangles_[met->primID].is_crossed(*link.p, *link.q)) ++link.crossings[scene.mesh_[met->primID]];
}

}  // namespace muster
