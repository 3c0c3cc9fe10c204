// User-defined triangles as one Embree scene.
#pragma once

#include <embree3/rtcore.h>

#include <cstddef>

namespace muster {

// Both functions receive `owner`. Robust boxes, and not the highest quality, which splits triangles in space: a link
// would meet some twice.
inline RTCScene scene_of_triangles(RTCDevice device, std::size_t count, void* owner, RTCBoundsFunction bounds,
                                   RTCOccludedFunctionN crossed) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(count));
  rtcSetGeometryUserData(geometry, owner);
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcSetGeometryOccludedFunction(geometry, crossed);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

}  // namespace muster
