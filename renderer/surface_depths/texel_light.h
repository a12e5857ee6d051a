// The direct light of each emitter at each texel, per unit of its brightness, so that brightness
// and colour need no ray.
#pragma once

#include <vector>

#include "renderer/sampling/vpl_set.h"
#include "renderer/surface_depths/surface_depths.h"

namespace lamplighter {

class TexelLight {
 public:
  // Forgets everything.
  void restart() { *this = {}; }
  // Finds the light of emitters that are new, or that moved, about `most` rays at a time; until
  // then a texel keeps the old light. Returns the number of rays. `movedObjects`: since the last
  // call.
  uint64_t update(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
                  const TexelSet& texels, std::span<const uint32_t> movedObjects, uint32_t seed,
                  uint64_t most);
  // The light of the sky without its suns, where the depths of a texel are open.
  void updateSky(const RenderScene& scene, const LightSet& lights, const TexelSet& texels,
                 const SurfaceDepths& depths);
  bool isDone() const;
  // Whether the last update() or updateSky() found other light.
  bool changed() const { return changed_; }
  // Irradiance of the texels with the present brightness [W/m²].
  void sum(const LightSet& lights, std::vector<vec3>& out) const;
  size_t bytes() const;

 private:
  struct Column {
    VplId id;
    RenderPunctual light;  // without its brightness; of punctual lights
    // Texels whose light is that of now: `known` ones from `first` on, and round to the beginning.
    // The next search begins where the last one ended, so that no texel waits while a light moves.
    size_t first = 0, known = 0;
    std::vector<vec3> factors;  // by texel
  };
  std::vector<Column> columns_;  // by emitter
  Sky sky_;                      // at unit brightness
  std::vector<vec3> skyLight_;   // by texel
  bool changed_ = false;
};

}  // namespace lamplighter
