// What lights give the eye by the lobes of glossy surfaces (shaders/shared/vpl_speculars.h), eight
// pixels at a time.
#pragma once

#include <span>
#include <vector>

#include "renderer/backends/cpu/irradiance/light_kernel.h"
#include "renderer/scene/surface.h"

namespace lamplighter::cpu {

// A VPL for speculars.
struct SpecularLight {
  LightRecord record;
  float footprint = 0.0f;  // Vpl::footprint.x
  bool operator==(const SpecularLight&) const = default;
};

// Glossy places that are summed together, light after light, so that what is made of a light and
// its shadow map serve for all of them.
class SpecularBlock {
 public:
  static constexpr size_t kMost = 128;

  // Of a G-buffer seen from `eye`.
  SpecularBlock(const GBuffer& gbuffer, const vec3& eye, const SumConstants& constants,
                float leastRoughness);
  ~SpecularBlock();

  // Some lanes of the packet that begins at the pixel `first`, and their gloss.
  //   uses: by slot, skip, add or addShadowed; null: with a look-up, or without where a light has
  //   no map. leftOutBy: the links of lights that do not light them.
  void add(size_t first, uint8_t lanes, std::span<const Gloss, kLanes> gloss,
           const ShadowMode* uses, uint32_t leftOutBy);

  void sum(std::span<const SpecularLight> lights);
  // The radiance that the k-th place has of them [W/(m² sr)], into its lanes.
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
