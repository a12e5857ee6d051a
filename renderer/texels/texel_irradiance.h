// Light that texels of the surface keep, whatever carries it there.
#pragma once

#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/texels/texel_set.h"

namespace lamplighter {

class TexelIrradiance {
 public:
  virtual ~TexelIrradiance() = default;
  // By texel [W/m²]; empty before it is found for the first time.
  virtual const std::vector<vec3>& irradiance() const = 0;
  // What each texel reflects to glossy surfaces that mirror it, which is a bounce, too [W/m²].
  virtual const std::vector<vec3>& reflected() const = 0;
  // The sky that they mirror [W/(m² sr)]; 0 if it is shown by something else.
  virtual vec3 skyTowards(const vec3&) const { return vec3(0.0f); }
  virtual const TexelSet& texels() const = 0;
  // Whether the light is that of a fresh start.
  virtual bool isDone() const = 0;
  // Differs if irradiance() differs.
  virtual uint32_t version() const = 0;
  // Differs if the texels are other ones, or others of them are buried.
  virtual uint32_t texelVersion() const = 0;
  // The texels around a point of a triangle (world space) that it sees. No weights: it has none.
  virtual TexelBlend blendAt(const RenderScene& scene, const RayCaster& rays, uint32_t object,
                             uint32_t triangle, bool isBack, const vec3& position) const = 0;
};

}  // namespace lamplighter
