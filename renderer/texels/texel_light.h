// The direct light of each emitter at each texel, per unit of its brightness, so that brightness
// and colour need no ray.
#pragma once

#include <vector>

#include "renderer/sampling/vpl_set.h"
#include "renderer/texels/texel_sky.h"

namespace lamplighter {

class TexelLight {
 public:
  // Forgets everything.
  void restart() { *this = {}; }
  // When the objects that moved rest: what does not meet them stays. `haveTexelsMoved`: not only
  // area lights moved.
  void outdate(const TexelMoves& moves, bool haveTexelsMoved);
  // `withoutSurfaces`: something else has the light of area lights and surfaces that emit.
  // Finds the light of emitters that are new, or that moved, about `most` rays at a time; until
  // then a texel keeps the old light. Returns the number of rays. `movedObjects`: since the last
  // call.
  uint64_t update(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
                  const TexelSet& texels, std::span<const uint32_t> movedObjects, uint32_t seed,
                  uint64_t most, bool withoutSurfaces = false);
  // Finds the light of the sky without its suns; tests about `most` directions. Returns their
  // number.
  uint64_t updateSky(const RenderScene& scene, const LightSet& lights, const TexelSet& texels,
                     const TexelSky::Open& isOpen, uint64_t most);
  bool isDone() const;
  // Whether the last update() or updateSky() found other light.
  bool changed() const { return changed_; }
  // Irradiance of the texels with the present brightness [W/m²].
  void sum(const LightSet& lights, std::vector<vec3>& out) const;
  size_t bytes() const;

 private:
  // When the texels of a column were found: when objects rested; since its light moved, with which
  // nothing else did; or some before and some after another move.
  enum class Since : uint8_t { rest, move, mixed };
  struct Column {
    VplId id;
    RenderPunctual light;  // without its brightness; of punctual lights
    // Texels whose light is that of now: `known` ones from `first` on, and round to the beginning.
    // The next search begins where the last one ended, so that no texel waits while a light moves.
    size_t first = 0, known = 0;
    bool isKept = false;  // all were known before moves_: those that these do not meet stay
    Since since = Since::rest;
    std::vector<vec3> factors;  // by texel
  };
  std::vector<Column> columns_;  // by emitter
  TexelMoves moves_;             // of columns that are kept
  TexelSky seenSky_;
  Sky sky_;                     // at unit brightness
  std::vector<vec3> skyLight_;  // by texel
  bool changed_ = false;
};

}  // namespace lamplighter
