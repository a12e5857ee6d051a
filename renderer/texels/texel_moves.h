// The effect of moved objects on texels and on the segments between them.
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
  // By current texel: its old number. kNew: there was no texel at this position, or it became or
  // stopped being buried.
  std::vector<uint32_t> formerTexel;
  // The same, but also for texels that moved with their object.
  std::vector<uint32_t> sameTexel;
  // Bounds of the objects that moved, were added or removed, before and after (world space).
  std::vector<Bounds> boxes;

  // Whether the hit of the ray may have changed.
  bool meets(const Ray& ray) const {
    return std::ranges::any_of(boxes, [&](const Bounds& b) { return mayTouch(ray, b); });
  }
  bool isKept(size_t texel) const {
    return texel < formerTexel.size() && formerTexel[texel] != kNew;
  }
  // Maps values by old texel to values by current texel; 0 for texels without an old number.
  std::vector<vec3> carried(const std::vector<vec3>& before) const {
    std::vector<vec3> now(sameTexel.size(), vec3(0.0f));
    for (size_t t = 0; t < now.size(); ++t)
      if (sameTexel[t] < before.size()) now[t] = before[sameTexel[t]];
    return now;
  }
};

// Positions of objects and texels at one point in time.
class PlacedTexels {
 public:
  PlacedTexels() = default;
  PlacedTexels(const RenderScene& scene, const TexelSet& texels);
  // `moved`: the objects that moved, were added or removed since then.
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
