// Elements that another surface cuts, such as a floor under a thin wall: light from one side of it
// must not reach the other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/surface_light/surface_mesh.h"

namespace lamplighter {

class CutLeaves {
 public:
  // Tests all elements, or those that were or are near a moved object: `boxes` are the bounds of
  // moved objects before and after. Returns the number of rays.
  uint64_t update(const RenderScene& scene, const RayCaster& rays, const SurfaceMesh& mesh,
                  bool isNewMesh, std::span<const uint32_t> movedObjects,
                  std::span<const Bounds> boxes);

  // Whether the last update may have changed the result of keepVisible() for an element.
  bool mayDiffer(uint32_t leaf) const { return mayDiffer_[leaf] != 0; }
  // Size of the largest of these elements [m], if only some were tested.
  float largestChanged() const { return largestChanged_; }
  bool isCut(uint32_t leaf) const { return isCut_[leaf] != 0; }
  // Sets the weights of those corners of a cut element to 0 that are not visible from the place
  // (world space). If none is visible, the weights do not change.
  void keepVisible(const RenderScene& scene, const RayCaster& rays, const SurfaceMesh& mesh,
                   const vec3& place, uint32_t leaf, vec3& weights) const;
  size_t bytes() const { return isCut_.size() + mayDiffer_.size(); }

 private:
  std::vector<uint8_t> isCut_, mayDiffer_;  // by element
  float largestChanged_ = 0.0f;
};

}  // namespace lamplighter
