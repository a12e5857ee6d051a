// Parameters of methods whose bounced light is stored on the surfaces (renderer/surface_light).
#pragma once

#include "renderer/base/parameter_table.h"
#include "renderer/methods/gi_method.h"
#include "renderer/surface_light/surface_light.h"

namespace lamplighter {

struct SurfaceLightParameters {
  float coarseEdge = 0.25f;  // [m]
  int gatherRays = 256;
  int linkMemory = 64;  // MiB
  int mask = 0;         // side of the bit mask on a light
  GatherProjection projection = GatherProjection::hemisphere;
  bool operator==(const SurfaceLightParameters&) const = default;

  SurfaceLightOptions surfaceLight(int bounces, int seed) const {
    return {bounces,    coarseEdge,
            gatherRays, static_cast<size_t>(linkMemory) << 20,
            mask,       static_cast<uint32_t>(seed),
            projection};
  }
};
const ParameterTable<SurfaceLightParameters>& surfaceLightParameters();

// Statistics of such methods.
struct SurfaceLightStats : GiStats {
  int elements = 0, elementCorners = 0;  // on the surfaces
  float elementEdge = 0.0f;              // longest edge that memory allows [m]
  int cornersTraced = 0;                 // in this frame, at least one ray
  uint64_t directFactors = 0;            // in this frame: emitters × elements
  int masks = 0;                         // in this frame
  uint64_t surfaceBytes = 0;             // memory

  // Takes all counts except the rays.
  void take(const SurfaceLight::Counts& counts);
};
const StatisticTable<SurfaceLightStats>& surfaceLightStatistics();

}  // namespace lamplighter
