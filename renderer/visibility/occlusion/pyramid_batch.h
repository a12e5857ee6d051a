// The occlusion pyramids of up to eight lights on one rectangle. Each test is done for all of them
// at once, with results bit-equal to OcclusionPyramid.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/visibility/occlusion/light_packet.h"
#include "renderer/visibility/occlusion/motion_metric.h"
#include "renderer/visibility/occlusion/occlusion_pyramid.h"

namespace lamplighter {

// Eight boxes that are tested together.
struct BoxBatch {
  static constexpr size_t kBoxes = 8;
  alignas(32) std::array<std::array<float, kBoxes>, 3> centre{}, half{};
  void set(size_t i, const Bounds& box);
};

// Boxes in batches of eight neighbours, and a bounding box of each batch.
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
  // How far the tested shape may move, in the metric, and still intersect: it is inside all planes
  // by at least this much. Negative: how far it may move and still not intersect, because it is
  // outside one plane by this much. By light [m].
  using Depths = LightPacket::Floats;

  // Only for lights for which the rectangle is neither dark nor degenerate.
  PyramidBatch(const LightPacket& lights, const PatchRegion& region);
  // Sets the metric; call this before asking for depths.
  void weighBy(const MotionMetric& metric);

  LightMask all() const { return all_; }
  LightMask mayMeetSphere(const vec3& centre, float radius, Depths& depths) const;
  LightMask mayMeet(const Bounds& box) const;
  LightMask mayMeetSphere(const vec3& centre, float radius) const;
  // The pyramids that contain the point by more than the rounding error.
  LightMask hold(const vec3& point) const;
  // byCorner: pyramids that contain a corner of the triangle; unsure: pyramids for which only
  // clipping the triangle decides, see planesOf().
  struct Met {
    std::array<LightMask, 3> byCorner{};
    LightMask unsure = 0;
    LightMask met() const { return byCorner[0] | byCorner[1] | byCorner[2]; }
  };
  Met meets(const std::array<vec3, 3>& triangle) const;
  // Some of the pyramids for which clipping the triangle certainly leaves nothing, by more than the
  // rounding error. `rounding`: of the triangle's corners [m].
  LightMask surelyMiss(const std::array<vec3, 3>& triangle, float rounding) const;
  PyramidPlanes planesOf(size_t light) const;
  // Tests one box per light; the indices of lights that are not tested may be any valid ones.
  using Indices = std::array<int32_t, kLights>;
  LightMask mayMeetEach(const BoxBatches& boxes, const Indices& which, Depths& depths) const;
  // Tests several boxes against the pyramid of one light. Finds the box with the largest depth, or
  // the first whose depth is at least `enough`.
  struct Found {
    int box = kNone;
    float depth = 0.0f;  // if no box is met: depth of the box that is least outside
  };
  Found find(size_t light, const BoxBatches& boxes, float enough) const;

 private:
  static constexpr size_t kPlanes = 6;
  struct Plane {
    LightPacket::Floats x, y, z, offset;
    LightPacket::Floats weight;  // factor from depth to motion in the metric, ≥ 1
  };
  alignas(32) std::array<Plane, kPlanes> planes_;
  alignas(32) LightPacket::Floats margin_;  // rounding error of positions here [m]
  LightMask all_;
};

}  // namespace lamplighter
