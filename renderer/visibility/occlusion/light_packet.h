// Up to eight point lights, a lane of a vector each, for questions to all of them at a time.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "renderer/base/math.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// What a pyramid wants of a light that is not parallel.
struct PyramidApex {
  vec3 position{0.0f}, normal{0.0f};
  float rounding = 0.0f;  // rayEpsilon() there [m]
  PyramidApex() = default;
  explicit PyramidApex(const shared::Vpl& vpl);
};

struct LightPacket {
  static constexpr size_t kLights = 8;
  // Answers: bit i is that of light i.
  using Mask = uint32_t;
  using Floats = std::array<float, kLights>;

  alignas(32) std::array<Floats, 3> position, normal;
  alignas(32) Floats rounding;
  size_t count;

  // What is left of the lanes repeats the first light.
  explicit LightPacket(std::span<const PyramidApex* const> lights);
  Mask all() const { return (Mask{1} << count) - 1; }
};

}  // namespace lamplighter
