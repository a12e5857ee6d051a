#include "renderer/visibility/hard_shadow_lights.h"

#include <algorithm>
#include <array>
#include <map>

#include "shaders/shared/low_resolution.h"

namespace lamplighter {

std::vector<int> hardLights(std::span<const LightStrength> lights) {
  using Kind = LightStrength::Kind;
  // The tiles of a parallel light do not overlap: only one tile per direction counts.
  std::map<std::array<float, 3>, float> squares;
  float others = 0.0f, parallel = 0.0f;
  for (const LightStrength& light : lights) {
    if (light.kind != Kind::directional) {
      others += light.brightest;
      continue;
    }
    float& square = squares[{light.direction.x, light.direction.y, light.direction.z}];
    square = std::max(square, light.brightest);
  }
  for (const auto& [direction, square] : squares) parallel += square;
  std::vector<int> slots;
  for (const LightStrength& light : lights) {
    const float all = light.kind == Kind::directional ? parallel : others;
    if (light.kind != Kind::cosine && light.slot >= 0 && light.brightest > shared::kHardShare * all)
      slots.push_back(light.slot);
  }
  return slots;
}

}  // namespace lamplighter
