#include "renderer/probes/probe_light.h"

#include <algorithm>
#include <bit>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"
#include "renderer/prt/spherical_harmonics.h"

namespace lamplighter {
namespace {

constexpr uint32_t kKeySet = 0x9b;
constexpr size_t kBatch = 64;  // probes between two calls of progress
constexpr float kOpenShare = 0.5f, kBehindShare = 0.5f;

bool isZero(const ProbeSh& sh) {
  return std::ranges::all_of(sh, [](const vec3& c) { return c == vec3(0.0f); });
}

bool hasFarLight(const RenderScene& scene) {
  return !scene.sky.isBlack() ||
         std::ranges::any_of(scene.punctuals, [](const RenderPunctual& light) {
           return light.light.kind == PunctualKind::directional &&
                  light.light.intensity != vec3(0.0f);
         });
}

// The mean of the neighbours with light; false: there is none.
bool meanAround(const ProbeGrid& grid, const std::vector<bool>& isKnown,
                std::span<const ProbeSh> light, size_t index, ProbeSh& mean) {
  const glm::ivec3 node = grid.nodeAt(index);
  float count = 0.0f;
  mean = {};
  for (int axis = 0; axis < 3; ++axis) {
    for (const int step : {-1, 1}) {
      glm::ivec3 other = node;
      other[axis] += step;
      if (other[axis] < 0 || other[axis] >= grid.size[axis]) continue;
      const size_t i = grid.indexOf(other);
      if (!isKnown[i]) continue;
      for (size_t c = 0; c < kProbeCoefficients; ++c) mean[c] += light[i][c];
      count += 1.0f;
    }
  }
  if (count == 0.0f) return false;
  for (vec3& c : mean) c /= count;
  return true;
}

}  // namespace

std::array<float, kProbeCoefficients> probeBasis(const vec3& direction) {
  const ShVector all = shBasis(direction);
  std::array<float, kProbeCoefficients> out;
  std::copy_n(all.begin(), kProbeCoefficients, out.begin());
  return out;
}

void addLight(ProbeSh& sh, const vec3& towards, const vec3& light) {
  const auto basis = probeBasis(towards);
  for (size_t i = 0; i < kProbeCoefficients; ++i) sh[i] += basis[i] * light;
}

vec3 irradianceFrom(const ProbeSh& sh, const vec3& normal) {
  const auto basis = probeBasis(normal);
  vec3 sum(0.0f);
  for (size_t i = 0; i < kProbeCoefficients; ++i) {
    const size_t band = i == 0 ? 0 : i < 4 ? 1 : 2;
    sum += kCosineFactors[band] * basis[i] * sh[i];
  }
  return sum;
}

ProbeReference::ProbeReference(const RenderScene& scene, const RayCaster& rays,
                               const PathTracerOptions& paths, const LightSet& before)
    : scene_(scene), rays_(rays), paths_(paths), lights_(LightSet::forPaths(scene, before)) {}

void ProbeReference::addSamples(const vec3& place, uint32_t first, uint32_t count,
                                ProbeSh& sum) const {
  const uint32_t key = hash4(std::bit_cast<uint32_t>(place.x), std::bit_cast<uint32_t>(place.y),
                             std::bit_cast<uint32_t>(place.z), kKeySet);
  for (uint32_t i = first; i < first + count; ++i)
    for (const ArrivingLight& a : traceArrivingLight(scene_, rays_, lights_, place, key, i, paths_))
      if (a.light != vec3(0.0f)) addLight(sum, a.towards, a.light);
}

ProbeSh ProbeReference::punctualLight(const vec3& place) const {
  ProbeSh sum{};
  for (const RenderPunctual& light : scene_.punctuals) {
    const ArrivingLight a = arrivingPunctual(scene_, rays_, lights_, place, light);
    if (a.light != vec3(0.0f)) addLight(sum, a.towards, a.light);
  }
  return sum;
}

ProbeSh ProbeReference::light(const vec3& place, uint32_t samples) const {
  ProbeSh sum{};
  addSamples(place, 0, samples, sum);
  ProbeSh out = punctualLight(place);
  for (size_t i = 0; i < kProbeCoefficients; ++i)
    out[i] += sum[i] / static_cast<float>(std::max(samples, 1u));
  return out;
}

ProbeSource ProbeReference::source(uint32_t samples) const {
  return [this, samples](std::span<const vec3> places, std::span<ProbeSh> out) {
    tbb::parallel_for(size_t{0}, places.size(),
                      [&](size_t i) { out[i] = light(places[i], samples); });
  };
}

std::vector<ProbeSh> probeLight(const ProbeGrid& grid, const ProbeSource& source,
                                const ProbeProgress& progress) {
  std::vector<ProbeSh> light(grid.probes.size());
  std::vector<size_t> valid;
  std::vector<vec3> places;
  for (size_t i = 0; i < grid.probes.size(); ++i) {
    if (!grid.probes[i].isValid()) continue;
    valid.push_back(i);
    places.push_back(grid.probes[i].position);
  }
  for (size_t first = 0; first < valid.size(); first += kBatch) {
    const size_t count = std::min(kBatch, valid.size() - first), end = first + count;
    std::array<ProbeSh, kBatch> batch;
    source(std::span(places).subspan(first, count), std::span(batch).first(count));
    for (size_t i = 0; i < count; ++i) light[valid[first + i]] = batch[i];
    if (progress && !progress(static_cast<int>(end), static_cast<int>(valid.size())) &&
        end < valid.size())
      return {};
  }
  return light;
}

void markUnlit(const RenderScene& scene, std::span<const ProbeSh> light, ProbeGrid& grid) {
  const bool isLitFromFar = hasFarLight(scene);
  for (size_t i = 0; i < grid.probes.size(); ++i) {
    Probe& probe = grid.probes[i];
    if (!probe.isValid() || !isZero(light[i])) continue;
    if (probe.behind > kBehindShare)
      probe.state = ProbeState::inside;
    else if (probe.open > kOpenShare && !isLitFromFar)
      probe.state = ProbeState::dark;
  }
}

std::optional<ProbeSh> interpolatedLight(const ProbeGrid& grid, std::span<const ProbeSh> light,
                                         const vec3& place) {
  if (grid.probes.empty()) return std::nullopt;
  const vec3 last = vec3(grid.size - 1);
  const vec3 in = glm::clamp(place / grid.spacing - vec3(grid.first), vec3(0.0f), last);
  const glm::ivec3 low = glm::ivec3(in);
  const vec3 f = in - vec3(low);
  ProbeSh sum{};
  float weights = 0.0f;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
    const glm::ivec3 node = glm::min(low + step, grid.size - 1);
    const vec3 w = glm::mix(1.0f - f, f, vec3(step));
    const float weight = w.x * w.y * w.z;
    const size_t i = grid.indexOf(node);
    if (weight <= 0.0f || !grid.probes[i].isValid()) continue;
    for (size_t c = 0; c < kProbeCoefficients; ++c) sum[c] += weight * light[i][c];
    weights += weight;
  }
  if (weights <= 0.0f) return std::nullopt;
  for (vec3& c : sum) c /= weights;
  return sum;
}

void fillInvalid(const ProbeGrid& grid, std::span<ProbeSh> light) {
  std::vector<bool> isKnown(grid.probes.size());
  std::vector<size_t> open;
  for (size_t i = 0; i < grid.probes.size(); ++i) {
    isKnown[i] = grid.probes[i].isValid();
    if (isKnown[i]) continue;
    light[i] = {};
    open.push_back(i);
  }
  while (!open.empty()) {
    std::vector<std::pair<size_t, ProbeSh>> ring;
    std::vector<size_t> rest;
    for (const size_t i : open) {
      ProbeSh mean;
      if (meanAround(grid, isKnown, light, i, mean))
        ring.emplace_back(i, mean);
      else
        rest.push_back(i);
    }
    if (ring.empty()) return;
    for (const auto& [i, mean] : ring) {
      light[i] = mean;
      isKnown[i] = true;
    }
    open = std::move(rest);
  }
}

}  // namespace lamplighter
