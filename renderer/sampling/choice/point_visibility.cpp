#include "renderer/sampling/choice/point_visibility.h"

#include <algorithm>
#include <bit>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"
#include "renderer/base/simd.h"
#include "renderer/scene/light_linking.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter {
namespace {

using Floats = Floats8;

using Vector3 = SimdVec3<Floats>;

Ray rayFrom(const vec3& point, const shared::Vpl& vpl) {
  Ray ray{point, 0.0f, vec3(vpl.normal)};
  if (vpl.position.w != shared::kVplDirectional) {
    const vec3 way = vec3(vpl.position) - point;
    ray.tFar = glm::length(way);
    ray.direction = way / ray.tFar;
  }
  return ray;
}

// Compares everything except the brightness.
bool isSamePlace(const shared::Vpl& a, const shared::Vpl& b) {
  return a.position == b.position && a.normal == b.normal && a.tangent == b.tangent;
}

// Conservative test whether a segment with the given middle, extending by ±half, touches a box
// around the origin with half-size `size`: separating axis test with the box axes and their cross
// products with the segment (Gottschalk, Lin and Manocha, "OBBTree", 1996).
hn::Mask<FloatTag> mayTouchBox(const Vector3& middle, const Vector3& half, const vec3& size) {
  const Vector3 along{hn::Abs(half.x), hn::Abs(half.y), hn::Abs(half.z)};
  const Vector3 e = broadcast(size);
  const auto isNear = [](Floats off, Floats way, Floats reach) {
    return hn::Le(hn::Abs(off), hn::Add(way, reach));
  };
  const auto isNearAcross = [](Floats m0, Floats m1, Floats h0, Floats h1, Floats reach) {
    return hn::Le(hn::Abs(hn::Sub(hn::Mul(m0, h1), hn::Mul(m1, h0))), reach);
  };
  const auto across = [](Floats e0, Floats e1, Floats a0, Floats a1) {
    return hn::MulAdd(e0, a1, hn::Mul(e1, a0));
  };
  const auto inX =
      hn::And(isNear(middle.x, along.x, e.x),
              isNearAcross(middle.y, middle.z, half.y, half.z, across(e.y, e.z, along.y, along.z)));
  const auto inY =
      hn::And(isNear(middle.y, along.y, e.y),
              isNearAcross(middle.z, middle.x, half.z, half.x, across(e.z, e.x, along.z, along.x)));
  const auto inZ =
      hn::And(isNear(middle.z, along.z, e.z),
              isNearAcross(middle.x, middle.y, half.x, half.y, across(e.x, e.y, along.x, along.y)));
  return hn::And(inX, hn::And(inY, inZ));
}

}  // namespace

// A moved object.
struct PointVisibility::Obstacle {
  Bounds box;
  float rounding;  // rounding error of its coordinates [m]
};

size_t PointVisibility::IdHash::operator()(const VplId& id) const {
  return hash4(id.light, id.emitter, id.bounce, id.index);
}

void PointVisibility::outdate(Row& row, std::span<const Obstacle> obstacles) const {
  const vec3 light(row.vpl.position);
  const bool isParallel = row.vpl.position.w == shared::kVplDirectional;
  const float rounding = points_.rounding() + rayEpsilon(light);
  for (size_t b = 0; b < kBlocks; ++b) {
    if (row.known[b] == 0) continue;
    if (isParallel) {
      for (uint32_t rest = row.known[b]; rest != 0; rest &= rest - 1) {
        const auto lane = static_cast<uint32_t>(std::countr_zero(rest));
        const Ray ray = rayFrom(points_.positions().at(b * kLanes + lane), row.vpl);
        if (std::any_of(obstacles.begin(), obstacles.end(),
                        [&](const Obstacle& o) { return mayTouch(ray, o.box); }))
          row.known[b] &= static_cast<uint8_t>(~(1u << lane));
      }
      continue;
    }
    const auto load = [&](const std::array<float, kMostPoints>& v) {
      return hn::Load(kTag, &v[b * kLanes]);
    };
    const PointBlocks::Vectors& positions = points_.positions();
    const Vector3 point{load(positions.x), load(positions.y), load(positions.z)};
    const Vector3 way = broadcast(light) - point;
    const Floats half = broadcast(0.5f);
    const Vector3 halfWay{hn::Mul(way.x, half), hn::Mul(way.y, half), hn::Mul(way.z, half)};
    for (const Obstacle& o : obstacles) {
      const vec3 centre = o.box.centre();
      const Vector3 middle = broadcast(light - centre) - halfWay;
      const vec3 size = 0.5f * (o.box.max - o.box.min) + 2.0f * (rounding + o.rounding);
      row.known[b] &= static_cast<uint8_t>(~bitsOf(mayTouchBox(middle, halfWay, size)));
    }
  }
}

void PointVisibility::outdate(const RenderSceneChanges& changes,
                              std::span<const MoverFinder::Mover> movers) {
  if (changes.rebuilt || changes.materials) {
    rows_.clear();
    known_.clear();
    return;
  }
  std::vector<Obstacle> obstacles;
  for (const MoverFinder::Mover& m : movers)
    for (const Bounds& box : {m.before, m.after})
      if (!box.empty()) obstacles.push_back({box, rayEpsilon(box.min) + rayEpsilon(box.max)});
  if (obstacles.empty()) return;
  tbb::parallel_for(size_t{0}, known_.size(),
                    [&](size_t i) { outdate(*known_[i].row, obstacles); });
}

void PointVisibility::takePoints(std::span<const SeenPoint> points) {
  same_ = {};
  for (size_t i = 0; i < std::min(points.size(), points_.size()); ++i)
    if (points[i] == points_.at(i)) same_[i / kLanes] |= static_cast<uint8_t>(1u << i % kLanes);
  points_ = PointBlocks(points);
}

// Most lights keep their position in the list; only the others are searched.
void PointVisibility::findRows(std::span<const SceneVpl> lights) {
  constexpr size_t kAhead = 8;  // larger than the number of VPLs of one or two removed paths
  std::vector<Known> found;
  found.reserve(lights.size());
  std::vector<uint8_t> isFound(known_.size(), 0);
  size_t next = 0;
  for (const SceneVpl& light : lights) {
    size_t i = next;
    const size_t end = std::min(next + kAhead, known_.size());
    while (i < end && known_[i].id != light.id) ++i;
    if (i < end) {
      found.push_back(known_[i]);
    } else {
      const auto [it, isNew] = rows_.try_emplace(light.id);
      found.push_back({light.id, &it->second});
      if (isNew) continue;
      i = it->second.at;
    }
    isFound[i] = 1;
    next = i + 1;
  }
  for (size_t i = 0; i < known_.size(); ++i)
    if (isFound[i] == 0) rows_.erase(known_[i].id);
  known_ = std::move(found);
}

void PointVisibility::take(const shared::Vpl& light, float clampDistance, size_t at,
                           Row& row) const {
  if (!isSamePlace(row.vpl, light)) row = Row();
  if (row.clampDistance != clampDistance) row.measured = 0;
  row.vpl = light;
  row.clampDistance = clampDistance;
  row.at = at;
  for (size_t b = 0; b < kBlocks; ++b) {
    row.known[b] &= same_[b];
    if (same_[b] != 0xff) row.measured &= ~(1u << b);
  }
}

void PointVisibility::fill(Row& row, const RayCaster& rays, float* out) const {
  const Floats brightness = broadcast(luminance(row.vpl.intensity));
  const auto link = static_cast<uint32_t>(row.vpl.footprint.y);
  for (size_t b = 0; b < kBlocks; ++b) {
    const size_t first = b * kLanes;
    if (first >= points_.size()) {
      hn::StoreU(hn::Zero(kTag), kTag, out + first);
      continue;
    }
    if ((row.measured >> b & 1) == 0)
      points_.geometry(row.vpl, row.clampDistance, b, &row.geometry[first]);
    row.measured |= 1u << b;
    const Floats bare = hn::Mul(brightness, hn::Load(kTag, &row.geometry[first]));
    const size_t count = std::min(points_.size() - first, kLanes);
    const uint32_t lit =
        bitsOf(hn::Gt(bare, hn::Zero(kTag))) & ((1u << count) - 1) & ~points_.leftOut(link, b);
    for (uint32_t rest = lit & ~uint32_t{row.known[b]}; rest != 0; rest &= rest - 1) {
      const auto lane = static_cast<uint32_t>(std::countr_zero(rest));
      const uint32_t bit = 1u << lane;
      const bool isSeen = !rays.occluded(rayFrom(points_.at(first + lane).position, row.vpl));
      row.seen[b] = static_cast<uint8_t>(isSeen ? row.seen[b] | bit : row.seen[b] & ~bit);
      row.known[b] |= static_cast<uint8_t>(bit);
    }
    const auto seen = static_cast<uint8_t>(lit & row.seen[b]);
    const uint8_t mask[8] = {seen};
    hn::StoreU(hn::IfThenElseZero(hn::LoadMaskBits(kTag, mask), bare), kTag, out + first);
  }
}

std::span<const float> PointVisibility::irradiance(std::span<const SceneVpl> lights,
                                                   std::span<const SeenPoint> points,
                                                   const RayCaster& rays, float clampDistance) {
  takePoints(points);
  findRows(lights);
  irradiance_.resize(lights.size() * kMostPoints);
  tbb::parallel_for(size_t{0}, lights.size(), [&](size_t i) {
    Row& row = *known_[i].row;
    take(lights[i].vpl, clampDistance, i, row);
    fill(row, rays, &irradiance_[i * kMostPoints]);
  });
  return irradiance_;
}

}  // namespace lamplighter
