#include "renderer/visibility/patch_demand.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <map>
#include <utility>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

// Scenes with no more roots ask for all of them: their database is built in milliseconds, and the
// camera may turn without new entries.
constexpr size_t kRootsForAll = 512;

// Side of the square of pixels that one ray represents.
constexpr int kPixelsARay = 8;

// Fewest rays that must hit a patch with entries: 512 pixels. An entry takes about two
// microseconds, a look-up about four nanoseconds.
constexpr uint32_t kRaysAPatch = 8;

constexpr uint32_t kNoObject = 0xffffffffu;

// The root of the patch that contains a triangle.
int rootOf(const ObjectPatches& patches, uint32_t triangle) {
  int patch = patches.patchOfTriangle[triangle];
  while (patches.patches[static_cast<size_t>(patch)].parent != kNone)
    patch = patches.patches[static_cast<size_t>(patch)].parent;
  return patch;
}

struct RootId {
  uint32_t object = kNoObject;
  int patch = kNone;
  auto operator<=>(const RootId&) const = default;
};

// The number of rays that hit each root.
std::map<RootId, uint32_t> countRays(std::span<const ObjectPatches> patches, const RayCaster& rays,
                                     const View& view) {
  const int columns = (view.width + kPixelsARay - 1) / kPixelsARay;
  const int rows = (view.height + kPixelsARay - 1) / kPixelsARay;
  const int padded = (columns + 7) / 8 * 8;
  std::vector<RootId> hits(static_cast<size_t>(padded) * static_cast<size_t>(rows));
  tbb::parallel_for(0, rows, [&](int row) {
    for (int first = 0; first < padded; first += 8) {
      std::array<Ray, 8> packet;
      std::array<Hit, 8> found;
      for (int lane = 0; lane < 8; ++lane) {
        Ray& ray = packet[static_cast<size_t>(lane)];
        const vec2 pixel = static_cast<float>(kPixelsARay) *
                           (vec2(static_cast<float>(first + lane), static_cast<float>(row)) + 0.5f);
        ray = {view.eye, 0.0f, view.rayDirection(pixel.x, pixel.y)};
        if (first + lane >= columns) ray.tFar = -1.0f;
      }
      rays.intersect8(packet, found, Surfaces::seen);
      for (int lane = 0; lane < 8; ++lane) {
        const Hit& hit = found[static_cast<size_t>(lane)];
        if (!hit || first + lane >= columns) continue;
        hits[static_cast<size_t>(row * padded + first + lane)] = {
            hit.object, rootOf(patches[hit.object], hit.triangle)};
      }
    }
  });
  std::map<RootId, uint32_t> counts;
  for (const RootId& hit : hits)
    if (hit.object != kNoObject) ++counts[hit];
  return counts;
}

}  // namespace

uint32_t PatchDemand::leastPixels(uint8_t levels) {
  if (levels == kAllLevels) return std::numeric_limits<uint32_t>::max();
  return levels == 0 ? 0 : (kRaysAPatch * kPixelsARay * kPixelsARay) << (levels - 1);
}

void PatchDemand::add(const PatchDemand& other) {
  isForAll = isForAll || other.isForAll;
  if (isForAll) {
    levels.clear();
    return;
  }
  for (size_t object = 0; object < std::min(levels.size(), other.levels.size()); ++object)
    if (levels[object].size() == other.levels[object].size())
      std::transform(levels[object].begin(), levels[object].end(), other.levels[object].begin(),
                     levels[object].begin(), [](uint8_t a, uint8_t b) { return std::max(a, b); });
}

PatchDemand findPatchDemand(std::span<const ObjectPatches> patches, const RayCaster& rays,
                            const View& view, size_t mostRows) {
  PatchDemand demand;
  size_t roots = 0;
  for (const ObjectPatches& p : patches) roots += p.roots.size();
  if (roots <= kRootsForAll) return demand;
  demand.isForAll = false;
  for (const ObjectPatches& p : patches) demand.levels.emplace_back(p.patches.size(), uint8_t{0});
  std::vector<std::pair<RootId, uint32_t>> asked;
  for (const auto& [root, count] : countRays(patches, rays, view))
    if (count >= kRaysAPatch) asked.emplace_back(root, count);
  std::stable_sort(asked.begin(), asked.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  size_t rows = 0;
  for (const auto& [root, count] : asked) {
    const int levels = std::bit_width(count / kRaysAPatch);
    rows += (size_t{1} << levels) - 1;
    if (rows > mostRows) break;
    demand.levels[root.object][static_cast<size_t>(root.patch)] = static_cast<uint8_t>(levels);
  }
  return demand;
}

}  // namespace lamplighter
