#include "renderer/sampling/emitters/emitter_choice.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/sampling/emitters/lights.h"

namespace lamplighter {
namespace {

constexpr int kMostCells = 4096;
constexpr size_t kMostSums = size_t{1} << 20;
// The share of samples that is chosen by flux only.
constexpr float kByFlux = 0.1f;

float squaredDistance(const Bounds& a, const Bounds& b) {
  const vec3 d = glm::max(glm::max(a.min - b.max, b.min - a.max), vec3(0.0f));
  return glm::dot(d, d);
}

}  // namespace

EmitterChoice::EmitterChoice(const RenderScene& scene, std::span<const Emitter> emitters)
    : indexAmong_(emitters.size(), 0), bounds_(scene.bounds) {
  std::vector<float> flux;
  for (size_t i = 0; i < emitters.size(); ++i) {
    const float f = luminance(emitters[i].flux);
    if (emitters[i].kind != EmitterKind::surface || !(f > 0.0f)) continue;
    indexAmong_[i] = static_cast<uint32_t>(emitters_.size());
    emitters_.push_back(static_cast<int>(i));
    flux.push_back(f);
  }
  float allFlux = 0.0f;
  for (const float f : flux) allFlux += f;
  const vec3 size = glm::max(bounds_.max - bounds_.min, vec3(1e-3f));
  const auto most = static_cast<float>(
      std::clamp(kMostSums / emitters_.size(), size_t{1}, static_cast<size_t>(kMostCells)));
  side_ = std::max(std::cbrt(size.x * size.y * size.z / most), 1e-3f);
  // Flat scenes: rounding up must not make more cells than wanted.
  const auto cellsOf = [&] { return glm::max(glm::ivec3(glm::ceil(size / side_)), 1); };
  for (cells_ = cellsOf();
       static_cast<float>(cells_.x) * static_cast<float>(cells_.y) * static_cast<float>(cells_.z) >
       most;
       cells_ = cellsOf())
    side_ *= 1.2f;
  const size_t count = emitters_.size();
  sums_.resize(static_cast<size_t>(cells_.x * cells_.y * cells_.z) * count);
  tbb::parallel_for(0, cells_.z, [&](int z) {
    for (int y = 0; y < cells_.y; ++y)
      for (int x = 0; x < cells_.x; ++x) {
        Bounds cell;
        cell.add(bounds_.min + side_ * vec3(x, y, z));
        cell.add(bounds_.min + side_ * vec3(x + 1, y + 1, z + 1));
        float* sums = &sums_[static_cast<size_t>((z * cells_.y + y) * cells_.x + x) * count];
        float all = 0.0f;
        for (size_t k = 0; k < count; ++k) {
          const Emitter& e = emitters[static_cast<size_t>(emitters_[k])];
          const Bounds& lamp = scene.objects[e.object].bounds;
          const float radius = 0.5f * (side_ + lamp.radius());
          sums[k] = flux[k] / (squaredDistance(cell, lamp) + radius * radius);
          all += sums[k];
        }
        float sum = 0.0f;
        for (size_t k = 0; k < count; ++k) {
          sum += (1.0f - kByFlux) * sums[k] / all + kByFlux * flux[k] / allFlux;
          sums[k] = sum;
        }
        sums[count - 1] = 1.0f;
      }
  });
}

size_t EmitterChoice::cellOf(const vec3& place) const {
  const glm::ivec3 at =
      glm::clamp(glm::ivec3((place - bounds_.min) / side_), glm::ivec3(0), cells_ - 1);
  return static_cast<size_t>((at.z * cells_.y + at.y) * cells_.x + at.x);
}

int EmitterChoice::choose(const vec3& place, float u, float& probability) const {
  const std::span<const float> sums = sumsOf(cellOf(place));
  const auto k =
      static_cast<size_t>(std::upper_bound(sums.begin(), sums.end() - 1, u) - sums.begin());
  probability = partOf(sums, k);
  return emitters_[k];
}

float EmitterChoice::probability(const vec3& place, int emitter) const {
  return partOf(sumsOf(cellOf(place)), indexAmong_[static_cast<size_t>(emitter)]);
}

}  // namespace lamplighter
