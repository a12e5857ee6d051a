// Composes the picture of the cpu backend from light and surfaces.
#pragma once

#include "renderer/backends/cpu/gbuffer/gbuffer.h"
#include "renderer/backends/cpu/picture_light.h"

namespace lamplighter::cpu {

// The sky, for pixels that hit nothing; `jitter` is the offset from the pixels' middles.
struct Background {
  const Sky& sky;
  const View& view;
  vec2 jitter{0.0f};
  vec3 at(int x, int y) const;
};

// Le + ρ/π · E of each pixel; the sky where nothing is hit. `white`: with ρ = 1. The image has the
// size of the G-buffer.
void compose(const GBuffer& gbuffer, const PictureLight& light, const Background& background,
             bool white, Image& out);

}  // namespace lamplighter::cpu
