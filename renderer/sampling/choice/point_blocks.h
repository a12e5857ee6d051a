// Points that the camera sees, in blocks of eight, and their irradiance by a light sample without
// shadows.
#pragma once

#include <array>
#include <span>

#include "renderer/sampling/view_points.h"
#include "renderer/sampling/vpl_set.h"

namespace lamplighter {

class PointBlocks {
 public:
  static constexpr size_t kMostPoints = 128, kLanes = 8, kBlocks = kMostPoints / kLanes;

  PointBlocks() = default;
  // At most kMostPoints.
  explicit PointBlocks(std::span<const SeenPoint> points);

  size_t size() const { return size_; }
  size_t blocks() const { return (size_ + kLanes - 1) / kLanes; }
  const SeenPoint& at(size_t i) const { return points_[i]; }
  // The largest rounding error of their coordinates [m].
  float rounding() const { return rounding_; }

  // Irradiance over intensity of a VPL at the eight points of a block [1/m²; 1 for parallel light],
  // without shadows; 1/d² is bounded at clampDistance [m]. 0 after the last point. `out`: eight
  // floats, aligned to 32 bytes. Bit-equal to shared::vplGeometry.
  void geometry(const shared::Vpl& vpl, float clampDistance, size_t block, float* out) const {
    geometries(vpl, clampDistance, block, block + 1, out);
  }
  // The same for the blocks [first, end).
  void geometries(const shared::Vpl& vpl, float clampDistance, size_t first, size_t end,
                  float* out) const;
  // One bit for each point of a block whose object a light with this link leaves out
  // (light_linking.h).
  uint32_t leftOut(uint32_t link, size_t block) const;

  // Arrays of x, y and z; unused entries are 0.
  struct Vectors {
    alignas(32) std::array<float, kMostPoints> x{}, y{}, z{};
    void set(size_t i, const vec3& v) { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
    vec3 at(size_t i) const { return {x[i], y[i], z[i]}; }
  };
  const Vectors& positions() const { return positions_; }

 private:
  std::array<SeenPoint, kMostPoints> points_{};
  size_t size_ = 0;
  Vectors positions_, normals_;
  float rounding_ = 0.0f;
  uint32_t leftOutByAny_ = 0;
};

}  // namespace lamplighter
