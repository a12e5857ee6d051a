// The occlusion pyramids of up to eight lights on one rectangle, for one question at a time to all:
// the same bits as OcclusionPyramid says of each.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/visibility/occlusion/light_packet.h"
#include "renderer/visibility/occlusion/motion_metric.h"
#include "renderer/visibility/occlusion/occlusion_pyramid.h"

namespace lamplighter {

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
  size_t size() const { return size_; }
  std::span<const BoxBatch> boxes() const { return boxes_; }
  std::span<const BoxBatch> around() const { return around_; }

 private:
  size_t size_;
  std::vector<BoxBatch> boxes_, around_;
};

class PyramidBatch {
 public:
  static constexpr size_t kLights = LightPacket::kLights;
  static_assert(kLights == BoxBatch::kBoxes);
  using Mask = LightPacket::Mask;
  // How far what is asked about may move, as the way counts it, and still is met, for it is inside
  // of all planes by as much; negative: and still is not, outside of one. By light [m].
  using Depths = LightPacket::Floats;

  // Of lights for which the rectangle is neither dark nor degenerate.
  PyramidBatch(const LightPacket& lights, const PatchRegion& region);
  // Before depths are asked for.
  void weighBy(const MotionMetric& way);

  Mask all() const { return all_; }
  Mask mayMeetSphere(const vec3& centre, float radius, Depths& depths) const;
  Mask mayMeet(const Bounds& box) const;
  Mask mayMeetSphere(const vec3& centre, float radius) const;
  // Those that a point is in, by more than rounding.
  Mask hold(const vec3& point) const;
  // Those that corners of a triangle are in, and those where only clipping it tells: planesOf().
  struct Met {
    std::array<Mask, 3> byCorner{};
    Mask unsure = 0;
    Mask met() const { return byCorner[0] | byCorner[1] | byCorner[2]; }
  };
  Met meets(const std::array<vec3, 3>& triangle) const;
  // Of those, some where clipping it would leave nothing, by more than rounding; `rounding`: of the
  // triangle's corners [m].
  Mask surelyMiss(const std::array<vec3, 3>& triangle, float rounding) const;
  PyramidPlanes planesOf(size_t light) const;
  // Of each light one box, and of lights that are not asked about any of them.
  using Indices = std::array<int32_t, kLights>;
  Mask mayMeetEach(const BoxBatches& boxes, const Indices& which, Depths& depths) const;
  // Whether the pyramid of one light may meet any of some boxes: the deepest, or one that is met
  // deep enough.
  struct Found {
    int box = kNone;
    float depth = 0.0f;  // where none is met that of the one least outside
  };
  Found find(size_t light, const BoxBatches& boxes, float enough) const;

 private:
  static constexpr size_t kPlanes = 6;
  struct Plane {
    LightPacket::Floats x, y, z, offset;
    LightPacket::Floats weight;  // of a metre towards it, at least one
  };
  alignas(32) std::array<Plane, kPlanes> planes_;
  alignas(32) LightPacket::Floats margin_;  // what rounding may make of a place here [m]
  Mask all_;
};

}  // namespace lamplighter
