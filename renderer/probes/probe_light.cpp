#include "renderer/probes/probe_light.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "renderer/prt/spherical_harmonics.h"

namespace lamplighter {
namespace {

constexpr size_t kBatch = 64;  // probes between two calls of progress
constexpr float kOpenShare = 0.5f;

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
                               const PathTracerOptions& paths)
    : scene_(scene), rays_(rays), paths_(paths), lights_(scene) {}

void ProbeReference::addSamples(const vec3& position, uint32_t key, uint32_t first, uint32_t count,
                                ProbeSh& sum) const {
  for (uint32_t i = first; i < first + count; ++i)
    for (const ArrivingLight& a :
         traceArrivingLight(scene_, rays_, lights_, position, key, i, paths_))
      if (a.light != vec3(0.0f)) addLight(sum, a.towards, a.light);
}

ProbeSh ProbeReference::punctualLight(const vec3& position) const {
  ProbeSh sum{};
  for (const RenderPunctual& light : scene_.punctuals) {
    const ArrivingLight a = arrivingPunctual(scene_, rays_, lights_, position, light);
    if (a.light != vec3(0.0f)) addLight(sum, a.towards, a.light);
  }
  return sum;
}

ProbeSh ProbeReference::light(const vec3& position, uint32_t key, uint32_t samples) const {
  ProbeSh sum{};
  addSamples(position, key, 0, samples, sum);
  ProbeSh out = punctualLight(position);
  for (size_t i = 0; i < kProbeCoefficients; ++i)
    out[i] += sum[i] / static_cast<float>(std::max(samples, 1u));
  return out;
}

std::vector<ProbeSh> probeLight(const RenderScene& scene, const RayCaster& rays,
                                const ProbeGrid& grid, const ProbeLightOptions& options,
                                const ProbeProgress& progress) {
  const ProbeReference reference(scene, rays, options.paths);
  std::vector<ProbeSh> light(grid.probes.size());
  std::vector<size_t> valid;
  for (size_t i = 0; i < grid.probes.size(); ++i)
    if (grid.probes[i].isValid()) valid.push_back(i);
  for (size_t first = 0; first < valid.size(); first += kBatch) {
    const size_t end = std::min(first + kBatch, valid.size());
    tbb::parallel_for(first, end, [&](size_t i) {
      const Probe& probe = grid.probes[valid[i]];
      light[valid[i]] =
          reference.light(probe.position, probe.key, static_cast<uint32_t>(options.samples));
    });
    if (progress && !progress(static_cast<int>(end), static_cast<int>(valid.size())) &&
        end < valid.size())
      return {};
  }
  return light;
}

void markDark(const RenderScene& scene, std::span<const ProbeSh> light, ProbeGrid& grid) {
  if (hasFarLight(scene)) return;
  for (size_t i = 0; i < grid.probes.size(); ++i) {
    Probe& probe = grid.probes[i];
    if (probe.isValid() && probe.open > kOpenShare && isZero(light[i]))
      probe.state = ProbeState::dark;
  }
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
