// The cpu backend's pictures: light on surfaces.
#pragma once

#include "renderer/backends/cpu/gbuffer/gbuffer.h"
#include "renderer/backends/cpu/picture_light.h"

namespace lamplighter::cpu {

// The sky where a view's pixels, shifted by `jitter` from their middles, meet nothing.
struct Background {
  const Sky& sky;
  const View& view;
  vec2 jitter{0.0f};
  vec3 at(int x, int y) const;
};

// Le + ρ/π · E of each pixel, the sky where nothing is hit. `white`: with ρ = 1. The image has the
// G-buffer's size.
void compose(const GBuffer& gbuffer, const PictureLight& light, const Background& background,
             bool white, Image& out);

}  // namespace lamplighter::cpu
