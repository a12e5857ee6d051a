#include "renderer/surface_light/bounced_light.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace lamplighter {
void bounceLight(const SurfaceMesh& mesh, const GatherLinks& links, const SurfaceState& state,
                 int bounces, std::vector<vec3>& out) {
  out.assign(mesh.values(), vec3(0.0f));
  const float share = 1.0f / static_cast<float>(std::max(links.rays(), 1));
  std::vector<vec3> incoming(mesh.samples(), vec3(0.0f));  // sky and bounced light so far
  std::vector<vec3> reflected(3 * mesh.leaves());          // at the corners of elements, times π
  for (int bounce = 0; bounce < bounces; ++bounce) {
    for (size_t s = 0; s < incoming.size(); ++s) incoming[s] = state.sky[s] + out[s];
    tbb::parallel_for(size_t{0}, mesh.leaves(), [&](size_t k) {
      const auto samples = mesh.samplesOfLeaf(static_cast<uint32_t>(k));
      for (size_t c = 0; c < 3; ++c)
        reflected[3 * k + c] = state.albedo[k] * (state.direct[3 * k + c] + incoming[samples[c]]);
    });
    tbb::parallel_for(size_t{0}, mesh.samples(), [&](size_t s) {
      vec3 sum(0.0f);
      for (const GatherLink& link : links.of(static_cast<uint32_t>(s))) {
        if (!link.isLeaf()) continue;
        const vec3* corners = &reflected[3 * size_t{link.leaf}];
        const vec3 w = link.weights();
        sum += w.x * corners[0] + w.y * corners[1] + w.z * corners[2];
      }
      out[s] = share * sum;
    });
    state.smoothing.apply(out);
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
