#include "renderer/surface_light/gather_rays.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

namespace lamplighter {
namespace {

uint16_t roundedUp(float distance) {
  return static_cast<uint16_t>(std::min((std::bit_cast<uint32_t>(distance) >> 16) + 1, 0x7f80u));
}

uint8_t byteOf(float weight) {
  return static_cast<uint8_t>(std::clamp(weight, 0.0f, 1.0f) * 255.0f + 0.5f);
}

// A bounding sphere of a change, seen from a sample: a cone of directions in the local frame of the
// sample.
struct Cone {
  vec3 axis{0.0f};
  float cosine = -1.0f;  // −1: all directions

  // None if the cone is completely below the surface.
  static std::optional<Cone> of(const SurfaceSpot& spot, const vec3& centre, float radius) {
    const vec3 way = centre - spot.rayOrigin();
    const vec3 local = gatherFrame(spot).toLocal(way);
    if (local.z < -radius) return std::nullopt;
    const float distance = glm::length(way);
    if (distance <= radius) return Cone{};
    const float sine = radius / distance;
    return Cone{local / distance, std::sqrt(1.0f - sine * sine) - 1e-4f};
  }
  bool contains(const vec3& direction) const { return glm::dot(direction, axis) >= cosine; }
};

}  // namespace

GatherLink linkTo(const GatherScene& in, const Hit& hit, const Ray& ray) {
  const RenderScene& scene = in.scene;
  GatherLink link;
  if (!hit) {
    link.leaf = GatherLink::kSky;
    link.distance = roundedUp(std::numeric_limits<float>::infinity());
    return link;
  }
  link.distance = roundedUp(hit.t);
  const bool isBack = isOnBack(scene, hit, ray.direction);
  MeshPoint point;
  if (in.mesh.find(scene, hit.object, hit.triangle, isBack, {hit.u, hit.v}, point)) {
    link.leaf = point.leaf;
    in.cuts.keepVisible(scene, in.rays, in.mesh, ray.origin + hit.t * ray.direction, point.leaf,
                        point.weights);
    link.u = byteOf(point.weights.y);
    link.v = std::min(byteOf(point.weights.z), static_cast<uint8_t>(255 - link.u));
  } else if (isBack && scene.backIsUnseen(hit.object)) {
    link.leaf = GatherLink::kInside;
  }
  return link;
}

uint64_t traceGatherRays(const GatherScene& scene, std::span<const SurfaceSpot> spots,
                         std::span<const vec3> directions, std::span<const uint64_t> wanted,
                         std::span<GatherLink> links) {
  uint64_t traced = 0;
  std::array<Ray, 8> rays;
  std::array<Hit, 8> hits;
  std::array<size_t, 8> which{};
  size_t lanes = 0;
  const auto flush = [&] {
    if (lanes == 0) return;
    for (size_t k = lanes; k < 8; ++k) rays[k].tFar = -1.0f;
    hits.fill({});
    scene.rays.leastHits8(rays, hits);
    for (size_t k = 0; k < lanes; ++k) links[which[k]] = linkTo(scene, hits[k], rays[k]);
    traced += lanes;
    lanes = 0;
  };
  for (size_t i = 0; i < links.size(); ++i) {
    if ((wanted[i / 64] >> i % 64 & 1u) == 0) continue;
    const SurfaceSpot& spot = spots[i % spots.size()];
    const vec3 direction = gatherDirection(spot, directions[i]);
    if (direction == vec3(0.0f)) {
      links[i] = {};
      continue;
    }
    const Ray ray{spot.rayOrigin(), 0.0f, direction};
    rays[lanes] = ray;
    which[lanes++] = i;
    if (lanes == 8) flush();
  }
  flush();
  return traced;
}

void markTouched(const GatherScene& scene, const SurfaceSpot& spot, std::span<const Bounds> boxes,
                 std::span<const vec3> directions, std::span<const GatherLink> links, size_t first,
                 size_t step, std::span<uint64_t> marks) {
  // Rays that end on an element near a box may see it differently, too.
  const float reach = scene.cuts.largestChanged();
  for (const Bounds& box : boxes) {
    if (box.empty()) continue;
    const auto cone = Cone::of(spot, box.centre(), box.radius() + reach);
    if (!cone) continue;
    for (size_t i = first; i < links.size(); i += step) {
      if (!cone->contains(directions[i])) continue;
      const vec3 direction = gatherDirection(spot, directions[i]);
      if (direction == vec3(0.0f)) continue;
      const bool endsNear = links[i].isLeaf() && scene.cuts.mayDiffer(links[i].leaf);
      if (endsNear || mayTouch({spot.rayOrigin(), 0.0f, direction, links[i].metres()}, box))
        marks[i / 64] |= uint64_t{1} << i % 64;
    }
  }
}

}  // namespace lamplighter
