// The light of one picture of the cpu backend: the sums at its pixels, with the low-resolution
// pass, and its speculars.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/backends/cpu/irradiance/irradiance_accumulator.h"
#include "renderer/backends/cpu/irradiance/specular_accumulator.h"
#include "renderer/backends/cpu/many_lights/carried_light.h"
#include "renderer/backends/cpu/many_lights/low_resolution.h"
#include "renderer/backends/cpu/many_lights/picture_light.h"
#include "renderer/backends/cpu/many_lights/specular_samples.h"

namespace lamplighter::cpu {

struct PictureSums {
  // What is summed, and where.
  struct Input {
    const RenderScene& scene;
    const GBuffer& gbuffer;
    vec3 eye{0.0f};
    std::span<const LightRecord> lights;
    std::span<const float> footprints;  // of the lights, for speculars (Vpl::footprint.x)
    SumConstants constants;
    const PatchLights* patches = nullptr;  // as for IrradianceAccumulator::update()
    std::span<const uint32_t> leftOutBy;   // as there
  };

  // At the pixels of the G-buffer; with blocks, only in cells that are not interpolated.
  IrradianceAccumulator sums;
  int block = 1;  // pixels per block of the last sum
  LowResolution low;
  // At the samples of `low`; in quick pictures, without the samples interpolated by `lowSamples`.
  IrradianceAccumulator sampleSums;
  LowResolution lowSamples;          // quick pictures: samples of the samples of `low`
  IrradianceAccumulator coarseSums;  // at the samples of `lowSamples`; summed from scratch
  CarriedLight carried;              // from view to view, while sums are limited
  SpecularAccumulator speculars;
  SpecularSamples sampledSpeculars;  // quick pictures: in place of `speculars`

  // Sums the diffuse light in blocks of `side` × `side` pixels. isQuick: some samples are
  // interpolated. mostAtEdges: limits lights × pixels of the pixels that are not interpolated.
  // `before`: the points of the picture of the last sum, if only the view has changed since; pixels
  // that are left to later calls use its light. Null: there is no such picture, or the view is the
  // same.
  SumCounts sum(const Input& in, int side, bool isQuick, uint64_t mostAtEdges = UINT64_MAX,
                const SeenPoints* before = nullptr);
  // Whether the last sum left some of these pixels to later calls.
  bool isLimited() const { return block != 1 && low.isLimited(); }
  // Glossy pixels of the last speculars.
  uint64_t glossyPixels() const {
    return sampledSpeculars.isOn() ? sampledSpeculars.glossyPixels() : speculars.glossyPixels();
  }
  // Sums the diffuse light only in these packets (by tile, one bit each), all of their pixels.
  SumCounts sumAt(const Input& in, std::span<const uint32_t> packets);
  // Those of these packets that the next sumAt() can sum within a limit of lights × pixels, and
  // those that are summed already.
  std::vector<uint32_t> fitting(const Input& in, std::span<const uint32_t> packets,
                                uint64_t mostLightPixels) const;
  // Sums the speculars, or removes them if leastRoughness is negative. isKept: as for
  // SpecularAccumulator. Returns lights × pixels.
  uint64_t sumSpeculars(const Input& in, float leastRoughness, bool isKept,
                        uint64_t mostLightPixels = UINT64_MAX);
  // Sums them only at the samples of the last sum(), which was in blocks.
  uint64_t sampleSpeculars(const Input& in, float leastRoughness);
  // Replaces Lambertian shading of glossy pixels in a picture, with the speculars of the last of
  // these two calls.
  void addSpeculars(const GBuffer& gbuffer, Image& picture) const;

  PictureLight diffuse() const { return {sums, block == 1 ? nullptr : &low, nullptr, {}}; }
  // The pixels that the last sum() interpolated.
  uint64_t pixelsInterpolated() const { return block == 1 ? 0 : low.pixelsInterpolated(); }

  // Something that `carried` does not know changed.
  void forgetCarried() {
    carried.forget();
    low.useCarried(nullptr);
  }
  // As for IrradianceAccumulator.
  void forgetMaps();
  void forgetPlaces();
  template <typename F>
  void forEachSums(F&& f) {
    f(sums);
    f(sampleSums);
    f(coarseSums);
  }
  size_t bytes() const;

 private:
  void takeCarried(size_t tiles);
};

}  // namespace lamplighter::cpu
