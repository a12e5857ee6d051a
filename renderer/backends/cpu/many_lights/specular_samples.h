// Specular light for quick pictures: summed at the samples of the low-resolution pass, and
// interpolated between those of the same object with similar normals. Highlights are as blurred as
// a block is wide. Glossy pixels without such a sample keep Lambertian shading.
#pragma once

#include <span>
#include <vector>

#include "renderer/backends/cpu/irradiance/specular_accumulator.h"
#include "renderer/backends/cpu/many_lights/low_resolution.h"

namespace lamplighter::cpu {

class SpecularSamples {
 public:
  // After the update of `low` to the G-buffer. Arguments and result as for
  // SpecularAccumulator::update().
  uint64_t update(const RenderScene& scene, const GBuffer& gbuffer, const LowResolution& low,
                  const vec3& eye, std::vector<SpecularLight> lights, const SumConstants& constants,
                  float leastRoughness, const PatchLights* patches);
  // Number of glossy pixels of the G-buffer.
  uint64_t glossyPixels() const;
  // Adds it to the picture, which includes emission.
  void addTo(const GBuffer& gbuffer, const LowResolution& low, Image& picture) const;

  // Whether addTo() has anything to add.
  bool isOn() const { return isOn_; }
  void clear() {
    if (isOn_) *this = SpecularSamples();
  }
  void forgetMaps() { sums_.forgetMaps(); }
  void forgetPlaces() {
    sums_.forgetPlaces();
    tiles_.clear();
  }
  size_t bytes() const;

 private:
  struct Tile {
    uint64_t revision = 0;  // of the G-buffer tile; 0: never
    std::vector<Gloss> gloss;
    uint64_t glossyPixels = 0;
  };

  // Radiance of highlights, divided by the reflectance of the surface.
  struct Demodulated {
    vec3 radiance{0.0f};
    bool isKnown = false;
  };
  std::vector<Demodulated> demodulated(const GBuffer& samples) const;

  bool isOn_ = false;
  SpecularAccumulator sums_;  // at the samples
  std::vector<Tile> tiles_;
  vec3 eye_{0.0f};
  float leastRoughness_ = 0.0f;
};

}  // namespace lamplighter::cpu
