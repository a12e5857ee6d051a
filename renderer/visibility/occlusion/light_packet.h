// Up to eight point lights, one per SIMD lane, so that they can be tested together.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "renderer/base/math.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// Bit i is the result for light i.
using LightMask = uint32_t;

// The properties of a light that a pyramid needs.
struct PyramidApex {
  vec3 position{0.0f};    // unused for a parallel light
  vec3 normal{0.0f};      // parallel light: unit, towards the light
  float rounding = 0.0f;  // rayEpsilon() at the position [m]; parallel light: 0
  bool isParallel = false;
  PyramidApex() = default;
  explicit PyramidApex(const shared::Vpl& vpl);
};

struct LightPacket {
  static constexpr size_t kLights = 8;
  using Floats = std::array<float, kLights>;

  alignas(32) std::array<Floats, 3> position, normal;
  alignas(32) Floats rounding;
  size_t count;

  // Not for parallel lights. Unused lanes repeat the first light.
  explicit LightPacket(std::span<const PyramidApex* const> lights);
  LightMask all() const { return (LightMask{1} << count) - 1; }
};

}  // namespace lamplighter
