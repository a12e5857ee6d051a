#include "renderer/surface_light/light_smoothing.h"

#include <algorithm>
#include <utility>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

constexpr int kPasses = 2;
// Neighbours count in full if what they see is this many times as far away as they are from each
// other, and not at all from kNear times on.
constexpr float kFar = 4.0f, kNear = 1.0f;
// How far light is carried to buried samples [elements].
constexpr int kMostFills = 16;

}  // namespace

LightSmoothing::LightSmoothing(const RenderScene& scene, const SurfaceMesh& mesh,
                               const GatherLinks& links) {
  const size_t count = mesh.samples();
  isBuried_.resize(count);
  std::vector<float> reach(count);
  std::vector<vec3> position(count);
  tbb::parallel_for(size_t{0}, count, [&](size_t k) {
    const auto sample = static_cast<uint32_t>(k);
    isBuried_[k] = links.isBuried(sample, mesh.edge()) ? 1 : 0;
    reach[k] = links.reachOf(sample);
    position[k] =
        spotAt(scene, mesh.objectOfSample(sample), mesh.placesOfSample(sample)[0]).position;
  });
  findNeighbours(mesh);
  for (uint32_t s = 0; s < count; ++s) {
    for (uint32_t i = starts_[s]; i < starts_[s + 1]; ++i) {
      Neighbour& n = neighbours_[i];
      const float distance = glm::distance(position[s], position[n.sample]);
      const float ratio = std::min(reach[s], reach[n.sample]) / std::max(distance, 1e-6f);
      n.weight = isBuried_[s] || isBuried_[n.sample]
                     ? 0.0f
                     : std::clamp((ratio - kNear) / (kFar - kNear), 0.0f, 1.0f);
    }
  }
  orderBuried();
}

void LightSmoothing::findNeighbours(const SurfaceMesh& mesh) {
  std::vector<std::pair<uint32_t, uint32_t>> pairs;
  for (uint32_t leaf = 0; leaf < mesh.leaves(); ++leaf) {
    const auto samples = mesh.samplesOfLeaf(leaf);
    for (const uint32_t a : samples)
      for (const uint32_t b : samples)
        if (a != b) pairs.emplace_back(a, b);
  }
  std::ranges::sort(pairs);
  pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
  starts_.assign(mesh.samples() + 1, 0);
  for (const auto& [from, to] : pairs) {
    ++starts_[from + 1];
    neighbours_.push_back({to, 0.0f});
  }
  for (size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
}

// Each step fills those that have a neighbour with known light.
void LightSmoothing::orderBuried() {
  std::vector<uint8_t> isUnknown = isBuried_;
  std::vector<uint32_t> left;
  for (uint32_t s = 0; s < isBuried_.size(); ++s)
    if (isBuried_[s]) left.push_back(s);
  for (int step = 0; step < kMostFills && !left.empty(); ++step) {
    std::vector<uint32_t> later;
    const size_t first = fills_.size();
    for (const uint32_t s : left) {
      bool isKnown = false;
      for (uint32_t i = starts_[s]; i < starts_[s + 1]; ++i)
        isKnown = isKnown || isUnknown[neighbours_[i].sample] == 0;
      (isKnown ? fills_ : later).push_back(s);
    }
    if (fills_.size() == first) return;
    // The weights say from which neighbours each takes its light.
    for (size_t k = first; k < fills_.size(); ++k)
      for (uint32_t i = starts_[fills_[k]]; i < starts_[fills_[k] + 1]; ++i)
        neighbours_[i].weight = isUnknown[neighbours_[i].sample] ? 0.0f : 1.0f;
    for (size_t k = first; k < fills_.size(); ++k) isUnknown[fills_[k]] = 0;
    left = std::move(later);
  }
}

void LightSmoothing::apply(std::vector<vec3>& values) const {
  const size_t count = isBuried_.size();
  std::vector<vec3> before(count);
  for (int pass = 0; pass < kPasses; ++pass) {
    std::copy_n(values.begin(), count, before.begin());
    tbb::parallel_for(size_t{0}, count, [&](size_t s) {
      if (isBuried_[s]) return;
      vec3 sum = before[s];
      float weights = 1.0f;
      for (uint32_t i = starts_[s]; i < starts_[s + 1]; ++i) {
        sum += neighbours_[i].weight * before[neighbours_[i].sample];
        weights += neighbours_[i].weight;
      }
      values[s] = sum / weights;
    });
  }
  for (const uint32_t s : fills_) {
    vec3 sum(0.0f);
    float weights = 0.0f;
    for (uint32_t i = starts_[s]; i < starts_[s + 1]; ++i) {
      sum += neighbours_[i].weight * values[neighbours_[i].sample];
      weights += neighbours_[i].weight;
    }
    values[s] = sum / weights;
  }
}

void LightSmoothing::fillCorners(const SurfaceMesh& mesh, std::vector<vec3>& corners) const {
  tbb::parallel_for(size_t{0}, mesh.leaves(), [&](size_t k) {
    const auto samples = mesh.samplesOfLeaf(static_cast<uint32_t>(k));
    vec3 sum(0.0f);
    float known = 0.0f;
    for (size_t c = 0; c < 3; ++c) {
      if (isBuried(samples[c])) continue;
      sum += corners[3 * k + c];
      ++known;
    }
    if (known == 0.0f || known == 3.0f) return;
    for (size_t c = 0; c < 3; ++c)
      if (isBuried(samples[c])) corners[3 * k + c] = sum / known;
  });
}

size_t LightSmoothing::bytes() const {
  return (starts_.size() + fills_.size()) * sizeof(uint32_t) +
         neighbours_.size() * sizeof(Neighbour) + isBuried_.size();
}

}  // namespace lamplighter
