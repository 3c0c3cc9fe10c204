// Meshes in the world, and the number of crossings of a straight link with the surface of each. Embree finds candidate
// triangles; scene/triangle.hpp decides each exactly, so the results depend neither on Embree's rounding nor on the
// machine's instructions.
#pragma once

#include <embree3/rtcore.h>

#include <scene/triangle.hpp>
#include <vector>

namespace muster {

using scene::Triangle;
using scene::Vector;

// A mesh in its place, in lattice steps.
struct PlacedMesh {
  std::vector<Triangle> triangles;
};

class MeshScene {
 public:
  // Throws std::runtime_error where Embree fails.
  explicit MeshScene(const std::vector<PlacedMesh>& meshes);
  MeshScene(const MeshScene&) = delete;
  MeshScene& operator=(const MeshScene&) = delete;
  ~MeshScene();

  // Adds to crossings[mesh] for each triangle that the link crosses.
  void count(const Vector& p, const Vector& q, int* crossings) const;

 private:
  static void bounds(const RTCBoundsFunctionArguments* asked);
  static void cross_one(const RTCOccludedFunctionNArguments* met);

  std::vector<Triangle> triangles_;
  std::vector<int> mesh_;  // of a triangle
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace muster
