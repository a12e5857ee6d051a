// The direct light of each emitter at each texel, per unit of its brightness, so that edits of
// brightness and colour trace no rays.
#pragma once

#include <vector>

#include "renderer/sampling/vpl_set.h"
#include "renderer/texels/texel_sky.h"

namespace lamplighter {

class TexelLight {
 public:
  // Discards all light.
  void restart() { *this = {}; }
  // Call when moved objects have come to rest: light along rays that do not meet them is kept.
  // `haveTexelsMoved`: not only area lights moved.
  void outdate(const TexelMoves& moves, bool haveTexelsMoved);
  // Computes the light of emitters that are new or moved, with up to about `most` rays per call;
  // until then a texel keeps its old light. Returns the number of rays. `movedObjects`: since the
  // last call. `withoutSurfaces`: leaves out area lights and emissive surfaces.
  uint64_t update(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
                  const TexelSet& texels, std::span<const uint32_t> movedObjects, uint32_t seed,
                  uint64_t most, bool withoutSurfaces = false);
  // Computes the light of the sky without suns; tests up to about `most` directions. Returns their
  // number.
  uint64_t updateSky(const RenderScene& scene, const LightSet& lights, const TexelSet& texels,
                     const TexelSky::Open& isOpen, uint64_t most);
  bool isDone() const;
  // Whether the last update() or updateSky() changed the light.
  bool changed() const { return changed_; }
  // Irradiance of the texels with the current brightness of the lights [W/m²].
  void sum(const LightSet& lights, std::vector<vec3>& out) const;
  size_t bytes() const;

 private:
  // When the texels of a column were computed. rest: while objects were at rest. move: since its
  // light moved alone. mixed: some before and some after another move.
  enum class Since : uint8_t { rest, move, mixed };
  struct Column {
    VplId id;
    RenderPunctual light;  // for punctual lights; without brightness
    // Texels that are up to date: `known` of them from `first`, cyclically. The next call continues
    // where the last one ended, so that every texel is updated in turn while a light moves.
    size_t first = 0, known = 0;
    // All were known before moves_; light that moves_ does not meet stays valid.
    bool isKept = false;
    Since since = Since::rest;
    std::vector<vec3> factors;  // by texel
  };
  std::vector<Column> columns_;  // by emitter
  TexelMoves moves_;             // applies to columns with isKept
  TexelSky seenSky_;
  Sky sky_;                     // at unit brightness
  std::vector<vec3> skyLight_;  // by texel
  bool changed_ = false;
};

}  // namespace lamplighter
