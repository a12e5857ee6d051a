// Importance of each potential light sample: its contribution to the view, without visibility
// (paper 2, section 4).
#pragma once

#include <span>
#include <vector>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/imperfect_maps/reflective_map.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

// Visible points that receive light.
struct ViewSamples {
  // World space; unit normals on the visible side.
  std::vector<float> x, y, z, nx, ny, nz;
  size_t size() const { return x.size(); }
  vec3 position(size_t i) const { return {x[i], y[i], z[i]}; }
  vec3 normal(size_t i) const { return {nx[i], ny[i], nz[i]}; }
};

// `count` points of the view and a little beyond its edges, by rays; fewer where the sky is seen.
ViewSamples raySamples(const RenderScene& scene, const RayCaster& rays, const View& view,
                       int count);

// cos⁺·cos⁺/max(d², d0²) [1/m²]; unit normals.
float geometryBetween(const vec3& from, const vec3& fromNormal, const vec3& to,
                      const vec3& toNormal, float clampDistance);

// By texel: B, the mean of lum(I)·cos⁺·cos⁺/max(d², d0²) over the samples, which are the same for
// all texels [W/m²].
std::vector<float> bidirectionalImportance(const ReflectiveMap& map, const ViewSamples& samples,
                                           float clampDistance);

struct PixelSampleOptions {
  int count = 16;       // for each texel, of a jittered grid of the pixels (paper 2, section 4.1)
  bool guided = false;  // drawn near the image of the texel (section 4.2)
  float clampDistance = 0.5f;  // [m]
  uint32_t seed = 1;
};

// The same with pixels as samples, different ones for each texel, and with the luminance of
// reflected light: lum(I)·lum(ρ)·….
std::vector<float> bidirectionalImportance(const ReflectiveMap& map, const GBufferView& gbuffer,
                                           const View& view, const PixelSampleOptions& options);
// Averages noisy values over those of the eight neighbours in a block of the map that lie
// approximately in the plane of the texel (section 6.5).
std::vector<float> blurred(const ReflectiveMap& map, const std::vector<float>& importance);

}  // namespace lamplighter
