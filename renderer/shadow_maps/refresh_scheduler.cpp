#include "renderer/shadow_maps/refresh_scheduler.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lamplighter {
namespace {

// Whether the box extends above the plane through p with unit normal n.
bool reachesAbove(const Bounds& box, const vec3& p, const vec3& n) {
  if (box.empty()) return false;
  const vec3 top(n.x > 0.0f ? box.max.x : box.min.x, n.y > 0.0f ? box.max.y : box.min.y,
                 n.z > 0.0f ? box.max.z : box.min.z);
  return glm::dot(n, top - p) > 0.0f;
}

}  // namespace

bool seesMover(const shared::Vpl& vpl, const Bounds& before, const Bounds& after) {
  if (vpl.position.w == shared::kVplDirectional) return true;
  const vec3 p(vpl.position), n(vpl.normal);
  return reachesAbove(before, p, n) || reachesAbove(after, p, n);
}

float hiddenShare(const shared::Vpl& vpl, const Bounds& box) {
  if (box.empty()) return 0.0f;
  const float r = box.radius();
  if (vpl.position.w == shared::kVplDirectional)
    return std::min(1.0f, kPi * r * r / (4.0f * vpl.tangent.w * vpl.tangent.w));
  const float d = glm::distance(box.centre(), vec3(vpl.position));
  if (d <= r) return 1.0f;
  return 1.0f - std::sqrt(1.0f - r * r / (d * d));
}

RefreshWork& RefreshWork::operator+=(const RefreshWork& o) {
  shadowMaps += o.shadowMaps;
  visibilityTests += o.visibilityTests;
  lightMapTexels += o.lightMapTexels;
  rays += o.rays;
  return *this;
}

bool RefreshWork::allows(const RefreshWork& work) const {
  return work.shadowMaps <= shadowMaps && work.visibilityTests <= visibilityTests &&
         work.lightMapTexels <= lightMapTexels && work.rays <= rays;
}

std::vector<size_t> chooseRefreshes(std::span<const RefreshCandidate> candidates,
                                    const RefreshBudget& budget) {
  std::vector<size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), size_t{0});
  const auto priority = [&](size_t i) {
    return candidates[i].brightness * static_cast<float>(candidates[i].framesWaiting);
  };
  const size_t count = std::min(order.size(), static_cast<size_t>(std::max(budget.vpls, 0)));
  std::partial_sort(order.begin(), order.begin() + static_cast<ptrdiff_t>(count), order.end(),
                    [&](size_t a, size_t b) {
                      if (candidates[a].isFirst != candidates[b].isFirst)
                        return candidates[a].isFirst;
                      const float pa = priority(a), pb = priority(b);
                      return pa != pb ? pa > pb : a < b;
                    });
  order.resize(count);
  RefreshWork spent;
  int vpls = 0;
  for (size_t k = 0; k < count; ++k) {
    spent += candidates[order[k]].work;
    vpls += candidates[order[k]].vpls;
    if (k > 0 && (vpls > budget.vpls || !budget.work.allows(spent))) {
      order.resize(k);
      break;
    }
  }
  return order;
}

bool MoverFinder::Caster::operator==(const Caster& o) const {
  return node == o.node && triangles == o.triangles && isClear == o.isClear &&
         alphaMode == o.alphaMode && alphaCutoff == o.alphaCutoff && alpha == o.alpha &&
         alphaTexture == o.alphaTexture && bounds.min == o.bounds.min && bounds.max == o.bounds.max;
}

MoverFinder::Caster MoverFinder::casterOf(const RenderScene& scene, const RenderObject& object) {
  const Material& m = scene.materials[object.material];
  return {object.node,   object.triangleCount(),     m.isClear(),  m.alphaMode, m.alphaCutoff,
          m.baseColor.a, m.baseColorTexture.texture, object.bounds};
}

std::vector<MoverFinder::Mover> MoverFinder::update(const RenderScene& scene,
                                                    const RenderSceneChanges& changes) {
  std::vector<Mover> movers;
  if (!objects_.empty() && !changes.rebuilt && !changes.materials && changes.movedObjects.empty()) {
    return movers;
  }
  std::vector<bool> hasMoved(scene.objects.size(), false);
  for (const uint32_t object : changes.movedObjects) hasMoved[object] = true;
  std::vector<Caster> now;
  std::vector<bool> moved;
  now.reserve(scene.objects.size());
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    if (scene.objects[i].isEmpty()) continue;
    now.push_back(casterOf(scene, scene.objects[i]));
    moved.push_back(hasMoved[i]);
  }
  // Both lists have the order of the nodes, so one pass finds the common objects and skips removed
  // and new ones.
  size_t old = 0;
  for (size_t i = 0; i < now.size(); ++i) {
    const auto same = std::find_if(objects_.begin() + static_cast<ptrdiff_t>(old), objects_.end(),
                                   [&](const Caster& c) { return c.node == now[i].node; });
    if (same == objects_.end()) {
      movers.push_back({Bounds(), now[i].bounds, now[i].node});
      continue;
    }
    const size_t at = static_cast<size_t>(same - objects_.begin());
    for (; old < at; ++old) movers.push_back({objects_[old].bounds, Bounds(), objects_[old].node});
    // A rotation of a symmetric box keeps its bounds, so a moved object always counts.
    if (moved[i] || !(now[i] == objects_[at]))
      movers.push_back({objects_[at].bounds, now[i].bounds, now[i].node});
    old = at + 1;
  }
  for (; old < objects_.size(); ++old)
    movers.push_back({objects_[old].bounds, Bounds(), objects_[old].node});
  objects_ = std::move(now);
  return movers;
}

}  // namespace lamplighter
