// The light of many samples with imperfect shadow maps at the pixels of a view (paper 2, section
// 6.2; Keller and Heidrich, "Interleaved Sampling", 2001). Samples are divided into classes; each
// pixel sums the samples of one class, and a blur distributes the light. At rest, all pixels sum
// all classes one after the other: the exact sum.
#pragma once

#include <span>
#include <vector>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/image/image.h"
#include "renderer/imperfect_maps/imperfect_map.h"
#include "renderer/imperfect_maps/map_light.h"
#include "renderer/imperfect_maps/occluder_points.h"

namespace lamplighter {

// Points for many maps: aligned blocks of pointsPerMap points, which the maps use in turn.
struct OccluderPool {
  OccluderSpan points;
  size_t pointsPerMap = 8192;
  OccluderSpan of(size_t light) const;
};

// A pool of all points. `points` must outlive it.
OccluderPool poolOf(const OccluderPoints& points);

struct InterleavedOptions {
  ImperfectMapOptions map;
  int side = 8;               // side of a square of pixels with one class each
  float shadowBias = 0.002f;  // share of the distance
  int classes() const { return side * side; }
  bool operator==(const InterleavedOptions&) const = default;
};

// The lights of a class: [first, last) of `count`.
struct LightRange {
  size_t first = 0, last = 0;
  static LightRange ofClass(size_t count, int classes, int c);
};

// Irradiance of each pixel [W/m²] by the lights of its class, scaled to all lights. Pixel (x, y)
// has the class (x mod side) + side · (y mod side).
Image sumInterleaved(const GBufferView& gbuffer, std::span<const MapLight> lights,
                     const OccluderPool& pool, const InterleavedOptions& options);

// Imperfect maps of some lights, concatenated. `first`: index of the first light, which selects its
// points.
std::vector<float> imperfectMaps(std::span<const MapLight> lights, size_t first,
                                 const OccluderPool& pool, const ImperfectMapOptions& options);

// Adds the irradiance by all lights to `sum`, at all pixels. `maps`: the maps of the lights,
// concatenated, `resolution` texels per side.
void addLights(const GBufferView& gbuffer, std::span<const MapLight> lights,
               std::span<const float> maps, int resolution, const InterleavedOptions& options,
               Image& sum);

// The mean over the side² pixels about each pixel that lie on the same surface (paper 2, section
// 6.3), in two passes. A constant does not change.
Image blurredClasses(const GBufferView& gbuffer, const Image& irradiance, int side);

}  // namespace lamplighter
