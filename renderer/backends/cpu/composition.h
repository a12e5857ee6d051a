// Composes the picture of the cpu backend from light and surfaces.
#pragma once

#include <functional>

#include "renderer/backends/cpu/gbuffer/gbuffer.h"
#include "renderer/image/image.h"

namespace lamplighter::cpu {

// The sky, for pixels that hit nothing; `jitter` is the offset from the pixels' middles.
struct Background {
  const Sky& sky;
  const View& view;
  vec2 jitter{0.0f};
  vec3 at(int x, int y) const;
};

// E [W/m²] at the eight pixels of a packet.
struct PacketIrradiance {
  float r[kLanes], g[kLanes], b[kLanes];
};
// The same, kept elsewhere.
struct PacketIrradianceView {
  const float *r, *g, *b;
};
// E of a packet. A function that does not keep it writes it to `room` and returns a view of that.
using PacketLight =
    std::function<PacketIrradianceView(int tile, int packet, PacketIrradiance& room)>;

// Le + ρ/π · E of each pixel; the sky where nothing is hit. `background` null: only ρ/π · E.
// `white`: with ρ = 1. The image has the size of the G-buffer.
void compose(const GBuffer& gbuffer, const PacketLight& light, const Background* background,
             bool white, Image& out);
// The same with E in an image of that size.
void compose(const GBuffer& gbuffer, const Image& irradiance, const Background& background,
             bool white, Image& out);

}  // namespace lamplighter::cpu
