// The random numbers of VPLs, and the construction of a VPL from a position.
#pragma once

#include "renderer/sampling/vpl_set.h"

namespace lamplighter {

// Stateless: each number depends only on the light's id, the sample's index and the dimension.
class SampleStreams {
 public:
  explicit SampleStreams(const VplCounts& counts);

  // The sequence: points on lights, paths, or paths that follow a moved light.
  enum Set : uint32_t { direct = 0x0d, indirect = 0x1d, following = 0x5d };
  // Dimensions of positions and directions on a light; paths use the following ones.
  static constexpr uint32_t kPlaceDimension = 0, kDirectionDimension = 1;
  // Point `index` of the light's sequence, in [0, 1)²; it does not depend on the number of points.
  // Dimension 0 is neither shuffled nor hashed, so that sets of different size share their first
  // points.
  vec2 point(const VplId& light, uint32_t index, uint32_t dimension, uint32_t set) const;

  // A unit tangent with a random rotation around the unit normal, so that the texel grids of many
  // shadow maps are not aligned with the walls of a room.
  vec3 turnedTangent(const VplId& id, const vec3& normal) const;

  // Makes a VPL of kind shared::kVpl…, in world space; intensity [W/sr] or irradiance [W/m²].
  SceneVpl makeVpl(const VplId& id, float kind, const vec3& position, const vec3& normal,
                   const vec3& intensity) const;

 private:
  uint32_t seed_, turn_;
};

}  // namespace lamplighter
