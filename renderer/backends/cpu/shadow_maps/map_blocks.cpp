#include "renderer/backends/cpu/shadow_maps/map_blocks.h"

#include <cmath>

#include "renderer/base/simd.h"

namespace lamplighter::cpu {
namespace {

// Larger than the rounding errors.
constexpr float kSlack = 1e-4f, kShareOfSlack = 1.001f;

}  // namespace

SphereInMap::SphereInMap(const LightSpace& light, const TexelDirections& directions,
                         const Sphere& sphere)
    : directions_(directions), isParallel_(light.isParallel) {
  const vec3 way = sphere.centre - light.origin;
  const vec3 c(glm::dot(way, light.axes[0]), glm::dot(way, light.axes[1]),
               glm::dot(way, light.axes[2]));
  if (isParallel_) {
    axis_ = c * light.across;
    reach_ = sphere.radius * light.across * kShareOfSlack + kSlack;
    return;
  }
  if (c.z < -sphere.radius) {
    where_ = Where::nowhere;
    return;
  }
  const float distance = glm::length(c);
  reach_ = sphere.radius / distance * kShareOfSlack + kSlack;
  if (!(reach_ < 1.0f)) {  // the light is inside the sphere, or NaN
    where_ = Where::anywhere;
    return;
  }
  axis_ = c / distance;
  cosine_ = std::sqrt(1.0f - reach_ * reach_);
}

uint32_t SphereInMap::blocks(size_t first) const {
  const TexelDirections& d = directions_;
  const Floats8 x = loadAt(d.midX, first), y = loadAt(d.midY, first);
  if (isParallel_) {
    const Floats8 dx = hn::Sub(x, broadcast(axis_.x)), dy = hn::Sub(y, broadcast(axis_.y)),
                  most = hn::Add(loadAt(d.cosine, first), broadcast(reach_));
    return bitsOf(hn::Le(hn::MulAdd(dx, dx, hn::Mul(dy, dy)), hn::Mul(most, most)));
  }
  const Floats8 cosines = hn::MulAdd(
      x, broadcast(axis_.x),
      hn::MulAdd(y, broadcast(axis_.y), hn::Mul(loadAt(d.midZ, first), broadcast(axis_.z))));
  // Both angles (of the sphere and of the block) are below 90°, so cos(a + b) decreases from 1 to
  // −1.
  const Floats8 least = hn::Sub(hn::Mul(loadAt(d.cosine, first), broadcast(cosine_)),
                                hn::Mul(loadAt(d.sine, first), broadcast(reach_)));
  return bitsOf(hn::Ge(cosines, least));
}

}  // namespace lamplighter::cpu
