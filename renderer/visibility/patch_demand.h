// The patches that a view requests from the visibility database.
//
// An entry costs a test of an occlusion pyramid for each light and saves shadow map look-ups at the
// pixels of its patch. So a root needs entries only if it covers enough pixels, and it is divided
// only as far as its parts do. A coarse grid of eye rays counts them: the result depends on the
// scene and the view, not on earlier frames, time or the backend.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/patches/patch_set.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

struct PatchDemand {
  static constexpr uint8_t kAllLevels = 255;

  bool isForAll = true;  // all patches are requested
  // Otherwise, by object and patch: for a root, the number of levels of its tree that may have
  // entries (0: none). Patches that are no roots have 0.
  std::vector<std::vector<uint8_t>> levels;

  // Least number of pixels that a root with this number of levels covers.
  static uint32_t leastPixels(uint8_t levels);
  // Adds the requests of another.
  void add(const PatchDemand& other);
  bool operator==(const PatchDemand&) const = default;
};

// The patches that the view needs. Scenes with few roots need all. `mostRows`: the number of
// patches for whose entries there is memory; the roots with the fewest pixels are omitted.
PatchDemand findPatchDemand(std::span<const ObjectPatches> patches, const RayCaster& rays,
                            const View& view, size_t mostRows);

}  // namespace lamplighter
