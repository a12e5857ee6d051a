// The rays of GatherLinks.
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <optional>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"
#include "renderer/surface_light/gather_links.h"

namespace lamplighter {
namespace {

uint16_t roundedUp(float distance) {
  return static_cast<uint16_t>(std::min((std::bit_cast<uint32_t>(distance) >> 16) + 1, 0x7f80u));
}

// The places of a sample; ray i leaves from place i modulo their number.
std::vector<SurfaceSpot> spotsOf(const RenderScene& scene, const SurfaceMesh& mesh,
                                 uint32_t sample) {
  std::vector<SurfaceSpot> spots;
  for (const SurfacePlace& place : mesh.placesOfSample(sample))
    spots.push_back(spotAt(scene, mesh.objectOfSample(sample), place));
  return spots;
}

uint8_t byteOf(float weight) {
  return static_cast<uint8_t>(std::clamp(weight, 0.0f, 1.0f) * 255.0f + 0.5f);
}

GatherLink linkTo(const RenderScene& scene, const RayCaster& caster, const SurfaceMesh& mesh,
                  const CutLeaves& cuts, const Hit& hit, const Ray& ray) {
  GatherLink link;
  if (!hit) {
    link.leaf = GatherLink::kSky;
    link.distance = roundedUp(std::numeric_limits<float>::infinity());
    return link;
  }
  link.distance = roundedUp(hit.t);
  const uint32_t* i = &scene.indices[scene.objects[hit.object].firstIndex + 3 * hit.triangle];
  const vec3& a = scene.positions[i[0]];
  const vec3 cross = glm::cross(scene.positions[i[1]] - a, scene.positions[i[2]] - a);
  const bool isBack = glm::dot(cross, ray.direction) > 0.0f;
  MeshPoint point;
  if (mesh.find(scene, hit.object, hit.triangle, isBack, {hit.u, hit.v}, point)) {
    link.leaf = point.leaf;
    cuts.keepVisible(scene, caster, mesh, ray.origin + hit.t * ray.direction, point.leaf,
                     point.weights);
    link.u = byteOf(point.weights.y);
    link.v = std::min(byteOf(point.weights.z), static_cast<uint8_t>(255 - link.u));
  } else if (isBack && scene.backIsUnseen(hit.object)) {
    link.leaf = GatherLink::kInside;
  }
  return link;
}

// A sphere around what changed, seen from a sample: a cone of directions around +Z of the sample.
struct Cone {
  vec3 axis{0.0f};
  float cosine = -1.0f;  // −1: all directions

  // None if all of it is below the surface.
  static std::optional<Cone> of(const SurfaceSpot& spot, const vec3& centre, float radius) {
    const vec3 way = centre - spot.rayOrigin();
    const vec3 local = Frame(spot.normal).toLocal(way);
    if (local.z < -radius) return std::nullopt;
    const float distance = glm::length(way);
    if (distance <= radius) return Cone{};
    const float sine = radius / distance;
    return Cone{local / distance, std::sqrt(1.0f - sine * sine) - 1e-4f};
  }
  bool contains(const vec3& direction) const { return glm::dot(direction, axis) >= cosine; }
};

// Traces the rays of one sample for which wants(i) holds, in packets of eight.
template <typename Wants>
uint64_t traceRays(const RenderScene& scene, const RayCaster& caster, const SurfaceMesh& mesh,
                   const CutLeaves& cuts, std::span<const SurfaceSpot> spots,
                   std::span<const vec3> directions, std::span<GatherLink> links,
                   const Wants& wants) {
  uint64_t traced = 0;
  std::array<Ray, 8> rays;
  std::array<Hit, 8> hits;
  std::array<size_t, 8> which{};
  size_t lanes = 0;
  const auto flush = [&] {
    if (lanes == 0) return;
    for (size_t k = lanes; k < 8; ++k) rays[k].tFar = -1.0f;
    hits.fill({});
    caster.leastHits8(rays, hits);
    for (size_t k = 0; k < lanes; ++k)
      links[which[k]] = linkTo(scene, caster, mesh, cuts, hits[k], rays[k]);
    traced += lanes;
    lanes = 0;
  };
  for (size_t i = 0; i < links.size(); ++i) {
    if (!wants(i)) continue;
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

}  // namespace

void GatherLinks::outdate(const RenderScene& scene, const SurfaceMesh& mesh, const CutLeaves& cuts,
                          std::span<const uint32_t> movedObjects, std::span<const Bounds> boxes) {
  std::vector<bool> isMoved(mesh.objects(), false);
  for (const uint32_t o : movedObjects) isMoved[o] = true;
  // Rays that end on an element beside a box see it otherwise, too.
  const float reach = cuts.largestChanged();
  tbb::parallel_for(size_t{0}, mesh.samples(), [&](size_t k) {
    const auto sample = static_cast<uint32_t>(k);
    const uint32_t object = mesh.objectOfSample(sample);
    if (object == SurfaceMesh::kUnused || known_[k] == 0) return;
    const auto links = of(sample);
    const auto stale = staleOf(sample);
    const auto mark = [&](size_t i) { stale[i / 64] |= uint64_t{1} << i % 64; };
    if (isMoved[object]) {
      for (size_t i = 0; i < links.size(); ++i) mark(i);
    } else {
      const auto directions = directionsOf(sample);
      const auto places = mesh.placesOfSample(sample);
      for (size_t p = 0; p < places.size(); ++p) {
        const SurfaceSpot spot = spotAt(scene, object, places[p]);
        for (const Bounds& box : boxes) {
          if (box.empty()) continue;
          const auto cone = Cone::of(spot, box.centre(), box.radius() + reach);
          if (!cone) continue;
          for (size_t i = p; i < links.size(); i += places.size()) {
            if (!cone->contains(directions[i])) continue;
            const vec3 direction = gatherDirection(spot, directions[i]);
            if (direction == vec3(0.0f)) continue;
            const bool endsNear = links[i].isLeaf() && cuts.mayDiffer(links[i].leaf);
            if (endsNear || mayTouch({spot.rayOrigin(), 0.0f, direction, links[i].metres()}, box))
              mark(i);
          }
        }
      }
    }
    int count = 0;
    for (const uint64_t word : stale) count += std::popcount(word);
    staleCounts_[k] = static_cast<uint16_t>(count);
  });
  staleSamples_ = static_cast<size_t>(
      std::ranges::count_if(staleCounts_, [](uint16_t count) { return count > 0; }));
}

uint64_t GatherLinks::trace(const RenderScene& scene, const RayCaster& rays,
                            const SurfaceMesh& mesh, const CutLeaves& cuts, uint64_t most,
                            std::vector<uint32_t>& changed) {
  changed.clear();
  if (isDone()) return 0;
  const auto samples = static_cast<uint32_t>(mesh.samples());
  std::vector<uint16_t> target(known_);
  std::vector<uint8_t> isStale(samples, 0);
  const auto isUsed = [&](uint32_t s) { return mesh.objectOfSample(s) != SurfaceMesh::kUnused; };
  uint64_t planned = 0;
  // 1. The first rays of all samples.
  const auto extend = [&](uint32_t s, int stage) {
    const size_t wanted = raysOfStage(stage);
    if (!isUsed(s) || target[s] >= wanted) return;
    planned += wanted - target[s];
    target[s] = static_cast<uint16_t>(wanted);
  };
  for (uint32_t s = 0; s < samples; ++s) extend(s, 1);
  // 2. What is out of date, then what is missing; where the last frame stopped.
  const uint32_t first = next_ < samples ? next_ : 0;
  for (uint32_t i = 0; i < samples && planned < most; ++i) {
    const uint32_t s = (first + i) % samples;
    if (staleCounts_[s] == 0) continue;
    isStale[s] = 1;
    planned += staleCounts_[s];
    next_ = s + 1;
  }
  for (int stage = 2; stage <= kStages; ++stage) {
    for (uint32_t i = 0; i < samples && planned < most; ++i) {
      const uint32_t s = (first + i) % samples;
      extend(s, stage);
      next_ = s + 1;
    }
  }
  for (uint32_t s = 0; s < samples; ++s)
    if (isStale[s] || target[s] > known_[s]) changed.push_back(s);

  std::atomic<uint64_t> traced = 0;
  tbb::parallel_for(size_t{0}, changed.size(), [&](size_t k) {
    const uint32_t s = changed[k];
    const auto stale = staleOf(s);
    const size_t from = known_[s];
    known_[s] = target[s];
    traced += traceRays(scene, rays, mesh, cuts, spotsOf(scene, mesh, s), directionsOf(s),
                        std::span(links_).subspan(s * rays_, target[s]), [&](size_t i) {
                          return i >= from || (isStale[s] && (stale[i / 64] >> i % 64 & 1u) != 0);
                        });
    if (!isStale[s]) return;
    std::ranges::fill(stale, 0u);
    staleCounts_[s] = 0;
  });
  staleSamples_ = 0;
  stage_ = kStages;
  for (uint32_t s = 0; s < samples; ++s) {
    staleSamples_ += staleCounts_[s] > 0 ? 1 : 0;
    while (isUsed(s) && known_[s] < raysOfStage(stage_)) --stage_;
  }
  return traced;
}

}  // namespace lamplighter
