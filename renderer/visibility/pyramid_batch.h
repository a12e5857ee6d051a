// The occlusion pyramids of up to eight lights on one rectangle, for one question at a time to all:
// the same bits as OcclusionPyramid says of each.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

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

// Boxes, neighbours together, and one around each eight of them.
class BoxBatches {
 public:
  explicit BoxBatches(std::span<const Bounds> boxes);
  size_t size() const { return boxes_.size(); }  // batches
  std::span<const BoxBatch> boxes() const { return boxes_; }
  std::span<const BoxBatch> around() const { return around_; }
  const Bounds& bounds() const { return bounds_; }

 private:
  std::vector<BoxBatch> boxes_, around_;
  Bounds bounds_;
};

class PyramidBatch {
 public:
  static constexpr size_t kLights = BoxBatch::kBoxes;
  // Answers: bit i is that of light i.
  using Mask = uint32_t;
  // By how much what is asked about is inside of the plane that it is least inside of, so that it
  // may move as far and still is met; negative: by how much it is outside. By light [m].
  using Depths = std::array<float, kLights>;

  // Of lights for which the rectangle is neither dark nor degenerate.
  PyramidBatch(std::span<const PyramidApex* const> lights, const PatchRegion& region);

  Mask all() const { return all_; }
  Mask mayMeet(const Bounds& box, Depths& depths) const;
  Mask mayMeetSphere(const vec3& centre, float radius, Depths& depths) const;
  // Whether the pyramid of one light may meet any of some boxes. `first`: the batch that is asked
  // first.
  struct Found {
    int batch = kNone;   // the first where one is met
    float depth = 0.0f;  // of the one there that is deepest inside; else of the one least outside
  };
  Found find(size_t light, const BoxBatches& boxes, size_t first) const;

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
