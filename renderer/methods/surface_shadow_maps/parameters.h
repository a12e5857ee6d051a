// The parameters of surface_shadow_maps.
#pragma once

#include "renderer/methods/common_parameters.h"
#include "renderer/methods/surface_shadow_maps/texel_radiosity.h"

namespace lamplighter {

struct StoredDepthParameters {
  float texel = 0.25f;  // [m]
  TexelOrder order = TexelOrder::zigzag;
  DepthMapKind map = DepthMapKind::cube;
  int resolution = 32;
  TexelVisibility visibility = TexelVisibility::stored;
  float linkError = 0.5f;  // percent
  int depthMemory = 256;   // MiB
  bool operator==(const StoredDepthParameters&) const = default;
};

struct SurfaceShadowMapsParameters : PathParameters,
                                     FrameBudgetParameters,
                                     SurfaceParameters,
                                     StoredDepthParameters {
  TexelRadiosityOptions radiosity() const {
    return {texel,
            order,
            {map, resolution},
            visibility,
            0.01f * linkError,
            static_cast<size_t>(depthMemory) << 20,
            bounces,
            static_cast<uint32_t>(seed)};
  }
};
const ParameterTable<SurfaceShadowMapsParameters>& surfaceShadowMapsParameters();

}  // namespace lamplighter
