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

// Directions around +Z with density cos θ/π. Neighbours in the list are near each other.
std::vector<vec3> gatherDirections(int count, uint32_t scramble);
// Number of such sets. Neighbouring samples have different ones, so that their mean knows more.
inline constexpr uint32_t kDirectionSets = 16;

// In world space; 0 where it would leave below the surface.
vec3 gatherDirection(const SurfaceSpot& spot, const vec3& direction);

class GatherLinks {
 public:
  // Forgets all links. The mesh is that of the following calls.
  void restart(const SurfaceMesh& mesh, int rays, uint32_t seed);
  bool isEmpty() const { return links_.empty(); }

  // Traces all rays of these samples. Each is a function of the scene, the sample and the seed.
  // Returns the number of rays.
  uint64_t trace(const RenderScene& scene, const RayCaster& rays, const SurfaceMesh& mesh,
                 const CutLeaves& cuts, std::span<const uint32_t> samples);
  // After objects moved: traces again all rays of their samples, and those of other samples that
  // touch one of the boxes, which contain the objects before and after. The links are then those of
  // a fresh start. `changed`: receives the samples, in ascending order.
  uint64_t retrace(const RenderScene& scene, const RayCaster& rays, const SurfaceMesh& mesh,
                   const CutLeaves& cuts, std::span<const uint32_t> movedObjects,
                   std::span<const Bounds> boxes, std::vector<uint32_t>& changed);

  int rays() const { return static_cast<int>(rays_); }
  std::span<const GatherLink> of(uint32_t sample) const {
    return std::span(links_).subspan(sample * rays_, rays_);
  }
  // The directions of a sample, around +Z.
  std::span<const vec3> directionsOf(uint32_t sample) const {
    return std::span(directions_).subspan(sets_[sample] * rays_, rays_);
  }
  // Whether a sample lies inside of an object or behind a wall: several of its rays hit, within
  // this distance [m], back faces that no camera sees.
  bool isBuried(uint32_t sample, float within) const;
  // Harmonic mean of the distances of what a sample sees [m]. Irradiance varies little within a
  // part of it (Ward, Rubinstein and Clear, "A Ray Tracing Solution for Diffuse Interreflection",
  // 1988).
  float reachOf(uint32_t sample) const;
  size_t bytes() const { return links_.size() * sizeof(GatherLink); }

 private:
  size_t rays_ = 0;
  std::vector<vec3> directions_;   // by set
  std::vector<uint8_t> sets_;      // by sample
  std::vector<GatherLink> links_;  // by sample, then by ray
};

}  // namespace lamplighter
