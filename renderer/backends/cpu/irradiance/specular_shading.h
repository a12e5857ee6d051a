// Which pixels of a G-buffer are glossy, and how their specular light is shown.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "renderer/backends/cpu/gbuffer/gbuffer.h"
#include "renderer/scene/surface.h"
#include "shaders/shared/brdf.h"

namespace lamplighter::cpu {

// By object: whether any part of it may be glossy.
std::vector<uint8_t> findGlossy(const RenderScene& scene);

// The gloss of the pixels of a tile; empty if none of them is glossy. Pixels that are not have a
// gloss without a lobe (shared::isGlossy). mayBeGlossy: by object.
std::vector<Gloss> findGloss(const RenderScene& scene, const GBuffer& gbuffer, size_t tile,
                             std::span<const uint8_t> mayBeGlossy);

// Calls f(x, y, pixel, gloss) for the glossy pixels of a tile. gloss: of findGloss().
template <typename F>
void forEachGlossy(const GBuffer& g, size_t tile, std::span<const Gloss> gloss, F&& f) {
  if (gloss.empty()) return;
  const int x0 = static_cast<int>(tile) % g.tilesX * kTileSize,
            y0 = static_cast<int>(tile) / g.tilesX * kTileSize;
  for (int y = y0; y < std::min(y0 + kTileSize, g.height); ++y)
    for (int x = x0; x < std::min(x0 + kTileSize, g.width); ++x) {
      const size_t pixel = g.index(x, y);
      const Gloss& at = gloss[pixel % kTilePixels];
      if (shared::isGlossy(at.metallic, at.roughness)) f(x, y, pixel, at);
    }
}

// Replaces Lambertian shading of a glossy pixel by shading with this specular radiance
// [W/(m² sr)]. hasEmission: the picture includes emission.
void addSpecular(const GBuffer& gbuffer, size_t pixel, const vec3& eye, const Gloss& gloss,
                 float leastRoughness, const vec3& specular, bool hasEmission, vec3& radiance);

}  // namespace lamplighter::cpu
