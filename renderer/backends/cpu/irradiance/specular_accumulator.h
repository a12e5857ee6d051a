// What the lobes of glossy surfaces give the eye, over a G-buffer. Kept while nothing that they
// show changed; summed anew, pixel by pixel over all lights, in tiles where something did: a light
// that moves is in every lobe that it reaches, and what is not summed anew would be half of it at
// best.
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
  // Brings all glossy pixels up to date, as seen from `eye`. `patches`: null: look-ups everywhere.
  // Returns lights × pixels that were summed.
  uint64_t update(const RenderScene& scene, const GBuffer& gbuffer, const vec3& eye,
                  std::vector<SpecularLight> lights, const SumConstants& constants,
                  float leastRoughness, const PatchLights* patches);

  // Some shadow map is to change, or all are lost.
  void mapsChange() { isKnown_ = false; }
  // Objects are numbered anew, or have other patches though they stayed where they were.
  void forgetPlaces() {
    knowsPlaces_ = false;
    isKnown_ = false;
  }
  // Nothing has speculars.
  void clear();

  // Makes the picture of surfaces that are all Lambert's one with speculars. Does nothing where
  // there are none.
  void addTo(const GBuffer& gbuffer, Image& picture) const;
  size_t bytes() const;

 private:
  using Patch = std::pair<uint32_t, int>;  // object, leaf
  // Glossy lanes of one packet that lie in one patch.
  struct Part {
    uint8_t packet, lanes;
    uint32_t row;
    Patch patch;
  };
  struct Tile {
    uint64_t revision = 0;  // of the G-buffer's tile, as summed; 0: never
    std::vector<Part> parts;
    // By pixel; empty where nothing is glossy.
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
