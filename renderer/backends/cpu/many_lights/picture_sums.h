// The light of one picture of the cpu backend: the sums at its pixels, with the low-resolution
// pass, and its speculars.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/backends/cpu/irradiance/irradiance_accumulator.h"
#include "renderer/backends/cpu/irradiance/specular_accumulator.h"
#include "renderer/backends/cpu/many_lights/low_resolution.h"
#include "renderer/backends/cpu/many_lights/picture_light.h"

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
  SpecularAccumulator speculars;

  // Sums the diffuse light in blocks of so many pixels. isQuick: some samples are interpolated.
  // mostAtEdges: limits lights × pixels of the pixels that are not interpolated.
  SumCounts sum(const Input& in, int pixelsPerBlock, bool isQuick,
                uint64_t mostAtEdges = UINT64_MAX);
  // Whether the last sum left some of these pixels to later calls.
  bool isLimited() const { return block != 1 && low.isLimited(); }
  // Whether a sum from scratch would do so.
  bool isLong() const { return block != 1 && low.isLong(); }
  // Sums the diffuse light only in these packets (by tile, one bit each), all of their pixels.
  SumCounts sumAt(const Input& in, std::span<const uint32_t> packets);
  // Sums the speculars, or removes them if leastRoughness is negative. isKept: as for
  // SpecularAccumulator. isQuick: of light samples a quarter, each with the light of four. Returns
  // lights × pixels.
  uint64_t sumSpeculars(const Input& in, float leastRoughness, bool isKept, bool isQuick);

  PictureLight diffuse() const { return {sums, block == 1 ? nullptr : &low, nullptr, {}}; }
  // What the last sum() interpolated.
  uint64_t pixelsInterpolated() const { return block == 1 ? 0 : low.pixelsInterpolated(); }

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
};

}  // namespace lamplighter::cpu
