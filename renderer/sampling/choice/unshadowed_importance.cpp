#include "renderer/sampling/choice/unshadowed_importance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "renderer/base/simd.h"
#include "renderer/sampling/choice/point_blocks.h"
#include "renderer/scene/vpl.h"

namespace lamplighter {
namespace {

// Points darker than this fraction of the mean get the weight of this brightness.
constexpr float kDarkestUnshadowed = 0.01f;
constexpr size_t kCandidatesAtOnce = 256;
constexpr size_t kPointColumns = PointBlocks::kMostPoints;

}  // namespace

std::vector<float> unshadowedImportance(std::span<const SceneVpl> candidates,
                                        std::span<const SeenPoint> points, float clampDistance) {
  std::vector<float> importance(candidates.size(), 0.0f);
  if (points.empty() || candidates.empty()) return importance;
  const PointBlocks at(points);
  const size_t blocks = at.blocks(), width = blocks * PointBlocks::kLanes;
  std::vector<float> irradiance(candidates.size() * width);
  // Sums of fixed groups of candidates, so that their order does not depend on threads.
  const size_t groups = (candidates.size() + kCandidatesAtOnce - 1) / kCandidatesAtOnce;
  std::vector<float> sums(groups * width, 0.0f);
  tbb::parallel_for(size_t{0}, groups, [&](size_t group) {
    const size_t end = std::min((group + 1) * kCandidatesAtOnce, candidates.size());
    alignas(32) std::array<float, kPointColumns> sum{};
    alignas(32) std::array<float, kPointColumns> light;
    for (size_t i = group * kCandidatesAtOnce; i < end; ++i) {
      const shared::Vpl& vpl = candidates[i].vpl;
      at.geometries(vpl, clampDistance, 0, blocks, light.data());
      if (const auto link = static_cast<uint32_t>(vpl.footprint.y); link != 0)
        for (size_t b = 0; b < blocks; ++b)
          for (uint32_t rest = at.leftOut(link, b), j = 0; rest != 0; rest >>= 1, ++j)
            if ((rest & 1u) != 0) light[b * PointBlocks::kLanes + j] = 0.0f;
      const Floats8 brightness = broadcast(luminance(vpl.intensity));
      float* const row = &irradiance[i * width];
      for (size_t j = 0; j < width; j += PointBlocks::kLanes) {
        const Floats8 value = hn::Mul(brightness, hn::Load(kTag, &light[j]));
        hn::StoreU(value, kTag, row + j);
        hn::Store(hn::Add(hn::Load(kTag, &sum[j]), value), kTag, &sum[j]);
      }
    }
    std::copy_n(sum.begin(), width, sums.begin() + static_cast<ptrdiff_t>(group * width));
  });
  std::array<double, kPointColumns> whole{};
  for (size_t i = 0; i < sums.size(); ++i) whole[i % width] += static_cast<double>(sums[i]);
  double mean = 0.0;
  for (const double sum : whole) mean += sum / static_cast<double>(at.size());
  if (!(mean > 0.0)) return importance;
  alignas(32) std::array<float, kPointColumns> inverse{};
  for (size_t j = 0; j < at.size(); ++j)
    inverse[j] = static_cast<float>(1.0 / std::max(whole[j], kDarkestUnshadowed * mean));
  const auto count = static_cast<float>(at.size());
  tbb::parallel_for(tbb::blocked_range<size_t>(0, candidates.size(), kCandidatesAtOnce),
                    [&](const tbb::blocked_range<size_t>& range) {
                      for (size_t i = range.begin(); i < range.end(); ++i) {
                        Floats8 squares = hn::Zero(kTag);
                        for (size_t j = 0; j < width; j += PointBlocks::kLanes) {
                          const Floats8 share = hn::Mul(hn::LoadU(kTag, &irradiance[i * width + j]),
                                                        hn::Load(kTag, &inverse[j]));
                          squares = hn::MulAdd(share, share, squares);
                        }
                        importance[i] =
                            std::sqrt(hn::GetLane(hn::SumOfLanes(kTag, squares)) / count);
                      }
                    });
  return importance;
}

}  // namespace lamplighter
