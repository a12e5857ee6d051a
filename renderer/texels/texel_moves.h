// What moves of objects change for texels and for the segments between them.
#pragma once

#include <algorithm>
#include <set>
#include <span>
#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/texels/texel_set.h"

namespace lamplighter {

struct TexelMoves {
  static constexpr uint32_t kNew = 0xffffffffu;
  // The number that each present texel had before. kNew: there was none at its place, or it has
  // been buried since, or is no longer.
  std::vector<uint32_t> formerTexel;
  // The same, also of texels that moved with their object.
  std::vector<uint32_t> sameTexel;
  // Bounds of the objects that moved, came or went: where they were and where they are (world
  // space).
  std::vector<Bounds> boxes;

  // Whether what the ray sees may be something else now.
  bool meets(const Ray& ray) const {
    return std::ranges::any_of(boxes, [&](const Bounds& b) { return mayTouch(ray, b); });
  }
  bool isKept(size_t texel) const {
    return texel < formerTexel.size() && formerTexel[texel] != kNew;
  }
  // Values by former texel, as values by present texel, 0 for those of new objects.
  std::vector<vec3> carried(const std::vector<vec3>& before) const {
    std::vector<vec3> now(sameTexel.size(), vec3(0.0f));
    for (size_t t = 0; t < now.size(); ++t)
      if (sameTexel[t] < before.size()) now[t] = before[sameTexel[t]];
    return now;
  }
};

// Where objects and texels were at some time.
class PlacedTexels {
 public:
  PlacedTexels() = default;
  PlacedTexels(const RenderScene& scene, const TexelSet& texels);
  // `moved`: the objects that moved, came or went since then.
  TexelMoves movesTo(const RenderScene& scene, const TexelSet& texels,
                     const std::set<uint32_t>& moved) const;

 private:
  struct Part {
    uint32_t first = 0, count = 0;
  };
  std::vector<Part> parts_;        // two for each object
  std::vector<uint8_t> isBuried_;  // by texel
  std::vector<Bounds> bounds_;     // by object
};

}  // namespace lamplighter
