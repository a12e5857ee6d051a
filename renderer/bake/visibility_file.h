// Writes the visibility of texels of the surface to a file for other programs:
// docs/reference/visibility.md.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/surface_depths/texel_radiosity.h"

namespace lamplighter {

struct SurfaceVisibility {
  float side = 0.0f;  // side of the texels, within the memory limit [m]
  TexelSet texels;
  SurfaceDepths depths;
};

// Uses the texels, the order, the map and the memory of the options. Deterministic.
SurfaceVisibility findVisibility(const RenderScene& scene, const RayCaster& rays,
                                 const TexelRadiosityOptions& options);

// `scene`: has the names of nodes. Lengths in the file are in metres.
std::vector<uint8_t> visibilityFile(const Scene& scene, const RenderScene& render,
                                    const SurfaceVisibility& visibility);

}  // namespace lamplighter
