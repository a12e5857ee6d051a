#include "renderer/sampling/point_visibility.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "shaders/shared/vpl_shading.h"

namespace lamplighter {
namespace {

Ray rayFrom(const SeenPoint& point, const vec4& position, const vec4& normal) {
  Ray ray{point.position, 0.0f, vec3(normal)};
  if (position.w != shared::kVplDirectional) {
    const vec3 way = vec3(position) - point.position;
    ray.tFar = glm::length(way);
    ray.direction = way / ray.tFar;
  }
  return ray;
}

// What moved, and a sphere about it, which most rays pass by.
struct Obstacle {
  Bounds box;
  vec3 middle;
  float radius2;  // m²
  explicit Obstacle(const Bounds& b) : box(b), middle(b.centre()) {
    const float radius = b.radius() + rayEpsilon(b.min) + rayEpsilon(b.max);
    radius2 = 1.01f * radius * radius;
  }

  bool mayBeBetween(const SeenPoint& point, const vec4& position, const vec4& normal) const {
    const vec3 to = middle - point.position;
    const bool isParallel = position.w == shared::kVplDirectional;
    const vec3 way = isParallel ? vec3(normal) : vec3(position) - point.position;
    const float along = std::max(glm::dot(to, way) / glm::dot(way, way), 0.0f);
    const vec3 off = to - (isParallel ? along : std::min(along, 1.0f)) * way;
    return glm::dot(off, off) <= radius2 && mayTouch(rayFrom(point, position, normal), box);
  }
};

// But for how bright it is.
bool isSamePlace(const shared::Vpl& a, const shared::Vpl& b) {
  return a.position == b.position && a.normal == b.normal && a.tangent == b.tangent;
}

}  // namespace

bool PointVisibility::Row::sees(const SeenPoint& point, size_t index, const RayCaster& rays) {
  if (!known_[index]) {
    known_[index] = true;
    seen_[index] = !rays.occluded(rayFrom(point, vpl_.position, vpl_.normal));
  }
  return seen_[index];
}

float PointVisibility::Row::geometry(const SeenPoint& point, size_t index) {
  if (!measured_[index]) {
    measured_[index] = true;
    geometry_[index] =
        shared::vplGeometry(vpl_, point.position, point.normal, point.normal, clampDistance_);
  }
  return geometry_[index];
}

void PointVisibility::outdate(const RenderSceneChanges& changes,
                              std::span<const MoverFinder::Mover> movers) {
  if (changes.rebuilt || changes.materials) {
    rows_.clear();
    return;
  }
  std::vector<Obstacle> obstacles;
  for (const MoverFinder::Mover& m : movers)
    for (const Bounds& box : {m.before, m.after})
      if (!box.empty()) obstacles.emplace_back(box);
  if (obstacles.empty()) return;
  std::vector<Row*> rows;
  for (auto& [id, row] : rows_) rows.push_back(&row);
  tbb::parallel_for(size_t{0}, rows.size(), [&](size_t r) {
    Row& row = *rows[r];
    for (size_t i = 0; i < points_.size(); ++i) {
      if (!row.known_[i]) continue;
      row.known_[i] = std::none_of(obstacles.begin(), obstacles.end(), [&](const Obstacle& o) {
        return o.mayBeBetween(points_[i], row.vpl_.position, row.vpl_.normal);
      });
    }
  });
}

std::vector<PointVisibility::Row*> PointVisibility::rows(std::span<const SceneVpl> lights,
                                                         std::span<const SeenPoint> points,
                                                         float clampDistance) {
  Points same;
  for (size_t i = 0; i < std::min(points.size(), points_.size()); ++i)
    same[i] = points[i] == points_[i];
  points_.assign(points.begin(), points.end());
  std::map<VplId, Row> kept;
  std::vector<Row*> out;
  out.reserve(lights.size());
  for (const SceneVpl& light : lights) {
    auto node = rows_.extract(light.id);
    const auto it =
        node.empty() ? kept.try_emplace(light.id).first : kept.insert(std::move(node)).position;
    Row& row = it->second;
    if (!isSamePlace(row.vpl_, light.vpl)) row = Row();
    if (row.clampDistance_ != clampDistance) row.measured_.reset();
    row.vpl_ = light.vpl;
    row.clampDistance_ = clampDistance;
    row.known_ &= same;
    row.measured_ &= same;
    row.geometry_.resize(points.size());
    out.push_back(&row);
  }
  rows_ = std::move(kept);
  return out;
}

}  // namespace lamplighter
