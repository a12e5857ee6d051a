#include "renderer/imperfect_maps/occluder_groups.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

bool isOccluder(const RenderScene& scene, const RenderObject& object) {
  return !object.isEmpty() && !scene.materials[static_cast<size_t>(object.material)].isClear();
}

std::shared_ptr<const OccluderOrder> orderOfObject(const RenderScene& scene, uint32_t object) {
  const RenderObject& o = scene.objects[object];
  return std::make_shared<OccluderOrder>(occluderOrderOf(
      scene.localPositions, std::span(scene.indices).subspan(o.firstIndex, o.indexCount)));
}

// Computes everything except the index range of the group.
void measureGroup(const RenderScene& scene, OccluderGroup& group,
                  std::span<OccluderTriangle> triangles) {
  const uint32_t* indices = &scene.indices[scene.objects[group.object].firstIndex];
  const auto cornerOf = [&](const OccluderTriangle& t, uint32_t i) -> const vec3& {
    return scene.positions[indices[size_t{3} * t.triangle + i]];
  };
  const vec3 origin = cornerOf(triangles[0], 0);
  vec3 centres(0.0f), facing(0.0f), mixed(0.0f);
  float area = 0.0f;
  for (OccluderTriangle& t : triangles) {
    const vec3 a = cornerOf(t, 0) - origin, b = cornerOf(t, 1) - origin,
               c = cornerOf(t, 2) - origin;
    const vec3 normal = glm::cross(b - a, c - a);
    const float twice = glm::length(normal), own = 0.5f * twice;
    t.areaUpTo = area += own;
    if (!(own > 0.0f)) continue;
    const vec3 n = normal / twice;
    centres += own / 3.0f * (a + b + c);
    facing += own * n * n;
    mixed += own * vec3(n.y * n.z, n.z * n.x, n.x * n.y);
  }
  group.area = area;
  group.facing = facing;
  group.facingMixed = mixed;
  group.centre = area > 0.0f ? origin + centres / area : origin;
  float square = 0.0f;
  for (const OccluderTriangle& t : triangles) {
    for (uint32_t i = 0; i < 3; ++i) {
      const vec3 away = cornerOf(t, i) - group.centre;
      square = std::max(square, glm::dot(away, away));
    }
  }
  group.radius = std::sqrt(square);
}

}  // namespace

OccluderGroups::OccluderGroups(const RenderScene& scene) {
  RenderSceneChanges all;
  all.rebuilt = true;
  update(scene, all);
}

bool OccluderGroups::update(const RenderScene& scene, const RenderSceneChanges& changes) {
  if (!changes.surfaces()) return false;
  const bool isRebuilt = changes.rebuilt;
  if (isRebuilt) {
    objects_.clear();
    groups_.clear();
    triangles_.clear();
  }
  objects_.resize(scene.objects.size());
  std::vector<uint8_t> isStale(objects_.size(), isRebuilt ? 1 : 0);
  for (const uint32_t object : changes.movedObjects) isStale[object] = 1;
  findOrders(scene, isStale, isRebuilt);
  const bool isPlacedAnew = place(scene, isStale);
  std::vector<uint32_t> measured;
  for (uint32_t i = 0; i < objects_.size(); ++i)
    if (isStale[i] != 0 && objects_[i].groups > 0) measured.push_back(i);
  tbb::parallel_for(size_t{0}, measured.size(), [&](size_t i) { measure(scene, measured[i]); });
  return isRebuilt || isPlacedAnew || !measured.empty();
}

void OccluderGroups::findOrders(const RenderScene& scene, std::span<const uint8_t> isStale,
                                bool isRebuilt) {
  std::map<MeshPart, std::shared_ptr<const OccluderOrder>> used;
  std::vector<uint32_t> missing;  // objects; one of each mesh
  const auto keyOf = [&](uint32_t i) {
    return MeshPart(scene.slots[i].mesh, scene.slots[i].primitive);
  };
  const auto needsOrder = [&](uint32_t i) {
    if (!isOccluder(scene, scene.objects[i])) return false;
    // The surfaces of area lights have their own shapes, which change with the light.
    return objects_[i].order == nullptr || (isStale[i] != 0 && scene.slots[i].mesh == nullptr);
  };
  for (uint32_t i = 0; i < objects_.size(); ++i) {
    if (!needsOrder(i)) continue;
    if (scene.slots[i].mesh == nullptr) {
      missing.push_back(i);
      continue;
    }
    const auto known = orders_.find(keyOf(i));
    const auto [entry, isNew] =
        used.try_emplace(keyOf(i), known == orders_.end() ? nullptr : known->second);
    if (isNew && entry->second == nullptr) missing.push_back(i);
  }
  tbb::parallel_for(size_t{0}, missing.size(), [&](size_t m) {
    objects_[missing[m]].order = orderOfObject(scene, missing[m]);
  });
  for (const uint32_t i : missing)
    if (scene.slots[i].mesh != nullptr) used[keyOf(i)] = objects_[i].order;
  if (!isRebuilt) used.merge(orders_);
  orders_ = std::move(used);
  for (uint32_t i = 0; i < objects_.size(); ++i)
    if (objects_[i].order == nullptr && isOccluder(scene, scene.objects[i]))
      objects_[i].order = orders_.at(keyOf(i));
}

// Assigns to each object its part of the arrays. If a part changed, moves the known data there, and
// marks objects without old data as stale. Returns whether any part changed.
bool OccluderGroups::place(const RenderScene& scene, std::vector<uint8_t>& isStale) {
  std::vector<Object> placed = objects_;
  bool differs = false;
  uint32_t groups = 0, triangles = 0;
  for (uint32_t i = 0; i < placed.size(); ++i) {
    Object& o = placed[i];
    o.firstGroup = groups;
    o.firstTriangle = triangles;
    const bool isShown = isOccluder(scene, scene.objects[i]);
    o.groups = isShown ? static_cast<uint32_t>(o.order->ends.size()) : 0;
    o.triangles = isShown ? static_cast<uint32_t>(o.order->triangles.size()) : 0;
    if (!isShown) o.area = 0.0;
    if (isShown && objects_[i].groups == 0) isStale[i] = 1;
    differs = differs || o.groups != objects_[i].groups || o.triangles != objects_[i].triangles;
    groups += o.groups;
    triangles += o.triangles;
  }
  if (!differs) return false;
  std::vector<OccluderGroup> newGroups(groups);
  std::vector<OccluderTriangle> newTriangles(triangles);
  for (uint32_t i = 0; i < placed.size(); ++i) {
    const Object &from = objects_[i], &to = placed[i];
    if (to.groups == 0 || isStale[i] != 0) continue;
    std::copy_n(groups_.begin() + from.firstGroup, to.groups, newGroups.begin() + to.firstGroup);
    std::copy_n(triangles_.begin() + from.firstTriangle, to.triangles,
                newTriangles.begin() + to.firstTriangle);
    for (uint32_t g = to.firstGroup; g < to.firstGroup + to.groups; ++g)
      newGroups[g].first += to.firstTriangle - from.firstTriangle;  // may wrap around and back
  }
  objects_ = std::move(placed);
  groups_ = std::move(newGroups);
  triangles_ = std::move(newTriangles);
  return true;
}

void OccluderGroups::measure(const RenderScene& scene, uint32_t object) {
  constexpr size_t kMeasuredAStep = 256;
  Object& o = objects_[object];
  const OccluderOrder& order = *o.order;
  tbb::parallel_for(size_t{0}, (o.groups + kMeasuredAStep - 1) / kMeasuredAStep, [&](size_t step) {
    const size_t end = std::min<size_t>((step + 1) * kMeasuredAStep, o.groups);
    for (size_t g = step * kMeasuredAStep; g < end; ++g) {
      const uint32_t first = g == 0 ? 0 : order.ends[g - 1];
      OccluderGroup& group = groups_[o.firstGroup + g];
      group.object = object;
      group.first = o.firstTriangle + first;
      group.count = order.ends[g] - first;
      const auto triangles = std::span(triangles_).subspan(group.first, group.count);
      for (uint32_t i = 0; i < group.count; ++i) triangles[i].triangle = order.triangles[first + i];
      measureGroup(scene, group, triangles);
    }
  });
  o.area = 0.0;
  for (const OccluderGroup& g : std::span(groups_).subspan(o.firstGroup, o.groups))
    o.area += static_cast<double>(g.area);
}

size_t OccluderGroups::memoryBytes() const {
  size_t bytes = objects_.capacity() * sizeof(Object) + groups_.capacity() * sizeof(OccluderGroup) +
                 triangles_.capacity() * sizeof(OccluderTriangle);
  for (const auto& [part, order] : orders_)
    bytes += (order->triangles.capacity() + order->ends.capacity()) * sizeof(uint32_t);
  return bytes;
}

}  // namespace lamplighter
