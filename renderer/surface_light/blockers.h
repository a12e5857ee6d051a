// The triangles that may stand between a point and a flat light.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "renderer/patches/bounds_tree.h"
#include "renderer/surface_light/surface_mesh.h"
#include "renderer/surface_light/visible_places.h"

namespace lamplighter {

class Blockers {
 public:
  // Finds the triangles again of all objects, or of those that moved.
  void update(const RenderScene& scene, bool isNew, std::span<const uint32_t> movedObjects);

  enum class Found { none, some, tooMany };  // tooMany: rays decide
  // The triangles that may hide places of the light from x, above the plane of its unit normal n.
  // Conservative: `none` means that nothing is between. Surfaces with alpha masks, and more than
  // kMost triangles, are too many.
  static constexpr size_t kMost = 16;
  Found find(const RenderScene& scene, const FlatLight& light, const vec3& x, const vec3& n,
             std::vector<std::array<vec3, 3>>& out, size_t most = kMost) const;

 private:
  std::vector<BoundsTree> triangles_;  // by object
  BoundsTree objects_;
};

// The share of the light of a flat light that a spot sees, found by a mask.
struct MaskedShare {
  float share = 1.0f;
  bool isOpen = true;  // nothing is between
};
// None if there are too many blockers, so that rays must decide.
std::optional<MaskedShare> maskedShare(const RenderScene& scene, const Blockers& blockers,
                                       const FlatLight& light, const SurfaceSpot& spot,
                                       size_t mostBlockers = Blockers::kMost);

}  // namespace lamplighter
