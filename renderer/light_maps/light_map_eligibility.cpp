#include "renderer/light_maps/light_map_eligibility.h"

#include <algorithm>
#include <limits>

#include "renderer/base/simd.h"
#include "renderer/scene/vpl.h"

namespace lamplighter {
namespace {

using Floats = Floats8;

// At a distance of n texels from a light, interpolation has an error of up to 1/n².
constexpr float kNearTexels = 10.0f;
// A patch that extends at most this number of texels behind a light (at a wall that meets the
// light's wall) counts as in front of it.
constexpr float kBehindTexels = 0.05f;
constexpr float kMostBrightness = 2048.0f;  // W/m²: 65536 such lights still fit the sums

bool isSpot(const shared::Vpl& vpl) {
  return vpl.position.w == shared::kVplUniform && vpl.normal.w != 0.0f;
}

using Vector3 =
    SimdVec3<Floats>;  // summed in glm's order, so that all results equal isLightMapEligible()

// Whether the light's plane crosses the patch. Behind the plane there is no light, and in front of
// it the light grows from zero; interpolation between texels on both sides would blur this.
bool isCrossed(const shared::Vpl& vpl, const TilePlace& tile) {
  const vec3 position(vpl.position), normal(vpl.normal);
  float least = std::numeric_limits<float>::infinity(), most = -least;
  for (const vec3& corner : tile.corners) {
    const float height = glm::dot(corner - position, normal);
    least = std::min(least, height);
    most = std::max(most, height);
  }
  return least < -kBehindTexels * tile.spacing && most > kBehindTexels * tile.spacing;
}

}  // namespace

bool isLightMapEligible(const shared::Vpl& vpl, const TilePlace& tile, float clampDistance) {
  const float brightest = brightness(vpl);
  const vec3 position(vpl.position), normal(vpl.normal), tangent(vpl.tangent);
  if (vpl.position.w == shared::kVplDirectional) {
    const vec3 bitangent = glm::cross(normal, tangent);
    vec2 least(std::numeric_limits<float>::infinity()), most(-least);
    for (const vec3& corner : tile.corners) {
      const vec3 v = corner - position;
      const vec2 q(glm::dot(v, tangent), glm::dot(v, bitangent));
      least = glm::min(least, q);
      most = glm::max(most, q);
    }
    const float inner = 0.999f * vpl.tangent.w, outer = 1.001f * vpl.tangent.w;
    const bool isWithin = least.x > -inner && least.y > -inner && most.x < inner && most.y < inner;
    const bool isOutside = least.x > outer || least.y > outer || most.x < -outer || most.y < -outer;
    return brightest <= kMostBrightness && (isWithin || isOutside);
  }
  if (isSpot(vpl)) return false;  // its edge may fall between two texels
  if (isCrossed(vpl, tile)) return false;
  const vec2 p = tile.chart.project(position);
  const vec2 off = p - glm::clamp(p, tile.patch.min, tile.patch.max);
  const float height = glm::dot(position - tile.chart.origin, tile.chart.normal);
  const float distance2 = glm::dot(off, off) + height * height;
  const float bounded = vpl.position.w == shared::kVplCosine
                            ? std::max(distance2, clampDistance * clampDistance)
                            : distance2;
  const float nearest = kNearTexels * tile.spacing;
  return distance2 >= nearest * nearest && brightest <= kMostBrightness * bounded;
}

EligibleLights::EligibleLights(std::span<const shared::Vpl> bySlot, std::span<const uint32_t> slots,
                               float clampDistance)
    : bySlot_(bySlot), clampDistance_(clampDistance) {
  for (const uint32_t slot : slots) {
    const shared::Vpl& vpl = bySlot[slot];
    if (vpl.position.w == shared::kVplDirectional || isSpot(vpl)) {
      others_.push_back(slot);
      continue;
    }
    slots_.push_back(slot);
    px_.push_back(vpl.position.x);
    py_.push_back(vpl.position.y);
    pz_.push_back(vpl.position.z);
    nx_.push_back(vpl.normal.x);
    ny_.push_back(vpl.normal.y);
    nz_.push_back(vpl.normal.z);
    brightest_.push_back(brightness(vpl));
    least_.push_back(vpl.position.w == shared::kVplCosine ? clampDistance * clampDistance : 0.0f);
  }
  const size_t whole =
      (slots_.size() + hn::MaxLanes(kTag) - 1) / hn::MaxLanes(kTag) * hn::MaxLanes(kTag);
  for (auto* v : {&px_, &py_, &pz_, &nx_, &ny_, &nz_, &brightest_, &least_}) v->resize(whole, 0.0f);
}

void EligibleLights::find(const TilePlace& tile, std::span<uint64_t> bits) const {
  const auto set = [&](uint32_t slot, bool is) {
    const uint64_t bit = uint64_t{1} << slot % 64;
    bits[slot / 64] = is ? bits[slot / 64] | bit : bits[slot / 64] & ~bit;
  };
  for (const uint32_t slot : others_)
    set(slot, isLightMapEligible(bySlot_[slot], tile, clampDistance_));
  const float behind = kBehindTexels * tile.spacing, nearest = kNearTexels * tile.spacing;
  const auto minus = [](const Vector3& a, const vec3& b) {
    return Vector3{hn::Sub(a.x, broadcast(b.x)), hn::Sub(a.y, broadcast(b.y)),
                   hn::Sub(a.z, broadcast(b.z))};
  };
  for (size_t i = 0; i < slots_.size(); i += hn::MaxLanes(kTag)) {
    const auto load = [i](const std::vector<float>& v) { return hn::LoadU(kTag, &v[i]); };
    const Vector3 position{load(px_), load(py_), load(pz_)},
        normal{load(nx_), load(ny_), load(nz_)};
    Floats lowest = broadcast(std::numeric_limits<float>::infinity()), highest = hn::Neg(lowest);
    for (const vec3& corner : tile.corners) {
      const Vector3 v{hn::Sub(broadcast(corner.x), position.x),
                      hn::Sub(broadcast(corner.y), position.y),
                      hn::Sub(broadcast(corner.z), position.z)};
      const Floats height = dotUnfused(v, normal);
      lowest = hn::Min(lowest, height);
      highest = hn::Max(highest, height);
    }
    const auto isCrossed =
        hn::And(hn::Lt(lowest, broadcast(-behind)), hn::Gt(highest, broadcast(behind)));
    const Vector3 v = minus(position, tile.chart.origin);
    const auto off = [](Floats p, float least, float most) {
      return hn::Sub(p, hn::Min(hn::Max(p, broadcast(least)), broadcast(most)));
    };
    const Floats x =
        off(dotUnfused(v, broadcast(tile.chart.tangent)), tile.patch.min.x, tile.patch.max.x);
    const Floats y =
        off(dotUnfused(v, broadcast(tile.chart.bitangent)), tile.patch.min.y, tile.patch.max.y);
    const Floats height = dotUnfused(v, broadcast(tile.chart.normal));
    const Floats distance2 =
        hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(height, height));
    const Floats bounded = hn::Max(distance2, load(least_));
    const auto isFar = hn::Ge(distance2, broadcast(nearest * nearest));
    const auto isFaint = hn::Le(load(brightest_), hn::Mul(broadcast(kMostBrightness), bounded));
    const uint32_t found = bitsOf(hn::AndNot(isCrossed, hn::And(isFar, isFaint)));
    for (size_t k = i; k < std::min(i + hn::MaxLanes(kTag), slots_.size()); ++k)
      set(slots_[k], (found >> (k - i) & 1) != 0);
  }
}

}  // namespace lamplighter
