#include "renderer/surface_light/blockers.h"

#include <tbb/parallel_for.h>

#include "renderer/raycast/ray_caster.h"

namespace lamplighter {
namespace {

// The planes of the pyramid from a point to the rectangle of a light; inside is positive.
struct Shaft {
  struct Plane {
    vec3 normal;
    float offset;
  };
  std::array<Plane, 7> planes;
  float margin;

  Shaft(const FlatLight& light, const vec3& x, const vec3& n) : margin(rayEpsilon(x)) {
    const std::array<vec3, 4> corners{light.origin, light.origin + light.across,
                                      light.origin + light.across + light.up,
                                      light.origin + light.up};
    const vec3 middle = 0.5f * (corners[0] + corners[2]);
    for (size_t i = 0; i < 4; ++i) {
      vec3 normal = glm::cross(corners[i] - x, corners[(i + 1) % 4] - x);
      const float length = glm::length(normal);
      normal = length > 0.0f ? normal / length : vec3(0.0f);
      if (glm::dot(normal, middle - x) < 0.0f) normal = -normal;
      planes[i] = {normal, -glm::dot(normal, x) + margin};
    }
    const float side = glm::dot(x - light.origin, light.normal) > 0.0f ? 1.0f : -1.0f;
    planes[4] = {side * light.normal, -side * glm::dot(light.normal, light.origin) - margin};
    planes[5] = {-side * light.normal, side * glm::dot(light.normal, x) - margin};
    planes[6] = {n, -glm::dot(n, x) - margin};
  }

  bool mayMeet(const Bounds& box) const {
    for (const Plane& p : planes) {
      const vec3 farthest(p.normal.x > 0.0f ? box.max.x : box.min.x,
                          p.normal.y > 0.0f ? box.max.y : box.min.y,
                          p.normal.z > 0.0f ? box.max.z : box.min.z);
      if (glm::dot(p.normal, farthest) + p.offset < 0.0f) return false;
    }
    return true;
  }
  bool mayMeet(const std::array<vec3, 3>& t) const {
    for (const Plane& p : planes) {
      if (glm::dot(p.normal, t[0]) + p.offset < 0.0f &&
          glm::dot(p.normal, t[1]) + p.offset < 0.0f && glm::dot(p.normal, t[2]) + p.offset < 0.0f)
        return false;
    }
    return true;
  }
};

std::array<vec3, 3> triangleOf(const RenderScene& scene, const RenderObject& o, uint32_t t) {
  const uint32_t* i = &scene.indices[o.firstIndex + 3 * t];
  return {scene.positions[i[0]], scene.positions[i[1]], scene.positions[i[2]]};
}

BoundsTree treeOf(const RenderScene& scene, const RenderObject& o) {
  std::vector<Bounds> boxes(o.triangleCount());
  for (uint32_t t = 0; t < boxes.size(); ++t)
    for (const vec3& corner : triangleOf(scene, o, t)) boxes[t].add(corner);
  return BoundsTree(boxes);
}

}  // namespace

void Blockers::update(const RenderScene& scene, bool isNew,
                      std::span<const uint32_t> movedObjects) {
  if (isNew) triangles_.clear();
  triangles_.resize(scene.objects.size());
  if (!isNew && movedObjects.empty()) return;
  std::vector<uint32_t> stale(movedObjects.begin(), movedObjects.end());
  for (uint32_t o = 0; isNew && o < scene.objects.size(); ++o) stale.push_back(o);
  tbb::parallel_for(size_t{0}, stale.size(), [&](size_t i) {
    const RenderObject& o = scene.objects[stale[i]];
    const bool isClear = scene.materials[static_cast<size_t>(o.material)].isClear();
    triangles_[stale[i]] = isClear ? BoundsTree() : treeOf(scene, o);
  });
  std::vector<Bounds> boxes;
  for (const BoundsTree& tree : triangles_) boxes.push_back(tree.bounds());
  objects_ = BoundsTree(boxes);
}

Blockers::Found Blockers::find(const RenderScene& scene, const FlatLight& light, const vec3& x,
                               const vec3& n, std::vector<std::array<vec3, 3>>& out,
                               size_t most) const {
  out.clear();
  const Shaft shaft(light, x, n);
  const auto enters = [&](const Bounds& box) { return !box.empty() && shaft.mayMeet(box); };
  const bool isComplete = objects_.visit(enters, [&](uint32_t object) {
    const RenderObject& o = scene.objects[object];
    const bool isMasked =
        scene.materials[static_cast<size_t>(o.material)].alphaMode == AlphaMode::mask;
    return triangles_[object].visit(enters, [&](uint32_t t) {
      const std::array<vec3, 3> triangle = triangleOf(scene, o, t);
      if (!shaft.mayMeet(triangle)) return true;
      out.push_back(triangle);
      return !isMasked && out.size() <= most;
    });
  });
  if (!isComplete) return Found::tooMany;
  return out.empty() ? Found::none : Found::some;
}

std::optional<MaskedShare> maskedShare(const RenderScene& scene, const Blockers& blockers,
                                       const FlatLight& light, const SurfaceSpot& spot,
                                       size_t mostBlockers) {
  thread_local std::vector<std::array<vec3, 3>> triangles;
  const vec3 x = spot.rayOrigin();
  const auto found = blockers.find(scene, light, x, spot.geometricNormal, triangles, mostBlockers);
  if (found == Blockers::Found::tooMany) return std::nullopt;
  if (found == Blockers::Found::none) return MaskedShare{};
  VisiblePlaces places(light, x);
  for (const auto& t : triangles) places.block(t[0], t[1], t[2]);
  return MaskedShare{places.visibleShare(spot.normal), false};
}

}  // namespace lamplighter
