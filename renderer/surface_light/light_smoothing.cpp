#include "renderer/surface_light/light_smoothing.h"

#include <algorithm>
#include <span>
#include <utility>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

// Number of averaging passes with all links, and additional ones per missing stage of links.
constexpr int kPasses = 2, kPassesMore = 2;
// Neighbours have full weight if what they see is at least kFar times as far away as they are from
// each other, and no weight at kNear times or less.
constexpr float kFar = 4.0f, kNear = 1.0f;
// Maximum distance over which light is propagated to buried samples [elements].
constexpr int kMostFills = 16;

}  // namespace

LightSmoothing::Near LightSmoothing::nearOf(const SurfaceMesh& mesh, uint32_t sample) {
  const SurfaceMesh::Part& part = mesh.part(mesh.objectOfSample(sample));
  const uint32_t local = sample - part.firstSample;
  const uint32_t first = part.shape->neighbourStarts[local];
  const uint32_t last = part.shape->neighbourStarts[local + 1];
  return {std::span(part.shape->neighbours).subspan(first, last - first), part.firstSample,
          part.firstNeighbour + first};
}

void LightSmoothing::update(const RenderScene& scene, const SurfaceMesh& mesh,
                            const GatherLinks& links, std::span<const uint32_t> changed,
                            bool isNewMesh) {
  const size_t count = mesh.samples();
  if (isNewMesh) *this = {};
  isBuried_.resize(count);
  reach_.resize(count);
  positions_.resize(count);
  weights_.resize(mesh.neighbours());
  tbb::parallel_for(size_t{0}, changed.size(), [&](size_t k) {
    const uint32_t s = changed[k];
    isBuried_[s] = links.isBuried(s, mesh.edge()) ? 1 : 0;
    reach_[s] = links.reachOf(s);
    positions_[s] = spotAt(scene, mesh.objectOfSample(s), mesh.placesOfSample(s)[0]).position;
  });
  passes_ = kPasses + kPassesMore * (GatherLinks::kStages - links.stage());
  findWeights(mesh);
  orderBuried(mesh);
}

void LightSmoothing::findWeights(const SurfaceMesh& mesh) {
  tbb::parallel_for(size_t{0}, mesh.samples(), [&](size_t k) {
    const auto s = static_cast<uint32_t>(k);
    if (mesh.objectOfSample(s) == SurfaceMesh::kUnused) {
      isBuried_[k] = 0;
      return;
    }
    const Near near = nearOf(mesh, s);
    for (size_t i = 0; i < near.samples.size(); ++i) {
      const uint32_t other = near.firstSample + near.samples[i];
      const float distance = glm::distance(positions_[s], positions_[other]);
      const float ratio = std::min(reach_[s], reach_[other]) / std::max(distance, 1e-6f);
      weights_[near.first + i] = isBuried_[s] || isBuried_[other]
                                     ? 0.0f
                                     : std::clamp((ratio - kNear) / (kFar - kNear), 0.0f, 1.0f);
    }
  });
}

// Each step fills the samples that have a neighbour with known light.
void LightSmoothing::orderBuried(const SurfaceMesh& mesh) {
  fills_.clear();
  std::vector<uint8_t> isUnknown = isBuried_;
  std::vector<uint32_t> left;
  for (uint32_t s = 0; s < isBuried_.size(); ++s)
    if (isBuried_[s]) left.push_back(s);
  for (int step = 0; step < kMostFills && !left.empty(); ++step) {
    std::vector<uint32_t> later;
    const size_t first = fills_.size();
    for (const uint32_t s : left) {
      const Near near = nearOf(mesh, s);
      const bool isKnown = std::ranges::any_of(
          near.samples, [&](uint32_t n) { return isUnknown[near.firstSample + n] == 0; });
      (isKnown ? fills_ : later).push_back(s);
    }
    if (fills_.size() == first) return;
    // The weights define from which neighbours each sample takes its light.
    for (size_t k = first; k < fills_.size(); ++k) {
      const Near near = nearOf(mesh, fills_[k]);
      for (size_t i = 0; i < near.samples.size(); ++i)
        weights_[near.first + i] = isUnknown[near.firstSample + near.samples[i]] ? 0.0f : 1.0f;
    }
    for (size_t k = first; k < fills_.size(); ++k) isUnknown[fills_[k]] = 0;
    left = std::move(later);
  }
}

void LightSmoothing::apply(const SurfaceMesh& mesh, std::vector<vec3>& values) const {
  const size_t count = isBuried_.size();
  std::vector<vec3> before(count);
  for (int pass = 0; pass < passes_; ++pass) {
    std::copy_n(values.begin(), count, before.begin());
    tbb::parallel_for(size_t{0}, count, [&](size_t k) {
      const auto s = static_cast<uint32_t>(k);
      if (isBuried_[k] || mesh.objectOfSample(s) == SurfaceMesh::kUnused) return;
      const Near near = nearOf(mesh, s);
      vec3 sum = before[k];
      float weights = 1.0f;
      for (size_t i = 0; i < near.samples.size(); ++i) {
        sum += weights_[near.first + i] * before[near.firstSample + near.samples[i]];
        weights += weights_[near.first + i];
      }
      values[k] = sum / weights;
    });
  }
  for (const uint32_t s : fills_) {
    const Near near = nearOf(mesh, s);
    vec3 sum(0.0f);
    float weights = 0.0f;
    for (size_t i = 0; i < near.samples.size(); ++i) {
      sum += weights_[near.first + i] * values[near.firstSample + near.samples[i]];
      weights += weights_[near.first + i];
    }
    values[s] = sum / weights;
  }
}

// From the last step of apply() back to the first.
std::map<uint32_t, double> LightSmoothing::sharesOf(const SurfaceMesh& mesh,
                                                    uint32_t sample) const {
  std::map<uint32_t, double> shares{{sample, 1.0}};
  // Distributes the weight of a sample to its neighbours and, by `own`, to itself.
  const auto share = [&](uint32_t s, double whole, double own, std::map<uint32_t, double>& out) {
    const Near near = nearOf(mesh, s);
    double weights = own;
    for (size_t i = 0; i < near.samples.size(); ++i)
      weights += static_cast<double>(weights_[near.first + i]);
    if (own > 0.0) out[s] += whole * own / weights;
    for (size_t i = 0; i < near.samples.size(); ++i)
      if (weights_[near.first + i] > 0.0f)
        out[near.firstSample + near.samples[i]] +=
            whole * static_cast<double>(weights_[near.first + i]) / weights;
  };
  for (size_t k = fills_.size(); k-- > 0;) {
    const auto found = shares.find(fills_[k]);
    if (found == shares.end()) continue;
    const double whole = found->second;
    shares.erase(found);
    share(fills_[k], whole, 0.0, shares);
  }
  for (int pass = 0; pass < passes_; ++pass) {
    std::map<uint32_t, double> before;
    for (const auto& [s, whole] : shares) {
      if (isBuried_[s])
        before[s] += whole;
      else
        share(s, whole, 1.0, before);
    }
    shares = std::move(before);
  }
  return shares;
}

void LightSmoothing::fillCorners(const SurfaceMesh& mesh, std::vector<vec3>& corners) const {
  tbb::parallel_for(size_t{0}, mesh.leaves(), [&](size_t k) {
    if (mesh.objectOfLeaf(static_cast<uint32_t>(k)) == SurfaceMesh::kUnused) return;
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
  return positions_.size() * sizeof(vec3) + (reach_.size() + weights_.size()) * sizeof(float) +
         isBuried_.size() + fills_.size() * sizeof(uint32_t);
}

}  // namespace lamplighter
