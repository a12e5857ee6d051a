// What lights give the eye by the lobes of glossy surfaces (shaders/shared/vpl_speculars.h), eight
// pixels at a time.
#pragma once

#include <span>

#include "renderer/backends/cpu/light_kernel.h"
#include "renderer/scene/surface.h"

namespace lamplighter::cpu {

// A VPL for speculars.
struct SpecularLight {
  LightRecord record;
  float footprint = 0.0f;  // Vpl::footprint.x
  bool operator==(const SpecularLight&) const = default;
};

// The radiance [W/(m² sr)] that all lights together give by the lobes of some pixels of a packet;
// those of the other lanes stay as they are.
//   uses: by slot, skip, add or addShadowed; null: with a look-up, or without where a light has no
//   map. first: the packet's first pixel; gloss, out: of the same packet. leftOutBy: the links of
//   lights that do not light these pixels.
void specularRadiance(const GBuffer& gbuffer, const vec3& eye, size_t first, uint8_t lanes,
                      std::span<const Gloss, kLanes> gloss, std::span<const SpecularLight> lights,
                      const LightUse* uses, uint32_t leftOutBy, const SumConstants& constants,
                      float leastRoughness, std::span<vec3, kLanes> out);

}  // namespace lamplighter::cpu
