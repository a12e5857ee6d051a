// The hits of the gather rays of each irradiance sample. They are stored, so that edits of light
// trace no rays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/surface_light/cut_leaves.h"

namespace lamplighter {

// The hit of one ray: a point of an element and its distance, in eight bytes.
struct GatherLink {
  static constexpr uint32_t kSky = 0xffffffffu;     // the ray hits nothing
  static constexpr uint32_t kDark = 0xfffffffeu;    // a surface that reflects no light
  static constexpr uint32_t kInside = 0xfffffffdu;  // the back of a single-sided surface
  uint32_t leaf = kDark;
  uint8_t u = 0, v = 0;        // weights of the second and third corner of the element [1/255]
  uint16_t distance = 0x7f80;  // the upper half of a float, rounded up [m]

  bool isLeaf() const { return leaf < kInside; }
  vec3 weights() const {
    const float second = static_cast<float>(u) / 255.0f, third = static_cast<float>(v) / 255.0f;
    return {1.0f - second - third, second, third};
  }
  float metres() const;
};

// Directions of gather rays. plane: a square picture with an angle of 160° (paper 4, section 5),
// which misses 2.48% of uniform light; for comparison with the paper.
enum class GatherProjection : uint8_t { hemisphere, plane };

// Directions around +Z with density cos θ/π, 0 outside the projection. The first sixteenth and the
// first quarter of them have the same distribution; within each part, neighbours in the list are
// close to each other.
std::vector<vec3> gatherDirections(int count, uint32_t scramble,
                                   GatherProjection projection = GatherProjection::hemisphere);
// Maps a point of the unit square to such a direction.
vec3 projectedDirection(const vec2& point, GatherProjection projection);
// Number of sets of directions. Neighbouring samples use different sets, so that their mean has
// less noise.
inline constexpr uint32_t kDirectionSets = 16;

// The local frame of the directions at a spot: around its normal, rotated differently at each
// position. Otherwise all samples of a wall would use the same few directions, and a distant window
// would be too bright or too dark by 20% for all of them.
Frame gatherFrame(const SurfaceSpot& spot);
// The direction in world space; 0 if it would point below the surface.
vec3 gatherDirection(const SurfaceSpot& spot, const vec3& direction);

// Rays are traced over several frames: first some of each sample, later all. Rays that a moved
// object may have changed keep their old hits until they are traced again. When nothing is left,
// the links are equal to those of a new start.
class GatherLinks {
 public:
  // Discards all links. The following calls must use the same mesh.
  void restart(const SurfaceMesh& mesh, int rays, uint32_t seed,
               GatherProjection projection = GatherProjection::hemisphere);
  // The elements of these objects have new numbers; links of other objects are kept.
  void renew(const SurfaceMesh& mesh, std::span<const uint32_t> objects);

  // After objects moved: marks as outdated all rays of their samples, and rays of other samples
  // that touch one of the boxes, which contain the objects before and after.
  void outdate(const RenderScene& scene, const RayCaster& rays, const SurfaceMesh& mesh,
               const CutLeaves& cuts, std::span<const uint32_t> movedObjects,
               std::span<const Bounds> boxes);
  // Traces outdated and missing rays, up to about `most`, but at least the first rays of each
  // sample. Returns the number of rays. `changed`: receives the changed samples, in ascending
  // order.
  uint64_t trace(const RenderScene& scene, const RayCaster& rays, const SurfaceMesh& mesh,
                 const CutLeaves& cuts, uint64_t most, std::vector<uint32_t>& changed);
  // Whether no ray is outdated or missing.
  bool isDone() const { return isCurrent() && stage_ == kStages; }
  // Whether no ray is outdated.
  bool isCurrent() const { return staleSamples_ == 0; }
  // Number of stages of directions that are known for all samples, at most kStages.
  int stage() const { return stage_; }
  static constexpr int kStages = 3;
  // Number of rays that are outdated or missing.
  uint64_t raysLeft() const;

  // Share of the rays of a sample that are outdated or missing.
  float pendingShareOf(uint32_t sample) const {
    const size_t good = known_[sample] - staleCounts_[sample];
    return 1.0f - static_cast<float>(good) / static_cast<float>(rays_);
  }

  int rays() const { return static_cast<int>(rays_); }
  // The known links of a sample.
  std::span<const GatherLink> of(uint32_t sample) const {
    return std::span(links_).subspan(sample * rays_, known_[sample]);
  }
  // The directions of the known links of a sample, around +Z.
  std::span<const vec3> directionsOf(uint32_t sample) const {
    return std::span(directions_).subspan(sets_[sample] * rays_, known_[sample]);
  }
  // Whether a sample lies inside an object or behind a wall: within this distance [m], several of
  // its rays hit backs of single-sided surfaces.
  bool isBuried(uint32_t sample, float within) const;
  // Harmonic mean of the hit distances of a sample [m]. Irradiance varies little within a fraction
  // of it (Ward, Rubinstein and Clear, "A Ray Tracing Solution for Diffuse Interreflection", 1988).
  float reachOf(uint32_t sample) const;
  size_t bytes() const {
    return links_.size() * sizeof(GatherLink) + stale_.size() * sizeof(uint64_t);
  }

 private:
  size_t raysOfStage(
      int stage) const;  // number of known rays per sample when the stage is complete
  std::span<uint64_t> staleOf(uint32_t sample) {
    return std::span(stale_).subspan(sample * words_, words_);
  }

  size_t rays_ = 0, words_ = 0;
  std::vector<vec3> directions_;       // by set
  std::vector<uint8_t> sets_;          // by sample
  std::vector<uint16_t> known_;        // by sample: how many of its links are known
  std::vector<uint64_t> stale_;        // by sample: one bit for each outdated link
  std::vector<uint16_t> staleCounts_;  // by sample
  size_t staleSamples_ = 0;            // number of samples with outdated links
  int stage_ = 0;
  uint32_t next_ = 0;              // the sample at which the next frame continues
  std::vector<GatherLink> links_;  // by sample, then by ray
};

}  // namespace lamplighter
