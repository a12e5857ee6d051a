// The rays of GatherLinks.
#include <algorithm>
#include <atomic>
#include <bit>

#include <tbb/parallel_for.h>

#include "renderer/surface_light/gather_links.h"
#include "renderer/surface_light/gather_rays.h"

namespace lamplighter {
namespace {

// The points of a sample; ray i starts at point i modulo their number.
std::vector<SurfaceSpot> spotsOf(const RenderScene& scene, const SurfaceMesh& mesh,
                                 uint32_t sample) {
  std::vector<SurfaceSpot> spots;
  for (const SurfacePlace& place : mesh.placesOfSample(sample))
    spots.push_back(spotAt(scene, mesh.objectOfSample(sample), place));
  return spots;
}

}  // namespace

void GatherLinks::outdate(const RenderScene& scene, const RayCaster& rays, const SurfaceMesh& mesh,
                          const CutLeaves& cuts, std::span<const uint32_t> movedObjects,
                          std::span<const Bounds> boxes) {
  std::vector<bool> isMoved(mesh.objects(), false);
  for (const uint32_t o : movedObjects) isMoved[o] = true;
  tbb::parallel_for(size_t{0}, mesh.samples(), [&](size_t k) {
    const auto sample = static_cast<uint32_t>(k);
    const uint32_t object = mesh.objectOfSample(sample);
    if (object == SurfaceMesh::kUnused || known_[k] == 0) return;
    const auto links = of(sample);
    const auto stale = staleOf(sample);
    if (isMoved[object]) {
      for (size_t i = 0; i < links.size(); ++i) stale[i / 64] |= uint64_t{1} << i % 64;
    } else {
      const auto directions = directionsOf(sample);
      const auto spots = spotsOf(scene, mesh, sample);
      for (size_t p = 0; p < spots.size(); ++p)
        markTouched({scene, rays, mesh, cuts}, spots[p], boxes, directions, links, p, spots.size(),
                    stale);
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
  // 2. Outdated rays, then missing ones, beginning where the last frame stopped.
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
    std::vector<uint64_t> wanted(words_, 0);
    if (isStale[s]) std::ranges::copy(stale, wanted.begin());
    for (size_t i = from; i < target[s]; ++i) wanted[i / 64] |= uint64_t{1} << i % 64;
    traced += traceGatherRays({scene, rays, mesh, cuts}, spotsOf(scene, mesh, s), directionsOf(s),
                              wanted, std::span(links_).subspan(s * rays_, target[s]));
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
