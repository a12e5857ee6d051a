// Parameters and statistics of methods whose bounced light goes along links of texels
// (renderer/surface_depths).
#pragma once

#include "renderer/base/parameter_table.h"
#include "renderer/base/statistics.h"
#include "renderer/surface_depths/texel_radiosity.h"

namespace lamplighter {

struct StoredDepthParameters {
  float texel = 0.25f;  // [m]
  TexelOrder texelOrder = TexelOrder::zigzag;
  DepthMapKind depthMap = DepthMapKind::octahedral;
  int depthResolution = 64;
  TexelVisibility linkVisibility = TexelVisibility::rays;
  float linkError = 0.5f;  // percent
  int depthMemory = 256;   // MiB
  bool operator==(const StoredDepthParameters&) const = default;

  TexelRadiosityOptions radiosity(int bounces, int seed) const {
    return {texel,
            texelOrder,
            {depthMap, depthResolution},
            linkVisibility,
            0.01f * linkError,
            static_cast<size_t>(depthMemory) << 20,
            bounces,
            static_cast<uint32_t>(seed)};
  }
};
const ParameterTable<StoredDepthParameters>& storedDepthParameters();

struct StoredDepthStats {
  int texels = 0, links = 0, segments = 0;
  float texelSide = 0.0f, ratio = 0.0f;
  float progress = 100.0f;  // percent
  uint64_t texelRays = 0, depthBytes = 0;

  void take(const TexelRadiosity& light);
};
const StatisticTable<StoredDepthStats>& storedDepthStatistics();

}  // namespace lamplighter
