// Interface to irradiance that is stored at texels, independent of the method that computes it.
#pragma once

#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/texels/texel_set.h"

namespace lamplighter {

class TexelIrradiance {
 public:
  virtual ~TexelIrradiance() = default;
  // By texel [W/m²]; empty before the first computation.
  virtual const std::vector<vec3>& irradiance() const = 0;
  // Radiosity of each texel as seen in glossy surfaces, where the mirror counts as a bounce [W/m²].
  virtual const std::vector<vec3>& reflected() const = 0;
  // Radiance of the sky as seen in glossy surfaces [W/(m² sr)]; 0 if something else adds it.
  virtual vec3 skyTowards(const vec3&) const { return vec3(0.0f); }
  virtual const TexelSet& texels() const = 0;
  // Whether the light is complete: equal to that of a new start.
  virtual bool isDone() const = 0;
  // Changes when irradiance() changes.
  virtual uint32_t version() const = 0;
  // Changes when the texels, or which of them are buried, change.
  virtual uint32_t texelVersion() const = 0;
  // The texels around a point of a triangle (world space) that are visible from it, with weights.
  // All weights are 0 if there are none.
  virtual TexelBlend blendAt(const RenderScene& scene, const RayCaster& rays, uint32_t object,
                             uint32_t triangle, bool isBack, const vec3& position) const = 0;
};

}  // namespace lamplighter
