// The occlusion pyramids of up to eight lights on one rectangle, for one question at a time to all:
// the same bits as OcclusionPyramid says of each.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "renderer/visibility/occlusion_pyramid.h"

namespace lamplighter {

// What a pyramid wants of a light that is not parallel.
struct PyramidApex {
  vec3 position{0.0f}, normal{0.0f};
  float rounding = 0.0f;  // rayEpsilon() there [m]
  PyramidApex() = default;
  explicit PyramidApex(const shared::Vpl& vpl);
};

// Eight boxes, to be asked of at once.
struct BoxBatch {
  static constexpr size_t kBoxes = 8;
  alignas(32) std::array<std::array<float, kBoxes>, 3> centre{}, half{};
  void set(size_t i, const Bounds& box);
};

class PyramidBatch {
 public:
  static constexpr size_t kLights = BoxBatch::kBoxes;
  // Answers: bit i is that of light i.
  using Mask = uint32_t;

  // Of lights for which the rectangle is neither dark nor degenerate.
  PyramidBatch(std::span<const PyramidApex* const> lights, const PatchRegion& region);

  Mask all() const { return all_; }
  Mask mayMeet(const Bounds& box) const;
  Mask mayMeetOwn(const BoxBatch& boxes) const;  // each pyramid the box with its index
  // Of the pyramid of one light; bit i is box i.
  uint32_t mayMeetSome(size_t light, const BoxBatch& boxes) const;
  Mask mayMeetSphere(const vec3& centre, float radius) const;

 private:
  static constexpr size_t kPlanes = 6;
  using Lanes = std::array<float, kLights>;
  struct Plane {
    Lanes x, y, z, offset;
  };
  alignas(32) std::array<Plane, kPlanes> planes_;
  Mask all_;
};

}  // namespace lamplighter
