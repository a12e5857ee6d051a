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

// By slot: skip, add or addShadowed; null: a look-up, or none if the light has no map.
struct SpecularUses {
  const ShadowMode* now = nullptr;
  const ShadowMode* before = nullptr;  // for lights that are subtracted
};

// How light is summed. Sums and differences of exact sums have no rounding errors, whatever their
// order; float sums are faster.
struct ExactSum;
struct FloatSum;

// Most parts of a SpecularBlock.
inline constexpr size_t kMostSpecularParts = 128;

// Glossy points that are summed together, one light after another, so that a light is prepared, and
// its shadow map loaded, once for all of them.
template <typename Sum>
class SpecularBlock {
 public:
  // For a G-buffer seen from `eye`.
  SpecularBlock(const GBuffer& gbuffer, const vec3& eye, const SumConstants& constants,
                float leastRoughness);
  ~SpecularBlock();

  // Adds some lanes of the packet that begins at pixel `first`, with their gloss.
  // leftOutBy: the link bits of the lights that do not light them.
  void add(size_t first, uint8_t lanes, std::span<const Gloss, kLanes> gloss,
           const SpecularUses& uses, uint32_t leftOutBy);

  // Adds the lights with the present shadow modes.
  void add(std::span<const SpecularLight> lights);
  // Subtracts the lights with the shadow modes of before.
  void takeAway(std::span<const SpecularLight> lights);
  // Applies the present shadow modes of a light that was added with those of before.
  void changeUses(const SpecularLight& light);
  // The reflected radiance of the k-th entry [W/(m² sr)], by channel and lane.
  void read(size_t k, std::span<double, size_t{3} * kLanes> sums) const;

 private:
  struct Place;
  template <LightRecord::Kind kKind, Sign kSign, typename UsesOf>
  void addKind(const SpecularLight& light, const UsesOf& usesOf);
  template <Sign kSign, typename UsesOf>
  void addLight(const SpecularLight& light, const UsesOf& usesOf);

  const GBuffer& gbuffer_;
  const vec3 eye_;
  SumConstants constants_;
  const float leastRoughness_;
  std::vector<Place> places_;
};

}  // namespace lamplighter::cpu
