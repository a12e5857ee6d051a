// Points that represent surfaces as occluders in imperfect shadow maps, denser where surfaces cover
// a larger solid angle: paper 2, section 5.
#pragma once

#include <array>
#include <cstdint>
#include <new>
#include <span>
#include <vector>

#include "renderer/imperfect_maps/occluder_importance.h"

namespace lamplighter {

// Allocates at addresses for aligned loads of 8 floats.
template <typename T>
struct LaneAllocator {
  using value_type = T;
  LaneAllocator() = default;
  template <typename U>
  LaneAllocator(const LaneAllocator<U>&) {}
  T* allocate(size_t n) {
    return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{32}));
  }
  void deallocate(T* p, size_t) { ::operator delete (p, std::align_val_t{32}); }
  bool operator==(const LaneAllocator&) const { return true; }
};
using LaneFloats = std::vector<float, LaneAllocator<float>>;

struct OccluderPointOptions {
  uint32_t points = 16 * 8192;           // a multiple of pointsPerMap
  uint32_t pointsPerMap = 8192;          // a power of two, at least 64
  OccluderImportanceOptions importance;  // its seed is also that of the points
  bool operator==(const OccluderPointOptions&) const = default;
};

// One entry per point, in world space and the unit of the scene. The number of points is a multiple
// of 8.
struct OccluderPointArrays {
  LaneFloats px, py, pz;
  LaneFloats nx, ny, nz;  // unit; on the front (counter-clockwise) side of the triangle
  // The area that the point represents if pointsPerMap points are used: the reciprocal of their
  // number and of the density of points by area. 0: there is no such point now, or it lies in a
  // hole of an alpha mask.
  LaneFloats area;
  std::vector<uint32_t> object, triangle;  // index into RenderScene::objects; within the object
  std::vector<float> u, v;                 // weights of the second and third corner
};

// A pool of points. Block b starts at point b·pointsPerMap and is for one map. A block, each eighth
// of it and every 2ᵏ-th point of an eighth are stratified by the distribution of OccluderImportance
// and within its groups. The points of an eighth lie in the order of the groups, so that points
// that are close in memory are close in space.
//
// Each point is a function of its index, the seed, the scene and the positions. After a change of
// these, each update draws an eighth of each block again: the points from e/8 to (e + 1)/8 of the
// block, with e in turn (paper 2, 5.3). Each part is stratified, so that a mixture of old and new
// parts covers all surfaces evenly. After 8 updates without a change the points are bitwise equal
// to those of a new start.
class OccluderPoints {
 public:
  static constexpr uint32_t kEighths = 8;

  // `changes`: of the scene since the last call. Positions: see OccluderImportance; pass the same
  // positions for a steady distribution, and none for points that are uniform by area. All points
  // follow moved objects at once; points of objects that were removed or became clear get area 0.
  // Draws all points at the first call, when the scene was rebuilt, and when the options changed.
  // The result does not depend on the number of threads. Returns whether any point changed. Throws
  // InputError for numbers of points that OccluderPointOptions does not allow.
  bool update(const RenderScene& scene, const RenderSceneChanges& changes,
              std::span<const vec3> viewPositions, std::span<const vec3> lightPositions,
              const OccluderPointOptions& options);

  const OccluderPointArrays& arrays() const { return arrays_; }
  uint32_t size() const { return static_cast<uint32_t>(arrays_.px.size()); }
  const OccluderPointOptions& options() const { return options_; }
  // State at the last update.
  const OccluderGroups& groups() const { return groups_; }
  const OccluderImportance& importance() const { return importance_; }

  bool isSettled() const { return pendingFrames() == 0; }
  uint32_t pendingFrames() const;  // updates without a change until isSettled()
  // Number of updates since the point was drawn.
  uint32_t ageOf(uint32_t point) const { return ages_[eighthOf(point)]; }
  // Memory of the pool: 44 bytes per point, 28 of them for position, normal and area, which are 3.5
  // MiB for the default number.
  size_t poolBytes() const;
  size_t memoryBytes() const;  // of everything

 private:
  OccluderPointOptions options_;
  OccluderGroups groups_;
  OccluderImportance importance_;
  OccluderPointArrays arrays_;
  std::vector<vec3> viewPositions_, lightPositions_;
  std::vector<double> objectAreas_;         // at the last update
  std::array<bool, kEighths> isCurrent_{};  // by eighth: whether it is drawn for the current input
  std::array<uint32_t, kEighths> ages_{};
  uint32_t next_ = 0;  // eighth
  bool isStarted_ = false;

  uint32_t eighthOf(uint32_t point) const {
    return point % options_.pointsPerMap / (options_.pointsPerMap / kEighths);
  }
  void follow(const RenderScene& scene, const RenderSceneChanges& changes);
  bool takePositions(std::span<const vec3> view, std::span<const vec3> lights);
  void drawEighth(const RenderScene& scene, uint32_t eighth);
  // A point of the sequence: its index, and its position in [0, 1)².
  struct Draw {
    uint32_t index = 0;
    vec2 random{0.0f};
  };
  void draw(const RenderScene& scene, uint32_t first, std::span<const Draw> draws);
  void place(const RenderScene& scene, uint32_t point);
};

}  // namespace lamplighter
