#include "renderer/imperfect_maps/visible_importance.h"

#include <algorithm>
#include <atomic>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"

namespace lamplighter {
namespace {

constexpr uint32_t kSeeingSet = 0xb3;
// Number that is added to the unblocked rays.
constexpr float kArriving = 0.5f;

}  // namespace

void VisibleImportance::restart(std::span<const float> importance) {
  importance_.assign(importance.begin(), importance.end());
  column_ = 0;
}

uint64_t VisibleImportance::goOn(const ReflectiveMap& map, const ViewSamples& samples,
                                 float clampDistance, const RayCaster& rays, uint64_t mostRays) {
  const auto aColumn = static_cast<uint64_t>(ReflectiveMap::kRows) * kRays;
  const int last = std::min(map.columns(),
                            column_ + static_cast<int>(std::max<uint64_t>(mostRays / aColumn, 1)));
  std::atomic<uint64_t> cast{0};
  tbb::parallel_for(column_, last, [&](int column) {
    uint64_t own = 0;
    std::vector<float> sums;
    for (int row = 0; row < ReflectiveMap::kRows; ++row)
      own += see(map, samples, clampDistance, rays, ReflectiveMap::indexOf(column, row), sums);
    cast += own;
  });
  column_ = last;
  return cast;
}

uint64_t VisibleImportance::see(const ReflectiveMap& map, const ViewSamples& samples,
                                float clampDistance, const RayCaster& rays, size_t texel,
                                std::vector<float>& sums) {
  if (!(importance_[texel] > 0.0f)) return 0;
  const vec3 from = map.texels().position(texel), normal = map.texels().normal(texel);
  sums.clear();
  float sum = 0.0f;
  for (size_t k = 0; k < samples.size(); ++k) {
    sum += geometryBetween(from, normal, samples.position(k), samples.normal(k), clampDistance);
    sums.push_back(sum);
  }
  if (!(sum > 0.0f)) return 0;
  const float offset = toUnitFloat(hash4(static_cast<uint32_t>(texel), 0, 0, kSeeingSet));
  int arriving = 0;
  for (int i = 0; i < kRays; ++i) {
    const float at = sum * (static_cast<float>(i) + offset) / static_cast<float>(kRays);
    const auto k = static_cast<size_t>(
        std::min(std::ranges::upper_bound(sums, at), sums.end() - 1) - sums.begin());
    const vec3 way = samples.position(k) - from;
    arriving += rays.occluded({from, 0.0f, way, 1.0f}) ? 0 : 1;
  }
  importance_[texel] *= (static_cast<float>(arriving) + kArriving) / (kRays + kArriving);
  return kRays;
}

}  // namespace lamplighter
