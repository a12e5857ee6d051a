// The parameters of multi_mesh.
#pragma once

#include "renderer/methods/common_parameters.h"
#include "renderer/methods/surface_light_parameters.h"
#include "renderer/surface_light/direct_meshes/direct_meshes.h"

namespace lamplighter {

// The carrier of the direct light of emissive surfaces.
enum class MultiMeshDirect { meshes, samples };

struct DirectMeshParameters {
  MultiMeshDirect direct = MultiMeshDirect::meshes;
  float contrast = 2.0f;  // percent
  float leastPixels = 4.0f;
  MeshPriority priority = MeshPriority::sorted;
  bool separateLights = true;
  int meshMemory = 256;  // MiB
  bool operator==(const DirectMeshParameters&) const = default;

  DirectMeshOptions directMeshes(int seed) const {
    return {{0.01f * contrast, leastPixels},
            priority,
            separateLights,
            static_cast<uint32_t>(seed),
            static_cast<size_t>(meshMemory) << 20};
  }
};
const ParameterTable<DirectMeshParameters>& directMeshParameters();

struct MultiMeshParameters : PathParameters,
                             FrameBudgetParameters,
                             SurfaceLightParameters,
                             SurfaceParameters,
                             DirectMeshParameters {};
const ParameterTable<MultiMeshParameters>& multiMeshParameters();

}  // namespace lamplighter
