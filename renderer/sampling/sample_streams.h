// The numbers by which light samples are drawn, and how a VPL is made of a place.
#pragma once

#include "renderer/sampling/vpl_set.h"

namespace lamplighter {

// Stateless: each is a function of the light's id, the sample's index and the dimension alone.
class SampleStreams {
 public:
  explicit SampleStreams(const VplCounts& counts);

  // Which sequence: of points on lights, of paths, and of paths that follow a moved light.
  enum Set : uint32_t { direct = 0x0d, indirect = 0x1d, following = 0x5d };
  // Which dimension a light's own points and directions take; paths go on after these.
  static constexpr uint32_t kPlaceDimension = 0, kDirectionDimension = 1;
  // Two coordinates of the point `index` of the light's sequence, in [0, 1)², stable in index.
  // Dimension 0 is neither shuffled nor hashed, so that neighbouring counts share their points.
  vec2 point(const VplId& light, uint32_t index, uint32_t dimension, uint32_t set) const;

  // A unit tangent turned about the unit normal by chance, so that the texel grids of many maps do
  // not line up on the walls of a room.
  vec3 turnedTangent(const VplId& id, const vec3& normal) const;

  // A VPL of one of shared::kVpl…, world space, intensity [W/sr] or irradiance [W/m²].
  SceneVpl makeVpl(const VplId& id, float kind, const vec3& position, const vec3& normal,
                   const vec3& intensity) const;

 private:
  uint32_t seed_, turn_;
};

}  // namespace lamplighter
