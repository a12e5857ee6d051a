#include "renderer/surface_light/bounced_light.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "renderer/base/simd.h"

namespace lamplighter {

vec3 gatheredLight(std::span<const GatherLink> links, const ReflectedLight& reflected) {
  const hn::FixedTag<float, 4> tag;
  auto sum = hn::Zero(tag);
  for (const GatherLink& link : links) {
    if (!link.isLeaf()) continue;
    const float* corners = &reflected[12 * size_t{link.leaf}];
    const vec3 w = link.weights();
    sum = hn::MulAdd(hn::Set(tag, w.x), hn::LoadU(tag, corners), sum);
    sum = hn::MulAdd(hn::Set(tag, w.y), hn::LoadU(tag, corners + 4), sum);
    sum = hn::MulAdd(hn::Set(tag, w.z), hn::LoadU(tag, corners + 8), sum);
  }
  float lanes[4];
  hn::StoreU(sum, tag, lanes);
  return {lanes[0], lanes[1], lanes[2]};
}

void bounceLight(const SurfaceMesh& mesh, const GatherLinks& links, const SurfaceState& state,
                 int bounces, int most, SurfaceLightPart shown, std::vector<vec3>& out,
                 ReflectedLight& reflected) {
  out.assign(mesh.values(), vec3(0.0f));
  std::vector<vec3> incoming(mesh.samples(), vec3(0.0f));  // sky and bounced light so far
  reflected.assign(12 * mesh.leaves(), 0.0f);
  for (int bounce = 0; bounce < bounces; ++bounce) {
    const auto used = static_cast<size_t>(bounce + 1 == bounces ? most : (most + 3) / 4);
    for (size_t s = 0; s < incoming.size(); ++s) incoming[s] = state.sky[s] + out[s];
    tbb::parallel_for(size_t{0}, mesh.leaves(), [&](size_t k) {
      if (mesh.objectOfLeaf(static_cast<uint32_t>(k)) == SurfaceMesh::kUnused) return;
      const auto samples = mesh.samplesOfLeaf(static_cast<uint32_t>(k));
      for (size_t c = 0; c < 3; ++c) {
        const vec3 light = state.albedo[k] * (state.direct[3 * k + c] + incoming[samples[c]]);
        std::copy_n(&light.x, 3, &reflected[12 * k + 4 * c]);
      }
    });
    tbb::parallel_for(size_t{0}, mesh.samples(), [&](size_t s) {
      const auto sample = static_cast<uint32_t>(s);
      if (mesh.objectOfSample(sample) == SurfaceMesh::kUnused) return;
      const auto known = links.of(sample);
      const auto ends = known.first(std::min(known.size(), used));
      out[s] = gatheredLight(ends, reflected) / static_cast<float>(ends.size());
    });
    state.smoothing.apply(mesh, out);
  }
  for (size_t s = 0; s < incoming.size(); ++s) {
    if (shown == SurfaceLightPart::sky) out[s] = state.sky[s];
    if (shown == SurfaceLightPart::both) out[s] += state.sky[s];
  }
  // Vertices of small triangles.
  tbb::parallel_for(size_t{0}, mesh.objects(), [&](size_t o) {
    const SurfaceMesh::Part& part = mesh.part(static_cast<uint32_t>(o));
    if (!part.shape) return;
    vec3* blended = out.data() + mesh.samples() + part.firstBlend;
    for (const SurfaceShape::Blend& blend : part.shape->blends) {
      vec3 sum(0.0f);
      for (size_t k = 0; k < blend.weights.size(); ++k)
        sum += blend.weights[k] * out[part.firstSample + blend.samples[k]];
      *blended++ = sum;
    }
  });
}

}  // namespace lamplighter
