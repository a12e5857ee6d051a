#include "renderer/sampling/scene_unit.h"

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include <tbb/parallel_for.h>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/sampling/emitters/emitter_cells.h"
#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

constexpr uint32_t kRays = 256;  // for each of the two spacings
constexpr uint32_t kFewestHits = 8;
constexpr uint32_t kSeed = 0x5ca1e;
// Surfaces that are further apart belong to a level in a smaller unit than metres, as rooms in
// millimetres do [m]. Those of a city of 4 km are 4 and 90 m apart.
constexpr float kMostSpacing = 128.0f, kLargerUnit = 1024.0f;
// Surfaces that are closer together belong to a level in a larger unit [m]. Those of single props,
// as a helmet, are 0.07 m apart.
constexpr float kLeastSpacing = 0x1p-4f, kSmallerUnit = 0x1p-7f, kLeastOfSmaller = 0x1p-6f;
constexpr float kSmallestUnit = 0x1p-40f, kLargestUnit = 0x1p40f;

// [unit of the scene]
float upperQuartile(std::vector<float> lengths) {
  std::erase_if(lengths, [](float t) { return !std::isfinite(t); });
  if (lengths.size() < kFewestHits) return 0.0f;
  const auto at = lengths.begin() + static_cast<ptrdiff_t>(lengths.size() * 3 / 4);
  std::ranges::nth_element(lengths, at);
  return *at;
}

// The i-th of kRays points, on triangles at even steps through those of all objects. ends: by
// object, the number of triangles of the objects up to and including it. The indices of hidden
// objects stay in the scene, so the place of a triangle there does not tell its object.
SampledPoint onTriangle(std::span<const size_t> ends, uint32_t index) {
  const size_t all = ends.back();
  const float jitter = toUnitFloat(hash4(index, kSeed, 1, 0));
  const double share = (static_cast<double>(index) + static_cast<double>(jitter)) / kRays;
  const size_t triangle = std::min(static_cast<size_t>(share * static_cast<double>(all)), all - 1);
  const auto object = std::ranges::upper_bound(ends, triangle) - ends.begin();
  const size_t first = object == 0 ? 0 : ends[static_cast<size_t>(object) - 1];
  const vec2 weights = sampleTriangle(sobol2(index, kSeed));
  return {static_cast<uint32_t>(object), static_cast<uint32_t>(triangle - first), weights.x,
          weights.y};
}

float spacingFrom(const RenderScene& scene, const RayCaster& rays, uint32_t seed,
                  const std::function<SampledPoint(uint32_t)>& pointAt) {
  // Beyond the rounding of coordinates. Like all lengths here it scales with the level, so that the
  // result is the same in each unit.
  const vec3 far = glm::max(glm::abs(scene.bounds.min), glm::abs(scene.bounds.max));
  const float tNear = 0x1p-17f * std::max({far.x, far.y, far.z});
  std::vector<float> lengths(kRays, std::numeric_limits<float>::infinity());
  tbb::parallel_for(0u, kRays, [&](uint32_t i) {
    const SampledPoint at = pointAt(i);
    const Surface s = surfaceAt(scene, at.object, at.triangle, at.u, at.v);
    const vec2 random = sobol2(i, seed);
    const float z = std::sqrt(random.x), across = std::sqrt(1.0f - random.x);
    const float angle = 2.0f * kPi * random.y;
    const float side = (hash4(i, seed, 2, 0) & 1) != 0 ? 1.0f : -1.0f;
    const Frame frame(side * s.geometricNormal);
    lengths[i] =
        rays.intersect({s.position, tNear,
                        frame.toWorld({across * std::cos(angle), across * std::sin(angle), z})})
            .t;
  });
  return upperQuartile(std::move(lengths));
}

}  // namespace

float unitFor(const Spacing& spacing) {
  const float most = std::max(spacing.ofTriangles, spacing.ofArea);
  float least = std::min(spacing.ofTriangles, spacing.ofArea);
  if (!(least > 0.0f)) least = most;  // only one spacing is known
  float unit = 1.0f;
  if (!(least > 0.0f)) return unit;
  while (least >= kMostSpacing * unit && unit < kLargestUnit) unit *= kLargerUnit;
  if (most >= kLeastSpacing) return unit;
  while (most < kLeastOfSmaller * unit && unit > kSmallestUnit) unit /= kLargerUnit;
  return most < kLeastSpacing * unit ? unit * kSmallerUnit : unit;
}

const Spacing& SceneSpacing::update(const RenderScene& scene, const RayCaster& rays,
                                    const RenderSceneChanges& changes) {
  if (!changes.surfaces()) return spacing_;
  surfaces_.update(scene, changes);
  spacing_ = {};
  if (!(surfaces_.area() > 0.0)) return spacing_;
  std::vector<size_t> ends;
  for (const RenderObject& o : scene.objects)
    ends.push_back((ends.empty() ? 0 : ends.back()) + o.triangleCount());
  spacing_.ofTriangles = scene.unit * spacingFrom(scene, rays, kSeed + 1,
                                                  [&](uint32_t i) { return onTriangle(ends, i); });
  spacing_.ofArea = scene.unit * spacingFrom(scene, rays, kSeed + 2,
                                             [&](uint32_t i) { return surfaces_.at(i, kSeed); });
  return spacing_;
}

}  // namespace lamplighter
