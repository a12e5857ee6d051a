#include "renderer/backends/cpu/irradiance/shadow_map_diff.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "renderer/base/simd.h"
#include "shaders/shared/octahedral.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter::cpu {
namespace {

constexpr size_t kBatch = 8;

// Distance from a texel's centre to its corners, times the resolution. On the octahedron a corner
// is up to √2/resolution away, where |x| + |y| + z = 1, and no point of it is nearer to the light
// than 1/√3: as an angle at most √6/resolution. The rest is for rounding.
constexpr float kTexelAngle = 2.5f, kTexelWay = 1.5f, kMapRounding = 1e-3f;
// If more than this share of the texels changed, or the angle [rad] is larger, the whole map counts
// as changed. The following tests need an angle below 90°.
constexpr float kMostOfMap = 0.5f, kMostAngle = 1.4f;

// Indices of the texels that differ.
std::vector<uint32_t> changedTexels(std::span<const float> before, std::span<const float> now) {
  std::vector<uint32_t> changed;
  const size_t whole = now.size() / kBatch * kBatch;
  for (size_t i = 0; i < whole; i += kBatch) {
    const auto differ = hn::Ne(hn::LoadU(kTag, &before[i]), hn::LoadU(kTag, &now[i]));
    for (uint32_t rest = bitsOf(differ); rest != 0; rest &= rest - 1)
      changed.push_back(static_cast<uint32_t>(i) + static_cast<uint32_t>(std::countr_zero(rest)));
  }
  for (size_t i = whole; i < now.size(); ++i)
    if (before[i] != now[i]) changed.push_back(static_cast<uint32_t>(i));
  return changed;
}

}  // namespace

ShadowMapDiff diffShadowMaps(std::span<const float> before, std::span<const float> now,
                             int resolution, bool isParallel) {
  const std::vector<uint32_t> changed = changedTexels(before, now);
  if (changed.empty()) return {ShadowMapDiff::Extent::nothing, vec3(0.0f), 0.0f};
  if (static_cast<float>(changed.size()) > kMostOfMap * static_cast<float>(now.size())) return {};
  const auto size = static_cast<float>(resolution);
  const auto way = [&](uint32_t texel) {
    const auto side = static_cast<uint32_t>(resolution);
    const vec2 centre = shared::shadowTexelCentre(vec2(texel % side, texel / side), size);
    return isParallel ? vec3(centre, 0.0f) : glm::normalize(shared::octahedralDecode(centre));
  };
  vec3 sum(0.0f);
  for (const uint32_t texel : changed) sum += way(texel);
  ShadowMapDiff change{ShadowMapDiff::Extent::part, sum / static_cast<float>(changed.size()), 0.0f};
  if (isParallel) {
    float most = 0.0f;
    for (const uint32_t texel : changed)
      most = std::max(most, glm::distance(way(texel), change.axis));
    change.reach = most + kTexelWay / size + kMapRounding;
    return change;
  }
  // All lie in one half space, so their mean is zero only if they lie all around its border.
  change.axis = glm::normalize(change.axis);
  float least = 1.0f;
  for (const uint32_t texel : changed) least = std::min(least, glm::dot(way(texel), change.axis));
  change.reach = std::acos(std::max(least, 0.0f)) + kTexelAngle / size + kMapRounding;
  return change.reach < kMostAngle ? change : ShadowMapDiff();
}

void PlaceSpheres::resize(size_t count) {
  count_ = count;
  for (auto* v : {&x_, &y_, &z_, &radius_}) v->resize((count + kBatch - 1) / kBatch * kBatch, 0.0f);
}

void PlaceSpheres::set(size_t i, const vec3& centre, float radius) {
  x_[i] = centre.x;
  y_[i] = centre.y;
  z_[i] = centre.z;
  radius_[i] = radius;
}

void PlaceSpheres::findReached(const LightRecord& light, const ShadowMapDiff& change,
                               std::vector<uint8_t>& isReached) const {
  isReached.assign(x_.size(), 0);
  if (change.extent == ShadowMapDiff::Extent::nothing) return;
  const bool isParallel = light.kind == LightRecord::Kind::directional;
  const mat3 frame(light.tangent, light.bitangent, light.normal);
  const SimdVec3<Floats8> position = broadcast(light.position);
  const SimdVec3<Floats8> axis = broadcast(frame * change.axis);
  const SimdVec3<Floats8> tangent = broadcast(light.tangent),
                          bitangent = broadcast(light.bitangent);
  const Floats8 one = broadcast(1.0f), perSide = broadcast(1.0f / light.side);
  const float cosine = std::cos(change.reach), sine = std::sin(change.reach);
  for (size_t i = 0; i < x_.size(); i += kBatch) {
    const auto load = [&](const std::vector<float>& v) { return hn::LoadU(kTag, &v[i]); };
    const auto way = SimdVec3<Floats8>{load(x_), load(y_), load(z_)} - position;
    const Floats8 radius = hn::MulAdd(load(radius_), broadcast(1.001f), broadcast(1e-4f));
    hn::Mask<FloatTag> meets;
    if (isParallel) {
      const Floats8 dx =
          hn::Sub(hn::Mul(dotFused(way, tangent), perSide), broadcast(change.axis.x));
      const Floats8 dy =
          hn::Sub(hn::Mul(dotFused(way, bitangent), perSide), broadcast(change.axis.y));
      const Floats8 most = hn::MulAdd(radius, perSide, broadcast(change.reach));
      meets = hn::Le(hn::MulAdd(dx, dx, hn::Mul(dy, dy)), hn::Mul(most, most));
    } else {
      // From the light, the sphere has the angular radius b. a, the angle of the change, and b are
      // below 90°, so cos(a + b) decreases as they grow.
      const Floats8 distance2 = dotFused(way, way);
      const Floats8 sineB2 = hn::Div(hn::Mul(radius, radius), distance2);
      const Floats8 cosineB = hn::Sqrt(hn::Max(hn::Sub(one, sineB2), hn::Zero(kTag)));
      const Floats8 least =
          hn::Sub(hn::Mul(broadcast(cosine), cosineB), hn::Mul(broadcast(sine), hn::Sqrt(sineB2)));
      const auto isSeen = hn::Ge(dotFused(way, axis), hn::Mul(least, hn::Sqrt(distance2)));
      // If the light is inside the sphere, or for NaN, the sphere may be anywhere.
      meets = hn::Or(isSeen, hn::Not(hn::Lt(sineB2, one)));
    }
    const uint32_t bits = bitsOf(meets);
    for (size_t lane = 0; lane < kBatch; ++lane)
      isReached[i + lane] = static_cast<uint8_t>(bits >> lane & 1);
  }
}

}  // namespace lamplighter::cpu
