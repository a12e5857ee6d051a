#include "renderer/visibility/occlusion/occlusion_pyramid.h"

#include <algorithm>
#include <cmath>

#include "renderer/raycast/ray_caster.h"
#include "renderer/visibility/occlusion/back_facing_lights.h"

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
    : vpl_(vpl), region_(region), light_(vpl), margin_(std::max(light_.rounding, region.rounding)) {
  const LightLanes<OneLight> light = lanesOf(light_, region);
  const BackFacingLights sides(light, region);
  isDark_ = sides.dark != 0;
  isDegenerate_ = sides.degenerate != 0;
  if (isDark_ || isDegenerate_) return;
  if (!light_.isParallel) add(light_.normal, hn::GetLane(lightPlane(light).offset));
  if (!region.isBox()) {
    const auto plane = patchPlane(light, region);
    const vec3 up(hn::GetLane(plane.normal.x), hn::GetLane(plane.normal.y),
                  hn::GetLane(plane.normal.z));
    add(up, hn::GetLane(plane.offset));
    addPatchSides(up);
    return;
  }
  // Geometry inside the box always counts as met, so the pyramid needs no sides: it is only used to
  // find full occluders.
  const vec3 &low = region.corners[0], &high = region.corners[7];
  const vec3 &apex = light_.position, &towards = light_.normal;
  for (int c = 0; c < 3; ++c) {
    vec3 n(0.0f);
    n[c] = 1.0f;
    const float slack = 3.0f * margin_;
    if (light_.isParallel ? towards[c] >= 0.0f : apex[c] >= low[c]) add(n, slack - low[c]);
    if (light_.isParallel ? towards[c] <= 0.0f : apex[c] <= high[c]) add(-n, slack + high[c]);
  }
}

void OcclusionPyramid::add(const vec3& normal, float offset) {
  const auto i = static_cast<size_t>(count_++);
  planes_.x[i] = normal.x;
  planes_.y[i] = normal.y;
  planes_.z[i] = normal.z;
  planes_.offset[i] = offset;
}

// Computes the planes through the four edges of a rectangle at once.
void OcclusionPyramid::addPatchSides(const vec3& up) {
  const hn::FixedTag<float, 4> tag;
  using Vec = hn::Vec<decltype(tag)>;
  const auto load4 = [&](const std::array<std::array<float, 4>, 3>& v) {
    return SimdVec3<Vec>{hn::LoadU(tag, v[0].data()), hn::LoadU(tag, v[1].data()),
                         hn::LoadU(tag, v[2].data())};
  };
  const SimdVec3<Vec> from = load4(region_.from);
  const SimdVec3<Vec> way =
      light_.isParallel ? setLanes(tag, light_.normal) : from - setLanes(tag, light_.position);
  const PlaneLanes<Vec> planes = sidePlanes(
      tag, from, load4(region_.sides), way, setLanes(tag, region_.middle()), setLanes(tag, up),
      setLanes(tag, region_.thickness), setLanes(tag, margin_), light_.isParallel);
  const auto i = static_cast<size_t>(count_);
  hn::StoreU(planes.normal.x, tag, &planes_.x[i]);
  hn::StoreU(planes.normal.y, tag, &planes_.y[i]);
  hn::StoreU(planes.normal.z, tag, &planes_.z[i]);
  hn::StoreU(planes.offset, tag, &planes_.offset[i]);
  count_ += 4;
}

OccluderPolygon::OccluderPolygon(std::span<const vec3> outline, const vec3& n)
    : corners(outline.begin(), outline.end()), normal(n) {
  for (size_t i = 0; i < corners.size(); ++i) {
    const vec3 edge = corners[(i + 1) % corners.size()] - corners[i];
    edges.push_back({glm::cross(n, edge), glm::length(edge)});
    box.add(corners[i]);
  }
}

}  // namespace lamplighter
