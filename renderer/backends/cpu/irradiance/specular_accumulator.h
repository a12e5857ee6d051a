// The reflection of all lights by glossy surfaces towards the eye, over a G-buffer. It is kept
// while nothing visible in it changes. Tiles with a change are summed from scratch over all lights:
// a light that moves affects every lobe that it reaches, so an incremental update would save at
// most half.
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "renderer/backends/cpu/irradiance/specular_kernel.h"
#include "renderer/image/image.h"

namespace lamplighter::cpu {

class SpecularAccumulator {
 public:
  // Updates all glossy pixels as seen from `eye`. `patches` null: shadow map look-ups everywhere.
  // Returns the number of lights × pixels that were summed.
  uint64_t update(const RenderScene& scene, const GBuffer& gbuffer, const vec3& eye,
                  std::vector<SpecularLight> lights, const SumConstants& constants,
                  float leastRoughness, const PatchLights* patches);

  // Call when a shadow map is about to change, or when all maps are lost.
  void mapsChange() { isKnown_ = false; }
  // Call when objects are renumbered, or get other patches without moving.
  void forgetPlaces() {
    knowsPlaces_ = false;
    isKnown_ = false;
  }
  // Removes all specular light.
  void clear();

  // Replaces Lambertian shading by shading with specular light in the picture. Does nothing if
  // there are no glossy pixels.
  void addTo(const GBuffer& gbuffer, Image& picture) const;
  size_t bytes() const;

 private:
  using Patch = std::pair<uint32_t, int>;  // object, leaf
  // The glossy lanes of one packet that lie in one patch.
  struct Part {
    uint8_t packet, lanes;
    uint32_t row;
    Patch patch;
  };
  struct Tile {
    uint64_t revision = 0;  // of the G-buffer tile when it was summed; 0: never
    std::vector<Part> parts;
    // By pixel; empty if the tile has no glossy pixel.
    std::vector<Gloss> gloss;
    std::vector<vec3> radiance;  // [W/(m² sr)]
  };
  void findParts(const RenderScene& scene, const GBuffer& gbuffer, size_t tile,
                 std::span<const uint8_t> mayBeGlossy, const PatchLights* patches);
  std::vector<bool> findUses(const RenderScene& scene, float leastRoughness,
                             const PatchLights& patches);

  bool isOn_ = false, isKnown_ = false, knowsPlaces_ = false, hasPatches_ = false;
  SumConstants constants_;
  float leastRoughness_ = 0.0f;
  vec3 eye_{0.0f};
  std::vector<SpecularLight> lights_;
  std::vector<Tile> tiles_;
  std::map<Patch, uint32_t> rows_;
  std::vector<ShadowMode> uses_;  // rows × slots
  size_t slots_ = 0;
};

}  // namespace lamplighter::cpu
