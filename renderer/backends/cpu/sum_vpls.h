// The sum of many lights with shadows over pixels, eight at a time.
#pragma once

#include <span>
#include <vector>

#include "renderer/backends/cpu/gbuffer.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {
class PatchLights;
}

namespace lamplighter::cpu {

// A VPL made ready for the inner loop.
struct LightRecord {
  enum class Kind : uint8_t { cosine, uniform, directional };
  Kind kind = Kind::cosine;
  const float* map = nullptr;  // null: casts no shadow
  int slot = -1;
  vec3 position, normal, tangent, bitangent, intensity;
  float coneScale = 0.0f, coneOffset = 1.0f;
  float radius = 0.0f, side = 1.0f;  // directional: R and S
};

struct SumConstants {
  float clampDistance2 = 0.0f;  // d0² [m²]
  float bias = 0.0f;
  int resolution = 64;
};

// E of each pixel of one tile [W/m²], structure of arrays over the whole G-buffer.
struct Irradiance {
  std::vector<float> r, g, b;
};

LightRecord makeLightRecord(const shared::Vpl& vpl, const float* map);

// Adds every light, in order, to E at the pixels of the tiles [firstTile, lastTile), starting from
// zero. `patches`: how each patch comes by each light; null: with a look-up. Returns how many
// light·pixels had one, in whole packets.
uint64_t sumTiles(const GBuffer& gbuffer, int firstTile, int lastTile,
                  std::span<const LightRecord> lights, const SumConstants& constants,
                  const PatchLights* patches, Irradiance& out);

}  // namespace lamplighter::cpu
