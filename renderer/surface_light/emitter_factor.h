// The direct light that one emitter gives to an element, per unit of its brightness.
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
  uint32_t spot = 0;      // on which it falls
};

// To tell whether anything but the brightness of a light changed.
RenderPunctual withoutBrightness(RenderPunctual light);

class EmitterFactor {
 public:
  EmitterFactor(const RenderScene& scene, const LightSet& lights, size_t emitter, const VplId& id,
                uint32_t seed);

  // Whether its light has another colour in each place, so that it needs a factor per channel.
  bool isColoured() const;
  // False for the sky without its suns, whose light gather rays find.
  bool isSampled() const { return light_.kind != EmitterKind::sky || light_.skySun > 0; }
  // Its places, if it is flat, has one colour and `side` is not 0 (visible_places.h).
  std::optional<FlatLight> flat(int side) const;
  bool hasClosedForm() const { return !corners_.empty(); }
  // The light on a spot if nothing is between, of a light with a closed form; 0 below the surface.
  float unshadowed(const SurfaceSpot& spot) const;
  // Where it is; empty: far away.
  const Bounds& bounds() const { return bounds_; }
  // One ray for each spot that it may light. `key`: identifies the element, so that neighbours use
  // other points of the light.
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
  std::vector<vec3> corners_;  // of the triangles of a simple or flat surface, for its closed form
};

}  // namespace lamplighter
