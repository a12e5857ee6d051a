// Distribution of occluder points by the solid angle that occluders cover: paper 2, sections 5.1
// and 5.2.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/imperfect_maps/occluder_groups.h"

namespace lamplighter {

struct OccluderImportanceOptions {
  // The share of points that is uniform by area, in [0, 1], so that every surface has some points.
  float areaShare = 0.1f;
  uint32_t seed = 0;
  bool operator==(const OccluderImportanceOptions&) const = default;
};

// A piecewise constant distribution over the groups of occluders. The weight W of a group is the
// mean solid angle of its triangles at 8 positions [sr], which differ from group to group (paper 2,
// 5.2). It is exact for groups of one triangle and where one of the positions is within two radii
// of the group. For others it is √(A ωᵀ M ω)/d² (OccluderGroup): exact for planar groups that are
// far away, and at most 15% too large for groups whose normals cover all directions. Occluders
// between the position and the group are ignored. A near triangle whose plane contains the position
// is ignored, too: a surface does not block points on itself, but would count 2π.
class OccluderImportance {
 public:
  static constexpr int kPositions = 8;  // per group

  // Computes the distribution from positions of the view and, to find occluders near the lights, of
  // lights: if both lists have positions, each provides half of the positions of a group. Each of
  // the 8 is from a different part of its list, so choose an order in which neighbours are close to
  // each other. Without positions the distribution is uniform by area. World space, unit of the
  // scene. The result does not depend on the number of threads.
  void update(const RenderScene& scene, const OccluderGroups& groups,
              std::span<const vec3> viewPositions, std::span<const vec3> lightPositions,
              const OccluderImportanceOptions& options);

  bool empty() const { return total_ <= 0.0; }  // no surfaces

  struct Choice {
    uint32_t group = 0;
    double within = 0.0;  // the unused part of u, in [0, 1)
  };
  // The group for u in [0, 1): close numbers give groups that are close in the order of the groups.
  // Do not call if empty().
  Choice at(double u) const;
  // Probability that at() returns the group for a uniform u.
  double probability(uint32_t group) const { return (ends_[group + 1] - ends_[group]) / total_; }
  // W by group [sr]; 0 without positions.
  std::span<const float> weights() const { return weights_; }
  size_t memoryBytes() const;

 private:
  std::vector<float> px_, py_, pz_;  // positions of the view, then of lights
  std::vector<float> weights_;
  std::vector<double> ends_;  // running sum of the shares, from 0; one entry more than groups
  std::vector<uint32_t>
      guide_;  // by equal part of [0, 1): group at its start; one entry more than parts
  double total_ = 0.0;

  void sum(std::span<const OccluderGroup> groups, float areaShare);
};

}  // namespace lamplighter
