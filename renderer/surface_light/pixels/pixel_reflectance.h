// Reflection towards the eye, at a visible point, of light that is stored on surfaces.
#pragma once

#include "renderer/backends/gbuffer_view.h"
#include "renderer/scene/surface.h"

namespace lamplighter {

struct SurfacePictureOptions {
  bool white = false;     // with ρ = 1: shows only the light
  bool speculars = true;  // metallic-roughness BRDF
  float leastRoughness = 0.1f;
  bool operator==(const SurfacePictureOptions&) const = default;
};

// Reflected shares of uniform light, times π, and the shape of the lobe.
struct PixelReflectance {
  vec3 diffuse{0.0f};
  vec3 lobe{0.0f};         // its directional albedo
  float roughness = 1.0f;  // at least that of the options
};

// `weights`: weights of the second and third vertex of the triangle that the pixel shows. `eye`: in
// world space.
PixelReflectance reflectanceOf(const RenderScene& scene, const GBufferPoint& p, const vec2& weights,
                               const vec3& eye, const SurfacePictureOptions& options);

}  // namespace lamplighter
