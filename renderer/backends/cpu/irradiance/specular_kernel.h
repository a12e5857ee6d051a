// The reflection of lights by the lobes of glossy surfaces towards the eye
// (shaders/shared/vpl_speculars.h), eight pixels at a time.
#pragma once

#include <span>
#include <vector>

#include "renderer/backends/cpu/irradiance/light_kernel.h"
#include "renderer/scene/surface.h"

namespace lamplighter::cpu {

// A VPL with the data that speculars need.
struct SpecularLight {
  LightRecord record;
  float footprint = 0.0f;  // Vpl::footprint.x
  bool operator==(const SpecularLight&) const = default;
};

// Glossy points that are summed together, one light after another, so that a light is prepared, and
// its shadow map loaded, once for all of them.
class SpecularBlock {
 public:
  static constexpr size_t kMost = 128;

  // For a G-buffer seen from `eye`.
  SpecularBlock(const GBuffer& gbuffer, const vec3& eye, const SumConstants& constants,
                float leastRoughness);
  ~SpecularBlock();

  // Adds some lanes of the packet that begins at pixel `first`, with their gloss.
  // uses: by slot, skip, add or addShadowed; null: a look-up, or none if the light has no map.
  // leftOutBy: the link bits of the lights that do not light them.
  void add(size_t first, uint8_t lanes, std::span<const Gloss, kLanes> gloss,
           const ShadowMode* uses, uint32_t leftOutBy);

  void sum(std::span<const SpecularLight> lights);
  // Writes the reflected radiance of the k-th entry [W/(m² sr)] to its lanes.
  void read(size_t k, std::span<vec3, kLanes> out) const;

 private:
  struct Place;
  template <LightRecord::Kind kKind>
  void addLight(const SpecularLight& light);

  const GBuffer& gbuffer_;
  const vec3 eye_;
  SumConstants constants_;
  const float leastRoughness_;
  std::vector<Place> places_;
};

}  // namespace lamplighter::cpu
