// The direct light of one emitter on an element, per unit of its brightness.
#pragma once

#include <span>
#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/sampling/vpl_set.h"
#include "renderer/surface_light/surface_mesh.h"
#include "renderer/surface_light/visible_places.h"

namespace lamplighter {

// Light that arrives unless the ray is blocked.
struct LightRay {
  Ray ray;
  vec3 irradiance{0.0f};  // [W/m²] of a white light, per unit of Emitter::brightness()
  uint32_t spot = 0;      // index of the receiving spot
};

// The light with a fixed brightness, to detect whether anything else changed.
RenderPunctual withoutBrightness(RenderPunctual light);

class EmitterFactor {
 public:
  EmitterFactor(const RenderScene& scene, const LightSet& lights, size_t emitter, const VplId& id,
                uint32_t seed);

  // Whether the colour of its light varies over the light, so that it needs a factor per channel.
  bool isColoured() const;
  // False for the sky without suns, whose light is found by gather rays.
  bool isSampled() const { return light_.kind != EmitterKind::sky || light_.skySun > 0; }
  // The light as a flat light with a mask of side `side` (visible_places.h). None if it is not
  // flat, varies in colour, or `side` is 0.
  std::optional<FlatLight> flat(int side) const;
  bool hasClosedForm() const { return !corners_.empty(); }
  // The irradiance of a spot without occlusion, for a light with a closed form; 0 below the
  // surface.
  float unshadowed(const SurfaceSpot& spot) const;
  // Bounds of the light; empty for distant lights.
  const Bounds& bounds() const { return bounds_; }
  // Appends one ray for each spot that the light may reach. `key`: identifies the element, so that
  // neighbouring elements sample different points of the light.
  void raysTo(std::span<const SurfaceSpot> spots, uint32_t leftOutBy, uint32_t key,
              std::vector<LightRay>& out) const;

 private:
  LightRay fromSurface(const SurfaceSpot& spot, const vec2& u) const;
  LightRay fromPunctual(const SurfaceSpot& spot) const;
  LightRay fromSun(const SurfaceSpot& spot, const vec2& u) const;

  const RenderScene& scene_;
  const LightSet& lights_;
  const Emitter& light_;
  int emitter_;
  uint32_t seed_;
  Bounds bounds_;
  std::vector<vec3>
      corners_;  // corners of the triangles of a simple or flat surface, for the closed form
};

}  // namespace lamplighter
