// The triangles that may block the light of a flat light at a point.
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
  // Collects the triangles of all objects (`isNew`), or only of those that moved.
  void update(const RenderScene& scene, bool isNew, std::span<const uint32_t> movedObjects);

  enum class Found { none, some, tooMany };  // tooMany: use rays instead
  // The triangles that may hide parts of the light from x, above the plane with unit normal n.
  // Conservative: `none` means that nothing blocks the light. Returns tooMany for surfaces with
  // alpha masks and for more than `most` triangles.
  static constexpr size_t kMost = 16;
  Found find(const RenderScene& scene, const FlatLight& light, const vec3& x, const vec3& n,
             std::vector<std::array<vec3, 3>>& out, size_t most = kMost) const;

 private:
  std::vector<BoundsTree> triangles_;  // by object
  BoundsTree objects_;
};

// The visible share of a flat light from a spot, computed with a bit mask.
struct MaskedShare {
  float share = 1.0f;
  bool isOpen = true;  // nothing blocks the light
};
// Returns none if there are too many blockers; use rays instead.
std::optional<MaskedShare> maskedShare(const RenderScene& scene, const Blockers& blockers,
                                       const FlatLight& light, const SurfaceSpot& spot,
                                       size_t mostBlockers = Blockers::kMost);

}  // namespace lamplighter
