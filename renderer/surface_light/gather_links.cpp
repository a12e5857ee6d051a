#include "renderer/surface_light/gather_links.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"

namespace lamplighter {
namespace {

constexpr uint32_t kGatherSet = 0x6a;
// A sample is buried if more than one in so many of its rays see that.
constexpr std::ptrdiff_t kBuriedShare = 8;

uint16_t roundedUp(float distance) {
  return static_cast<uint16_t>(std::min((std::bit_cast<uint32_t>(distance) >> 16) + 1, 0x7f80u));
}

// The bits of x and y in turn.
uint32_t interleaved(uint32_t x, uint32_t y) {
  uint32_t out = 0;
  for (uint32_t bit = 0; bit < 16; ++bit)
    out |= (x >> bit & 1u) << (2 * bit) | (y >> bit & 1u) << (2 * bit + 1);
  return out;
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

}  // namespace

float GatherLink::metres() const { return std::bit_cast<float>(uint32_t{distance} << 16); }

std::vector<vec3> gatherDirections(int count, uint32_t scramble) {
  std::vector<vec2> points;
  for (int i = 0; i < count; ++i) points.push_back(sobol2(static_cast<uint32_t>(i), scramble));
  std::ranges::stable_sort(points, {}, [](const vec2& p) {
    return interleaved(static_cast<uint32_t>(p.x * 65536.0f),
                       static_cast<uint32_t>(p.y * 65536.0f));
  });
  std::vector<vec3> directions;
  for (const vec2& p : points) directions.push_back(sampleCosineHemisphere(p));
  return directions;
}

void GatherLinks::restart(const SurfaceMesh& mesh, int rays, uint32_t seed) {
  rays_ = static_cast<size_t>(rays);
  directions_.clear();
  for (uint32_t set = 0; set < kDirectionSets; ++set)
    for (const vec3& d : gatherDirections(rays, hash4(seed, set, 0, kGatherSet)))
      directions_.push_back(d);
  sets_.resize(mesh.samples());
  for (uint32_t s = 0; s < sets_.size(); ++s) {
    const uint32_t local = s - mesh.part(mesh.objectOfSample(s)).firstSample;
    sets_[s] = static_cast<uint8_t>(hash4(local, 0, 0, kGatherSet) % kDirectionSets);
  }
  links_.assign(mesh.samples() * rays_, {});
}

vec3 gatherDirection(const SurfaceSpot& spot, const vec3& direction) {
  const vec3 world = Frame(spot.normal).toWorld(direction);
  return glm::dot(world, spot.geometricNormal) > 0.0f ? world : vec3(0.0f);
}

bool GatherLinks::isBuried(uint32_t sample, float within) const {
  const auto links = of(sample);
  return kBuriedShare * std::ranges::count_if(links,
                                              [&](const GatherLink& link) {
                                                return link.leaf == GatherLink::kInside &&
                                                       link.metres() < within;
                                              }) >
         static_cast<std::ptrdiff_t>(links.size());
}

float GatherLinks::reachOf(uint32_t sample) const {
  float sum = 0.0f;
  for (const GatherLink& link : of(sample)) sum += 1.0f / std::max(link.metres(), 1e-6f);
  return static_cast<float>(rays_) / std::max(sum, 1e-6f);
}

namespace {

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
    caster.intersect8(rays, hits);
    for (size_t k = 0; k < lanes; ++k)
      links[which[k]] = linkTo(scene, caster, mesh, cuts, hits[k], rays[k]);
    traced += lanes;
    lanes = 0;
  };
  for (size_t i = 0; i < links.size(); ++i) {
    const SurfaceSpot& spot = spots[i % spots.size()];
    const vec3 direction = gatherDirection(spot, directions[i]);
    if (direction == vec3(0.0f)) {
      links[i] = {};
      continue;
    }
    const Ray ray{spot.rayOrigin(), 0.0f, direction};
    if (!wants(ray, links[i])) continue;
    rays[lanes] = ray;
    which[lanes++] = i;
    if (lanes == 8) flush();
  }
  flush();
  return traced;
}

}  // namespace

uint64_t GatherLinks::trace(const RenderScene& scene, const RayCaster& rays,
                            const SurfaceMesh& mesh, const CutLeaves& cuts,
                            std::span<const uint32_t> samples) {
  std::atomic<uint64_t> traced = 0;
  tbb::parallel_for(size_t{0}, samples.size(), [&](size_t k) {
    const uint32_t sample = samples[k];
    traced += traceRays(scene, rays, mesh, cuts, spotsOf(scene, mesh, sample), directionsOf(sample),
                        std::span(links_).subspan(sample * rays_, rays_),
                        [](const Ray&, const GatherLink&) { return true; });
  });
  return traced;
}

uint64_t GatherLinks::retrace(const RenderScene& scene, const RayCaster& rays,
                              const SurfaceMesh& mesh, const CutLeaves& cuts,
                              std::span<const uint32_t> movedObjects, std::span<const Bounds> boxes,
                              std::vector<uint32_t>& changed) {
  std::vector<bool> isMoved(mesh.objects(), false);
  for (const uint32_t o : movedObjects) isMoved[o] = true;
  std::vector<uint8_t> isChanged(mesh.samples(), 0);
  std::atomic<uint64_t> traced = 0;
  tbb::parallel_for(size_t{0}, mesh.samples(), [&](size_t k) {
    const auto sample = static_cast<uint32_t>(k);
    const bool moved = isMoved[mesh.objectOfSample(sample)];
    const uint64_t count = traceRays(
        scene, rays, mesh, cuts, spotsOf(scene, mesh, sample), directionsOf(sample),
        std::span(links_).subspan(k * rays_, rays_), [&](Ray ray, const GatherLink& link) {
          if (moved || (link.isLeaf() && cuts.mayDiffer(link.leaf))) return true;
          ray.tFar = link.metres();
          return std::ranges::any_of(boxes, [&](const Bounds& b) { return mayTouch(ray, b); });
        });
    isChanged[k] = moved || count > 0;
    traced += count;
  });
  changed.clear();
  for (uint32_t s = 0; s < isChanged.size(); ++s)
    if (isChanged[s]) changed.push_back(s);
  return traced;
}

}  // namespace lamplighter
