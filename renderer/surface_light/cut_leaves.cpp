#include "renderer/surface_light/cut_leaves.h"

#include <algorithm>
#include <array>
#include <atomic>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

// Height of the rays above the surface [edges of elements]: thresholds and rugs do not cut.
constexpr float kHeight = 0.04f;

struct Corners {
  std::array<vec3, 3> positions;
  vec3 lift{0.0f};
  Bounds bounds;
};

// The corners of an element, lifted from the surface.
Corners cornersOf(const RenderScene& scene, const SurfaceMesh& mesh, uint32_t leaf) {
  Corners out;
  const uint32_t object = mesh.objectOfLeaf(leaf);
  const SurfaceSpot spot = spotAt(scene, object, mesh.placesOfLeaf(leaf)[0]);
  out.lift = kHeight * mesh.edge() * spot.geometricNormal;
  const auto samples = mesh.samplesOfLeaf(leaf);
  for (size_t c = 0; c < 3; ++c) {
    out.positions[c] =
        spotAt(scene, object, mesh.placesOfSample(samples[c])[0]).position + out.lift;
    out.bounds.add(out.positions[c]);
  }
  return out;
}

bool touches(const Bounds& a, const Bounds& b) {
  return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::lessThanEqual(b.min, a.max));
}

}  // namespace

uint64_t CutLeaves::update(const RenderScene& scene, const RayCaster& rays, const SurfaceMesh& mesh,
                           bool isNewMesh, std::span<const uint32_t> movedObjects,
                           std::span<const Bounds> boxes) {
  if (isNewMesh) isCut_.clear();
  isCut_.resize(mesh.leaves(), 0);
  mayDiffer_.assign(mesh.leaves(), isNewMesh ? 1 : 0);
  largestChanged_ = 0.0f;
  if (!isNewMesh && boxes.empty()) return 0;
  std::vector<bool> isMoved(mesh.objects(), false);
  for (const uint32_t o : movedObjects) isMoved[o] = true;
  // Objects far from the moved ones have no element near them.
  std::vector<bool> isFar(mesh.objects(), false);
  const vec3 lift(kHeight * mesh.edge());
  for (uint32_t o = 0; o < mesh.objects() && !isNewMesh; ++o) {
    const Bounds& b = scene.objects[o].bounds;
    isFar[o] = !isMoved[o] && std::ranges::none_of(boxes, [&](const Bounds& box) {
      return touches({b.min - lift, b.max + lift}, box);
    });
  }
  std::atomic<uint64_t> traced = 0;
  const size_t groups = (mesh.leaves() + RayCaster::kLanes - 1) / RayCaster::kLanes;
  tbb::parallel_for(size_t{0}, groups, [&](size_t group) {
    // Rays along one side of each of eight neighbouring elements.
    std::array<std::array<Ray, RayCaster::kLanes>, 3> sides;
    for (auto& rays8 : sides)
      for (Ray& ray : rays8) ray.tFar = -1.0f;
    bool isAny = false;
    for (size_t lane = 0; lane < RayCaster::kLanes; ++lane) {
      const size_t k = group * RayCaster::kLanes + lane;
      if (k >= mesh.leaves()) break;
      const auto leaf = static_cast<uint32_t>(k);
      const uint32_t object = mesh.objectOfLeaf(leaf);
      if (object == SurfaceMesh::kUnused || isFar[object] || mesh.isCluster(leaf)) continue;
      const Corners corners = cornersOf(scene, mesh, leaf);
      const auto isNear = [&](const Bounds& b) { return touches(corners.bounds, b); };
      if (!isNewMesh && !isMoved[object] && std::ranges::none_of(boxes, isNear)) continue;
      mayDiffer_[k] = 1;
      isCut_[k] = 0;
      isAny = true;
      for (size_t c = 0; c < 3; ++c) {
        const vec3& from = corners.positions[c];
        sides[c][lane] = {from, 0.0f, corners.positions[(c + 1) % 3] - from, 1.0f};
      }
    }
    for (size_t c = 0; isAny && c < 3; ++c) {
      const std::array<bool, RayCaster::kLanes> cut = rays.occluded8(sides[c]);
      for (size_t lane = 0; lane < RayCaster::kLanes; ++lane) {
        traced += sides[c][lane].tFar > 0.0f ? 1 : 0;
        if (!cut[lane]) continue;
        isCut_[group * RayCaster::kLanes + lane] = 1;
        for (size_t next = c + 1; next < 3; ++next) sides[next][lane].tFar = -1.0f;
      }
    }
  });
  if (isNewMesh) return traced;
  for (uint32_t leaf = 0; leaf < mesh.leaves(); ++leaf)
    if (mayDiffer_[leaf])
      largestChanged_ =
          std::max(largestChanged_, 2.0f * cornersOf(scene, mesh, leaf).bounds.radius());
  return traced;
}

void CutLeaves::keepVisible(const RenderScene& scene, const RayCaster& rays,
                            const SurfaceMesh& mesh, const vec3& place, uint32_t leaf,
                            vec3& weights) const {
  if (!isCut(leaf)) return;
  const Corners corners = cornersOf(scene, mesh, leaf);
  vec3 kept = weights;
  for (int c = 0; c < 3; ++c) {
    const vec3 from = place + corners.lift;
    if (rays.occluded({from, 0.0f, corners.positions[static_cast<size_t>(c)] - from, 1.0f}))
      kept[c] = 0.0f;
  }
  const float sum = kept.x + kept.y + kept.z;
  if (sum > 0.0f) weights = kept / sum;
}

}  // namespace lamplighter
