// The direct light of each emitter on each element, per unit of its brightness, so that edits of
// brightness and colour trace no rays.
#pragma once

#include <optional>
#include <vector>

#include "renderer/sampling/vpl_set.h"
#include "renderer/surface_light/between.h"
#include "renderer/surface_light/blockers.h"
#include "renderer/surface_light/emitter_factor.h"

namespace lamplighter {

class DirectFactors {
 public:
  struct Scene {
    const RenderScene& scene;
    const RayCaster& rays;
    const LightSet& lights;
    const SurfaceMesh& mesh;
    // By element: whether a part of it is buried or behind a wall. Its light is then found at its
    // corners.
    std::span<const uint8_t> isMixed;
    uint32_t seed;
    int mask;  // side of the bit mask for exact visibility of flat lights; 0: rays
  };
  // Call after changes of the scene. `isNewMesh`: all elements are new. `movedObjects`: objects
  // that moved or have new elements. `boxes`: bounds of moved objects, before and after. Computes
  // only light that may have changed, with up to about `mostRays` rays; until later calls the other
  // elements keep their old light, or use that of a nearby element. Returns the number of rays.
  uint64_t update(const Scene& now, bool isNewMesh, std::span<const uint32_t> movedObjects,
                  std::span<const Bounds> boxes, uint64_t mostRays);
  bool isDone() const { return staleLeaves_ == 0; }
  // Whether the last update changed anything except the brightness of lights.
  bool changed() const { return changed_; }
  // Irradiance at the corners of the elements with the current brightness of the lights: three
  // values per element [W/m²].
  void sum(const LightSet& lights, std::vector<vec3>& out) const;

  // Factors of the last update that used masks, and those without blockers, which need no rays.
  size_t masked() const { return masked_; }
  size_t open() const { return open_; }
  size_t factors() const { return computed_; }  // computed in the last update
  size_t bytes() const;

 private:
  // The factors of one emitter, by element and corner; three channels if isColoured.
  struct Column {
    VplId id;
    RenderPunctual light;  // for punctual lights; without brightness
    bool isColoured = false;
    std::vector<float> factors;
  };
  struct Work;
  std::vector<uint8_t> matchColumns(const Scene& now, bool isNewMesh,
                                    const std::vector<bool>& isMoved);
  void findBalls(const Scene& now, bool isNewMesh, const std::vector<bool>& isMoved);
  void outdate(const Work& work, const std::vector<bool>& isMoved, std::span<const Bounds> boxes);
  std::vector<uint32_t> choose(const Work& work, uint64_t mostRays);
  void find(Work& work, uint32_t leaf);
  static uint64_t findPartial(const Work& work, size_t emitter, uint32_t leaf, uint32_t count,
                              std::array<vec3, 3>& corners, size_t& seenRays);
  void spread(const Work& work, uint32_t elements);

  // One bit for each emitter.
  std::span<uint64_t> staleOf(size_t leaf) {
    return std::span(stale_).subspan(leaf * words_, words_);
  }
  void setStale(size_t leaf, size_t emitter) {
    stale_[leaf * words_ + emitter / 64] |= uint64_t{1} << emitter % 64;
  }
  bool isStale(size_t leaf, size_t emitter) const {
    return (stale_[leaf * words_ + emitter / 64] >> emitter % 64 & 1u) != 0;
  }

  std::vector<Column> columns_;  // by emitter
  std::vector<uint8_t> wasMixed_;
  std::vector<Ball> balls_;      // by element: its bounding sphere
  std::vector<uint64_t> stale_;  // by element
  size_t words_ = 0, staleLeaves_ = 0;
  uint32_t next_ = 0;  // the element at which the next call continues
  bool changed_ = false;
  Sky sky_;  // at unit brightness
  int mask_ = 0;
  Blockers blockers_;  // if there are masks
  size_t computed_ = 0, masked_ = 0, open_ = 0;
};

}  // namespace lamplighter
