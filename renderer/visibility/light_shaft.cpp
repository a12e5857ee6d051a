// x86-64-v3 has no AES instructions, which Highway wants of its AVX2 target unless told otherwise.
#define HWY_DISABLE_PCLMUL_AES 1

#include "renderer/visibility/light_shaft.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <hwy/highway.h>

#include "renderer/raycast/ray_caster.h"

namespace lamplighter {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
constexpr int kLanes = 8;
constexpr hn::FixedTag<float, kLanes> kTag;

constexpr float kRounding = 2e-6f;

// A pyramid is a little wider than light and patch, by margins for rounding
// (occlusion_pyramid.cpp): its sides by less than this many at the light, ...
constexpr float kMargins = 8.0f;
// ... and where that grows to more than this by a side that hardly leaves the patch, it is left out
// [m].
constexpr float kWidest = 0.25f;

// Where lights are, eight at a time.
class Places {
 public:
  static constexpr size_t kMost = 64;

  // `reach`: of the pyramid past the light.
  void set(size_t i, const vec3& place, float reach) {
    x_[i] = place.x;
    y_[i] = place.y;
    z_[i] = place.z;
    reach_[i] = reach;
  }
  // The last eight are filled up with the first.
  void fill(size_t count) {
    for (; count % kLanes != 0; ++count) set(count, at(0), reach_[0]);
  }
  vec3 at(size_t i) const { return {x_[i], y_[i], z_[i]}; }

  // The least of dot(n, x) over what reaches past the lights.
  float least(const vec3& n, size_t count) const {
    auto least = hn::Set(kTag, std::numeric_limits<float>::max());
    for (size_t i = 0; i < count; i += kLanes) {
      const auto reach = hn::Load(kTag, &reach_[i]);
      least = hn::Min(least, hn::Sub(along(n, i, vec3(0.0f)), reach));
    }
    return hn::GetLane(hn::MinOfLanes(kTag, least));
  }
  // The most that a light lies outwards as seen from a place, over how high it lies.
  float steepest(const vec3& out, const vec3& up, const vec3& from, size_t count) const {
    auto most = hn::Set(kTag, -std::numeric_limits<float>::max());
    for (size_t i = 0; i < count; i += kLanes)
      most = hn::Max(most, hn::Div(along(out, i, from), along(up, i, from)));
    return hn::GetLane(hn::MaxOfLanes(kTag, most));
  }

 private:
  // As glm adds it up.
  hn::Vec<decltype(kTag)> along(const vec3& n, size_t i, const vec3& from) const {
    const auto part = [&](float normal, const float* places, float begin) {
      return hn::Mul(hn::Set(kTag, normal), hn::Sub(hn::Load(kTag, places), hn::Set(kTag, begin)));
    };
    return hn::Add(hn::Add(part(n.x, &x_[i], from.x), part(n.y, &y_[i], from.y)),
                   part(n.z, &z_[i], from.z));
  }

  alignas(32) std::array<float, kMost> x_, y_, z_, reach_;
};

}  // namespace

LightShaft::LightShaft(std::span<const shared::Vpl* const> lights, const PatchRegion& region) {
  least_.fill(-1.0f);
  const vec3 middle = 0.5f * (region.corners[0] + region.corners[2]);
  const float width = 0.5f * std::min(glm::distance(region.corners[0], region.corners[1]),
                                      glm::distance(region.corners[1], region.corners[2]));
  const auto heightOf = [&](const shared::Vpl& v) {
    return glm::dot(vec3(v.position) - middle, region.normal);
  };
  float side = 0.0f;
  Places points;
  size_t count = 0;
  float atBase = 0.0f, leastSlab = std::numeric_limits<float>::max(), mostSlab = 0.0f;
  const shared::Vpl* like = nullptr;
  bool areAlike = true;
  for (size_t i = 0; i < lights.size() && i < Places::kMost; ++i) {
    const shared::Vpl& v = *lights[i];
    const vec3 p(v.position);
    const float h = heightOf(v), height = std::abs(h);
    const float slab = region.thickness + std::max(rayEpsilon(p), region.rounding);
    const float away = glm::distance(p, middle) + region.radius;
    if (height <= 8.0f * slab || width <= 8.0f * slab || (side != 0.0f && side * h < 0.0f))
      continue;
    // Two sides that lean apart by the width of the patch as it is seen meet so far past the light,
    const float past = kMargins * slab * away / height * away / width;
    // and one that leans over the patch meets it so far from its edge.
    const float before = kMargins * slab * away / height;
    if (!(past <= kWidest) || !(before <= kWidest)) continue;
    side = h > 0.0f ? 1.0f : -1.0f;
    held_ |= uint64_t{1} << i;
    reach_ = std::max(reach_, std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
    points.set(count++, p, past);
    atBase = std::max(atBase, before);
    leastSlab = std::min(leastSlab, slab);
    mostSlab = std::max(mostSlab, slab);
    if (like == nullptr) like = &v;
    areAlike = areAlike &&
               glm::all(glm::lessThan(glm::abs(vec3(v.normal) - vec3(like->normal)), vec3(1e-6f)));
  }
  if (count == 0) return;
  points.fill(count);
  for (const vec3& c : region.points())
    reach_ = std::max(reach_, std::abs(c.x) + std::abs(c.y) + std::abs(c.z));

  // The least of dot(n, x) over what holds all pyramids: the lights and the patch, widened.
  const auto support = [&](const vec3& n) {
    float least = std::numeric_limits<float>::max();
    for (const vec3& c : region.points()) least = std::min(least, glm::dot(n, c) - 3.0f * atBase);
    return std::min(least, points.least(n, count));
  };
  const vec3 up = side * region.normal;
  // The pyramids end over the patch, by three times the slab; those of rough patches under it.
  add(up, glm::dot(up, middle) + (region.chart != kNone ? -2.0f * mostSlab : leastSlab));
  add(-up, support(-up));
  if (areAlike) {
    // Only what is over the plane of the lights gets light.
    const vec3 n(like->normal);
    float least = std::numeric_limits<float>::max(), farthest = 0.0f;
    for (size_t i = 0; i < count; ++i) {
      least = std::min(least, glm::dot(n, points.at(i)));
      farthest = std::max(farthest, glm::distance(points.at(i), middle));
    }
    // Normals differ by rounding.
    add(n, least - 4e-6f * (farthest + 2.0f * region.radius));
  }
  // Through each edge and the outermost of the lights, as seen from the patch.
  for (size_t i = 0; i < 4; ++i) {
    const vec3 &from = region.corners[i], &to = region.corners[(i + 1) % 4];
    const vec3 along = glm::normalize(to - from);
    const vec3 out = glm::cross(along, up);
    const float outwards = glm::dot(out, from - middle) > 0.0f ? 1.0f : -1.0f;
    const float most = points.steepest(outwards * out, up, from, count);
    const vec3 inwards = glm::normalize(most * up - outwards * out);
    add(inwards, support(inwards));
  }
  // And a box around all.
  for (int c = 0; c < 3; ++c) {
    for (const float sign : {1.0f, -1.0f}) {
      vec3 n(0.0f);
      n[c] = sign;
      add(n, support(n));
    }
  }
}

void LightShaft::add(const vec3& normal, float least) {
  const auto i = static_cast<size_t>(count_++);
  x_[i] = normal.x;
  y_[i] = normal.y;
  z_[i] = normal.z;
  least_[i] = least;
}

bool LightShaft::mayMeet(const Bounds& box) const {
  const vec3 centre = box.centre(), half = 0.5f * box.extent();
  // What sums of such places are rounded by.
  const auto slack = hn::Set(
      kTag, kRounding * (std::abs(centre.x) + std::abs(centre.y) + std::abs(centre.z) + reach_));
  for (size_t first = 0; first < static_cast<size_t>(count_); first += kLanes) {
    const auto x = hn::LoadU(kTag, &x_[first]), y = hn::LoadU(kTag, &y_[first]),
               z = hn::LoadU(kTag, &z_[first]);
    auto most = slack;
    most = hn::MulAdd(x, hn::Set(kTag, centre.x), most);
    most = hn::MulAdd(y, hn::Set(kTag, centre.y), most);
    most = hn::MulAdd(z, hn::Set(kTag, centre.z), most);
    most = hn::MulAdd(hn::Abs(x), hn::Set(kTag, half.x), most);
    most = hn::MulAdd(hn::Abs(y), hn::Set(kTag, half.y), most);
    most = hn::MulAdd(hn::Abs(z), hn::Set(kTag, half.z), most);
    if (!hn::AllFalse(kTag, hn::Lt(most, hn::LoadU(kTag, &least_[first])))) return false;
  }
  return true;
}

}  // namespace lamplighter
