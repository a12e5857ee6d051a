// Up to eight point lights, one per SIMD lane, so that they can be tested together.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "renderer/base/math.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// The properties of a non-parallel light that a pyramid needs.
struct PyramidApex {
  vec3 position{0.0f}, normal{0.0f};
  float rounding = 0.0f;  // rayEpsilon() at the position [m]
  PyramidApex() = default;
  explicit PyramidApex(const shared::Vpl& vpl);
};

struct LightPacket {
  static constexpr size_t kLights = 8;
  // Bit i is the result for light i.
  using Mask = uint32_t;
  using Floats = std::array<float, kLights>;

  alignas(32) std::array<Floats, 3> position, normal;
  alignas(32) Floats rounding;
  size_t count;

  // Unused lanes repeat the first light.
  explicit LightPacket(std::span<const PyramidApex* const> lights);
  Mask all() const { return (Mask{1} << count) - 1; }
};

}  // namespace lamplighter
