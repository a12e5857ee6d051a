// The reflection of all lights by glossy surfaces towards the eye, over a G-buffer. The sums are
// kept between frames: for a changed light the old state is subtracted and the new one is added.
// Sums are exact, so they are bitwise equal to sums over all lights.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "renderer/backends/cpu/irradiance/specular_kernel.h"
#include "renderer/image/image.h"

namespace lamplighter::cpu {

class SpecularAccumulator {
 public:
  // Updates all glossy pixels as seen from `eye`. `patches` null: shadow map look-ups everywhere.
  // isKept: the same G-buffer will be updated again. Otherwise sums are faster, their last bits
  // differ, and at most about mostLightPixels lights × pixels are summed: call it with the same
  // arguments until isComplete(). Returns the number of lights × pixels that were summed.
  uint64_t update(const RenderScene& scene, const GBuffer& gbuffer, const vec3& eye,
                  std::vector<SpecularLight> lights, const SumConstants& constants,
                  float leastRoughness, const PatchLights* patches, bool isKept,
                  uint64_t mostLightPixels = UINT64_MAX);
  bool isComplete() const { return isComplete_; }

  // Call when the map of a slot is about to change; `map` is its present content.
  void mapChanges(int slot, std::span<const float> map);
  // Call when all maps are lost, or when maps change and their light is summed from scratch anyway.
  void forgetMaps() {
    isKnown_ = false;
    oldMaps_.clear();
  }
  // Call when objects are renumbered, or get other patches without moving.
  void forgetPlaces() {
    knowsPlaces_ = false;
    isKnown_ = false;
  }
  // Removes all specular light.
  void clear();

  // Replaces Lambertian shading by shading with specular light in the picture, which includes
  // emission or not. Does nothing if there are no glossy pixels.
  void addTo(const GBuffer& gbuffer, Image& picture, bool hasEmission = true) const;
  // What a pixel reflects; nothing if it is not glossy.
  struct Reflection {
    vec3 radiance;  // [W/(m² sr)]
    Gloss gloss;
  };
  std::optional<Reflection> reflection(size_t pixel) const;
  uint64_t glossyPixels() const;  // number of them
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
    std::vector<double> sums;  // by packet, channel and lane [W/(m² sr)]
    vec3 radiance(size_t pixel) const;
  };
  // How the lights are updated.
  struct Changes {
    bool all = true;  // sum all lights from scratch
    std::vector<SpecularLight> taken, added;
    std::vector<uint8_t> stays;  // by slot: a light that did not change
    std::map<int, const SpecularLight*> bySlot;
  };
  using TilePart = std::pair<size_t, const Part*>;  // with the index of its tile
  Changes findChanges(std::span<const SpecularLight> lights) const;
  void findParts(const RenderScene& scene, const GBuffer& gbuffer, size_t tile,
                 std::span<const uint8_t> mayBeGlossy, const PatchLights* patches);
  size_t fitting(std::span<const size_t> tiles, size_t lights, uint64_t mostLightPixels) const;
  void findRows(std::span<const size_t> tiles);
  using OtherUses = std::optional<std::vector<int>>;
  std::vector<OtherUses> findUses(const RenderScene& scene, float leastRoughness,
                                  const PatchLights& patches, std::span<const uint8_t> stays);
  template <typename Sum>
  uint64_t sumParts(const RenderScene& scene, const GBuffer& gbuffer,
                    std::span<const TilePart> parts, std::span<const SpecularLight> lights,
                    const Changes& changes, std::span<const OtherUses> others);

  bool isOn_ = false, isKept_ = false, isKnown_ = false, knowsPlaces_ = false, hasPatches_ = false;
  SumConstants constants_;
  float leastRoughness_ = 0.0f;
  vec3 eye_{0.0f};
  bool hasGlossy_ = true;  // any pixel is glossy
  bool isComplete_ = true;
  std::vector<SpecularLight> lights_;
  std::vector<Tile> tiles_;
  std::map<int, std::vector<float>> oldMaps_;  // by slot: maps of lights_ that changed since
  std::map<Patch, uint32_t> rowOf_;
  std::vector<Patch> rows_;
  std::vector<ShadowMode> uses_, usesBefore_;  // rows × slots
  std::vector<uint8_t> usesAreKnown_;          // by row
  size_t slots_ = 0;
};

}  // namespace lamplighter::cpu
