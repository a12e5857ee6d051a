// What each potential light sample brings to the view, without visibility (paper 2, section 4).
#pragma once

#include <span>
#include <vector>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/imperfect_maps/reflective_map.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

// Visible points that light is sent to.
struct ViewSamples {
  // World space; unit normals on the visible side; luminance of the albedo.
  std::vector<float> x, y, z, nx, ny, nz, albedo;
  size_t size() const { return x.size(); }
  void add(const vec3& position, const vec3& normal, float albedoLuminance);
};

// `count` points of the view and a little beyond its edges, by rays; fewer where the sky is seen.
ViewSamples raySamples(const RenderScene& scene, const RayCaster& rays, const View& view,
                       int count);

// cos⁺·cos⁺/max(d², d0²) [1/m²]; unit normals.
float geometryBetween(const vec3& from, const vec3& fromNormal, const vec3& to,
                      const vec3& toNormal, float clampDistance);

struct BidirectionalOptions {
  // Each texel has samples of its own, of a jittered grid of the pixels (paper 2, section 4.1). 0:
  // all texels share the given ones.
  int pixels = 0;
  // They are drawn near the image of the texel (section 4.2).
  bool guided = false;
  float clampDistance = 0.5f;  // [m]
  uint32_t seed = 1;
  bool operator==(const BidirectionalOptions&) const = default;
};

// By texel: B, the mean over the samples of lum(I·ρ)·cos⁺·cos⁺/max(d², d0²) [W/m²].
std::vector<float> bidirectionalImportance(const ReflectiveMap& map, const ViewSamples& samples,
                                           float clampDistance);
// The same with options.pixels samples of the picture for each texel.
std::vector<float> bidirectionalImportance(const ReflectiveMap& map, const GBufferView& gbuffer,
                                           const View& view, const BidirectionalOptions& options);
// Averages noisy values over neighbours in a block of the map that lie on surfaces of the same
// direction and distance (section 6.5).
std::vector<float> blurred(const ReflectiveMap& map, const std::vector<float>& importance);

}  // namespace lamplighter
