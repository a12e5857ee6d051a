#include "renderer/visibility/occlusion/occlusion_pyramid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/base/simd.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/visibility/occlusion/pyramid_sides.h"

namespace lamplighter {
namespace {

float roundingAt(std::span<const vec3> points) {
  vec3 farthest(0.0f);
  for (const vec3& p : points) farthest = glm::max(farthest, glm::abs(p));
  return rayEpsilon(farthest);
}

}  // namespace

PatchRegion::PatchRegion(const Bounds& box) : count(8), centre(box.centre()), radius(box.radius()) {
  for (int i = 0; i < 8; ++i) {
    for (int c = 0; c < 3; ++c)
      corners[static_cast<size_t>(i)][c] = ((i >> c) & 1) != 0 ? box.max[c] : box.min[c];
  }
  rounding = roundingAt(points());
}

PatchRegion::PatchRegion(const RenderScene& scene, uint32_t index, const ObjectPatches& patches,
                         const Patch& patch) {
  if (patch.chart == kNone) {
    *this = PatchRegion(patch.box);
    return;
  }
  const Chart& its = patches.charts[static_cast<size_t>(patch.chart)];
  count = 4;
  corners = {its.at(patch.min), its.at({patch.max.x, patch.min.y}), its.at(patch.max),
             its.at({patch.min.x, patch.max.y})};
  centre = patch.centre;
  radius = patch.radius;
  normal = its.normal;
  thickness = its.thickness;
  frontOnly = scene.backIsUnseen(index);
  if (its.isRough) {
    object = static_cast<int>(index);
    chart = patch.chart;
  }
  vec3 farthest;
  for (int c = 0; c < 3; ++c) {
    const auto i = static_cast<size_t>(c);
    from[i] = {corners[0][c], corners[1][c], corners[2][c], corners[3][c]};
    sides[i] = {from[i][1] - from[i][0], from[i][2] - from[i][1], from[i][3] - from[i][2],
                from[i][0] - from[i][3]};
    farthest[c] = std::max(std::max(std::abs(from[i][0]), std::abs(from[i][1])),
                           std::max(std::abs(from[i][2]), std::abs(from[i][3])));
  }
  rounding = rayEpsilon(farthest);
}

OcclusionPyramid::OcclusionPyramid(const shared::Vpl& vpl, const PatchRegion& region)
    : vpl_(vpl),
      region_(region),
      parallel_(vpl.position.w == shared::kVplDirectional),
      apex_(vpl.position),
      towards_(vpl.normal),
      margin_(parallel_ ? region.rounding : std::max(rayEpsilon(apex_), region.rounding)) {
  const float slab = region_.thickness + margin_;
  // Patch points further behind the planes than rounding errors get exactly no light (vplGeometry),
  // not just little.
  const float behind = region_.thickness + kSumsRounding * margin_;

  // Only the half-space in front of the light gets light. Geometry in the light's plane, mainly the
  // surface of the light, does not count as between.
  if (!parallel_) {
    const auto height = [&](const vec3& p) { return glm::dot(p - apex_, towards_); };
    dark_ = std::all_of(region_.points().begin(), region_.points().end(),
                        [&](const vec3& c) { return height(c) <= -behind; });
    if (dark_) return;
    add(towards_, apex_, -margin_);
  }

  const bool isRough = region_.chart != kNone;
  if (!region_.isBox()) {
    const vec3 middle = region_.middle();
    const float height =
        parallel_ ? glm::dot(towards_, region_.normal) : glm::dot(apex_ - middle, region_.normal);
    // The bumps of a rough patch may face the light before the patch does.
    float turned = 0.0f;
    if (isRough) turned = parallel_ ? 1.0f : glm::distance(apex_, middle) + region_.radius;
    turned *= kRoughSine;
    dark_ = region_.frontOnly && height <= (parallel_ ? -1e-4f : -behind) - turned;
    if (dark_) return;
    degenerate_ = std::abs(height) <= (parallel_ ? 1e-4f : 4.0f * slab);
    if (degenerate_) return;
    // Geometry in the plane of the patch, mainly the patch itself, does not count as between.
    const vec3 up = height > 0.0f ? region_.normal : -region_.normal;
    // On a rough patch there may be geometry between its bumps.
    add(up, middle, isRough ? slab : -3.0f * slab);
    addSides(middle, up);
    return;
  }
  const vec3 &low = region_.corners[0], &high = region_.corners[7];
  bool inside = !parallel_;
  for (int c = 0; c < 3; ++c) {
    vec3 n(0.0f);
    n[c] = 1.0f;
    if (parallel_ ? towards_[c] >= 0.0f : apex_[c] >= low[c]) add(n, low, 3.0f * margin_);
    if (parallel_ ? towards_[c] <= 0.0f : apex_[c] <= high[c]) add(-n, high, 3.0f * margin_);
    inside = inside && apex_[c] >= low[c] - margin_ && apex_[c] <= high[c] + margin_;
  }
  // Geometry inside the box always counts as met, so the pyramid needs no sides: it is only used to
  // find full occluders.
  degenerate_ = inside;
}

void OcclusionPyramid::add(const vec3& normal, const vec3& on, float margin) {
  if (count_ == PyramidPlanes::kMost) return;  // fewer planes: larger, conservative
  const auto i = static_cast<size_t>(count_++);
  planes_.x[i] = normal.x;
  planes_.y[i] = normal.y;
  planes_.z[i] = normal.z;
  planes_.offset[i] = margin - glm::dot(normal, on);
}

// Computes all four sides at once.
void OcclusionPyramid::addSides(const vec3& middle, const vec3& up) {
  const hn::FixedTag<float, 4> tag;
  using Vec = hn::Vec<decltype(tag)>;
  const auto set = [&](const vec3& v) {
    return SimdVec3<Vec>{hn::Set(tag, v.x), hn::Set(tag, v.y), hn::Set(tag, v.z)};
  };
  const auto load = [&](const std::array<std::array<float, 4>, 3>& v) {
    return SimdVec3<Vec>{hn::LoadU(tag, v[0].data()), hn::LoadU(tag, v[1].data()),
                         hn::LoadU(tag, v[2].data())};
  };
  const SimdVec3<Vec> from = load(region_.from), apex = set(apex_);
  const SimdVec3<Vec> way = parallel_ ? set(towards_) : from - apex;
  const SidePlanes<Vec> planes =
      sidePlanes(tag, from, load(region_.sides), way, set(middle), set(up),
                 hn::Set(tag, region_.thickness), hn::Set(tag, margin_), parallel_);
  const auto i = static_cast<size_t>(count_);
  hn::StoreU(planes.normal.x, tag, &planes_.x[i]);
  hn::StoreU(planes.normal.y, tag, &planes_.y[i]);
  hn::StoreU(planes.normal.z, tag, &planes_.z[i]);
  hn::StoreU(planes.offset, tag, &planes_.offset[i]);
  count_ += 4;
}

bool OcclusionPyramid::mayMeet(const Bounds& box) const {
  const vec3 centre = box.centre(), half = 0.5f * box.extent();
  const auto zero = hn::Zero(kTag);
  for (int first = 0; first < count_; first += hn::MaxLanes(kTag)) {
    const auto x = hn::LoadU(kTag, &planes_.x[static_cast<size_t>(first)]);
    const auto y = hn::LoadU(kTag, &planes_.y[static_cast<size_t>(first)]);
    const auto z = hn::LoadU(kTag, &planes_.z[static_cast<size_t>(first)]);
    auto farthest = hn::LoadU(kTag, &planes_.offset[static_cast<size_t>(first)]);
    farthest = hn::MulAdd(x, hn::Set(kTag, centre.x), farthest);
    farthest = hn::MulAdd(y, hn::Set(kTag, centre.y), farthest);
    farthest = hn::MulAdd(z, hn::Set(kTag, centre.z), farthest);
    farthest = hn::MulAdd(hn::Abs(x), hn::Set(kTag, half.x), farthest);
    farthest = hn::MulAdd(hn::Abs(y), hn::Set(kTag, half.y), farthest);
    farthest = hn::MulAdd(hn::Abs(z), hn::Set(kTag, half.z), farthest);
    if (!hn::AllFalse(kTag, hn::Lt(farthest, zero))) return false;
  }
  return true;
}

bool OcclusionPyramid::mayMeetSphere(const vec3& centre, float radius) const {
  auto farthest = hn::LoadU(kTag, planes_.offset.data());
  farthest = hn::MulAdd(hn::LoadU(kTag, planes_.x.data()), hn::Set(kTag, centre.x), farthest);
  farthest = hn::MulAdd(hn::LoadU(kTag, planes_.y.data()), hn::Set(kTag, centre.y), farthest);
  farthest = hn::MulAdd(hn::LoadU(kTag, planes_.z.data()), hn::Set(kTag, centre.z), farthest);
  static_assert(PyramidPlanes::kMost == hn::MaxLanes(kTag));
  return hn::AllFalse(kTag, hn::Lt(farthest, hn::Set(kTag, -radius)));
}

bool OcclusionPyramid::mayBeOutside(const vec3& point, float margin) const {
  auto distance = hn::LoadU(kTag, planes_.offset.data());
  distance = hn::MulAdd(hn::LoadU(kTag, planes_.x.data()), hn::Set(kTag, point.x), distance);
  distance = hn::MulAdd(hn::LoadU(kTag, planes_.y.data()), hn::Set(kTag, point.y), distance);
  distance = hn::MulAdd(hn::LoadU(kTag, planes_.z.data()), hn::Set(kTag, point.z), distance);
  static_assert(PyramidPlanes::kMost == hn::MaxLanes(kTag));
  return !hn::AllFalse(kTag, hn::Lt(distance, hn::Set(kTag, margin)));
}

OcclusionPyramid::Axis::Axis(const OcclusionPyramid& p)
    : last_(p.parallel_ ? std::numeric_limits<float>::max() : 1.0f) {
  const PatchRegion& region = p.region_;
  const vec3 middle = region.middle();
  const float margin = 8.0f * (p.margin_ + region.thickness);
  low_ = middle - margin;
  high_ = middle + margin;
  const vec3 way = p.parallel_ ? p.towards_ : p.apex_ - middle;
  for (int c = 0; c < 3; ++c)
    inverse_[c] = 1.0f / (std::abs(way[c]) > 1e-20f ? way[c] : std::copysign(1e-20f, way[c]));
}

OccluderPolygon::OccluderPolygon(std::span<const vec3> outline, const vec3& n)
    : corners(outline.begin(), outline.end()), normal(n) {
  for (size_t i = 0; i < corners.size(); ++i) {
    const vec3 edge = corners[(i + 1) % corners.size()] - corners[i];
    edges.push_back({glm::cross(n, edge), glm::length(edge)});
    box.add(corners[i]);
  }
}

bool OcclusionPyramid::isCutBy(const OccluderPolygon& polygon) const {
  const vec3 &on = polygon.corners[0], &n = polygon.normal;
  const float inset = 8.0f * margin_ + region_.thickness;
  const float lightSide = parallel_ ? glm::dot(n, towards_) : glm::dot(n, apex_ - on);
  if (std::abs(lightSide) <= (parallel_ ? 1e-4f : inset)) return false;
  const auto isCut = [&](const vec3& corner) {
    const float side = glm::dot(n, corner - on);
    if (side * lightSide >= 0.0f || std::abs(side) <= inset) return false;
    const vec3 across = parallel_ ? corner - (side / lightSide) * towards_
                                  : apex_ + (lightSide / (lightSide - side)) * (corner - apex_);
    for (size_t i = 0; i < polygon.edges.size(); ++i) {
      const OccluderPolygon::Edge& edge = polygon.edges[i];
      if (glm::dot(edge.inwards, across - polygon.corners[i]) < inset * edge.length) return false;
    }
    return true;
  };
  // A rough patch has the thickness of its bumps, which matters at grazing angles.
  const vec3 bump = region_.chart != kNone ? region_.thickness * region_.normal : vec3(0.0f);
  for (const vec3& corner : region_.points())
    if (!isCut(corner + bump) || (region_.chart != kNone && !isCut(corner - bump))) return false;
  return true;
}

}  // namespace lamplighter
