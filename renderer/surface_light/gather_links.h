// What the rays of each sample of irradiance see. They are kept, so that other light needs no rays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/surface_light/cut_leaves.h"

namespace lamplighter {

// What one ray sees: a point of an element and its distance, in eight bytes.
struct GatherLink {
  static constexpr uint32_t kSky = 0xffffffffu;     // it hits nothing
  static constexpr uint32_t kDark = 0xfffffffeu;    // a surface that reflects no light
  static constexpr uint32_t kInside = 0xfffffffdu;  // a back face that no camera sees
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

// What rays see. plane: a square picture with an angle of 160° (paper 4, section 5), which misses
// 2.48% of even light; to compare with.
enum class GatherProjection : uint8_t { hemisphere, plane };

// Directions around +Z with density cos θ/π, 0 where the projection sees nothing. The first
// sixteenth and quarter of them are spread like all; within each part, neighbours in the list are
// near each other.
std::vector<vec3> gatherDirections(int count, uint32_t scramble,
                                   GatherProjection projection = GatherProjection::hemisphere);
// Such a direction for a point of the unit square.
vec3 projectedDirection(const vec2& point, GatherProjection projection);
// Number of such sets. Neighbouring samples use different sets, so that their mean has less noise.
inline constexpr uint32_t kDirectionSets = 16;

// The frame of a spot's directions: around its normal, turned differently at each place. Otherwise
// all samples of a wall would look in the same few directions, and a distant window would be
// brighter or darker by 20% for all of them.
Frame gatherFrame(const SurfaceSpot& spot);
// In world space; 0 where it would leave below the surface.
vec3 gatherDirection(const SurfaceSpot& spot, const vec3& direction);

// Rays are traced over several frames: first some of each sample, later all. What a moved object
// may have changed is traced again, and keeps its old ends until then. When nothing is left, the
// links are those of a fresh start.
class GatherLinks {
 public:
  // Forgets all links. The mesh is that of the following calls.
  void restart(const SurfaceMesh& mesh, int rays, uint32_t seed,
               GatherProjection projection = GatherProjection::hemisphere);
  // Other elements have the numbers of these objects now, or had them; links of the others stay.
  void renew(const SurfaceMesh& mesh, std::span<const uint32_t> objects);

  // After objects moved: all rays of their samples, and those of other samples that touch one of
  // the boxes, which contain the objects before and after, are out of date.
  void outdate(const RenderScene& scene, const RayCaster& rays, const SurfaceMesh& mesh,
               const CutLeaves& cuts, std::span<const uint32_t> movedObjects,
               std::span<const Bounds> boxes);
  // Traces what is out of date and what is missing, up to about `most` rays, but at least the first
  // rays of each sample. Returns the number of rays. `changed`: receives the samples, in ascending
  // order.
  uint64_t trace(const RenderScene& scene, const RayCaster& rays, const SurfaceMesh& mesh,
                 const CutLeaves& cuts, uint64_t most, std::vector<uint32_t>& changed);
  // Whether nothing is out of date or missing.
  bool isDone() const { return isCurrent() && stage_ == kStages; }
  // Whether nothing is out of date.
  bool isCurrent() const { return staleSamples_ == 0; }
  // How many parts of the directions are known of all samples, at most kStages.
  int stage() const { return stage_; }
  static constexpr int kStages = 3;
  // Rays that are out of date or missing.
  uint64_t raysLeft() const;

  // Share of the rays of a sample that are out of date or missing.
  float pendingShareOf(uint32_t sample) const {
    const size_t good = known_[sample] - staleCounts_[sample];
    return 1.0f - static_cast<float>(good) / static_cast<float>(rays_);
  }

  int rays() const { return static_cast<int>(rays_); }
  // Those that are known.
  std::span<const GatherLink> of(uint32_t sample) const {
    return std::span(links_).subspan(sample * rays_, known_[sample]);
  }
  // The directions of a sample, around +Z.
  std::span<const vec3> directionsOf(uint32_t sample) const {
    return std::span(directions_).subspan(sets_[sample] * rays_, known_[sample]);
  }
  // Whether a sample lies inside of an object or behind a wall: several of its rays hit, within
  // this distance [m], back faces that no camera sees.
  bool isBuried(uint32_t sample, float within) const;
  // Harmonic mean of the distances of what a sample sees [m]. Irradiance varies little within a
  // part of it (Ward, Rubinstein and Clear, "A Ray Tracing Solution for Diffuse Interreflection",
  // 1988).
  float reachOf(uint32_t sample) const;
  size_t bytes() const {
    return links_.size() * sizeof(GatherLink) + stale_.size() * sizeof(uint64_t);
  }

 private:
  size_t raysOfStage(int stage) const;  // known ones when it is complete
  std::span<uint64_t> staleOf(uint32_t sample) {
    return std::span(stale_).subspan(sample * words_, words_);
  }

  size_t rays_ = 0, words_ = 0;
  std::vector<vec3> directions_;       // by set
  std::vector<uint8_t> sets_;          // by sample
  std::vector<uint16_t> known_;        // by sample: how many of its links are known
  std::vector<uint64_t> stale_;        // by sample: a bit for each known link that is out of date
  std::vector<uint16_t> staleCounts_;  // by sample
  size_t staleSamples_ = 0;            // that have any
  int stage_ = 0;
  uint32_t next_ = 0;              // the sample at which the next frame goes on
  std::vector<GatherLink> links_;  // by sample, then by ray
};

}  // namespace lamplighter
