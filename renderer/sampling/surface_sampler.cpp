#include "renderer/sampling/surface_sampler.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/sampling/emitters/emitter_cells.h"

namespace lamplighter {
namespace {

struct Part {
  size_t index = 0;
  double rest = 0.0, size = 0.0;  // distance of the place from the start of the part; its length
};

// The part of a running sum that contains `at`. Parts of length 0 are never chosen.
Part partAt(const std::vector<double>& ends, double at) {
  auto end = std::upper_bound(ends.begin(), ends.end(), at);
  // Rounding may give the very end: the last part that is not empty.
  if (end == ends.end()) end = std::lower_bound(ends.begin(), ends.end(), ends.back());
  const double start = end == ends.begin() ? 0.0 : *(end - 1);
  return {static_cast<size_t>(end - ends.begin()), at - start, *end - start};
}

}  // namespace

SurfaceSampler::SurfaceSampler(const RenderScene& scene) {
  RenderSceneChanges all;
  all.rebuilt = true;
  update(scene, all);
}

void SurfaceSampler::update(const RenderScene& scene, const RenderSceneChanges& changes) {
  if (changes.rebuilt) {
    triangleEnds_.assign(scene.objects.size(), {});
    tbb::parallel_for(size_t{0}, scene.objects.size(), [&](size_t i) { measure(scene, i); });
  } else {
    triangleEnds_.resize(scene.objects.size());
    for (const uint32_t object : changes.movedObjects) measure(scene, object);
  }
  if (changes.rebuilt || changes.materials || !changes.movedObjects.empty()) sum(scene);
}

void SurfaceSampler::measure(const RenderScene& scene, size_t object) {
  const RenderObject& o = scene.objects[object];
  std::vector<double>& ends = triangleEnds_[object];
  ends.resize(o.triangleCount());
  double sum = 0.0;
  for (uint32_t t = 0; t < o.triangleCount(); ++t) {
    const uint32_t* corner = &scene.indices[o.firstIndex + 3 * t];
    const vec3& a = scene.positions[corner[0]];
    const vec3 cross = glm::cross(scene.positions[corner[1]] - a, scene.positions[corner[2]] - a);
    ends[t] = sum += 0.5 * static_cast<double>(glm::length(cross));
  }
}

void SurfaceSampler::sum(const RenderScene& scene) {
  ends_.resize(scene.objects.size());
  double sum = 0.0;
  for (size_t i = 0; i < ends_.size(); ++i) {
    const Material& m = scene.materials[static_cast<size_t>(scene.objects[i].material)];
    if (!m.isClear() && !triangleEnds_[i].empty()) sum += triangleEnds_[i].back();
    ends_[i] = sum;
  }
}

SampledPoint SurfaceSampler::at(uint32_t index, uint32_t seed) const {
  const vec2 point = sobol2(index, seed);
  // The 24 bits of a float are too few for both the choice of a triangle among millions and a
  // place in it. Random bits below them keep the strata.
  const double fine = 0x1p-24 * static_cast<double>(toUnitFloat(hash4(index, seed, 0x5eed, 0)));
  const Part object = partAt(ends_, (static_cast<double>(point.x) + fine) * area());
  const Part triangle = partAt(triangleEnds_[object.index], object.rest);
  const float along = std::min(static_cast<float>(triangle.rest / triangle.size), 0x1.fffffep-1f);
  const vec2 weights = sampleTriangle({along, point.y});
  return {static_cast<uint32_t>(object.index), static_cast<uint32_t>(triangle.index), weights.x,
          weights.y};
}

}  // namespace lamplighter
