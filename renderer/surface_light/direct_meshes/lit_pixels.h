// Reflection of the light of meshes at the pixels of a picture: paper 4, equations (4) to (6).
#pragma once

#include <span>
#include <vector>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/surface_light/direct_meshes/light_factor.h"
#include "renderer/surface_light/pixels/pixel_reflectance.h"
#include "shaders/shared/brdf.h"

namespace lamplighter {

class LitPixels {
 public:
  LitPixels(const RenderScene& scene, const GBufferView& gbuffer, const vec3& eye,
            const SurfacePictureOptions& options);

  // A light of a mesh, and its weight in the mesh.
  struct Light {
    const LightFactor* factor = nullptr;
    vec3 weight{1.0f};
  };
  // Computes the radiance of each pixel by the irradiance of a mesh. Highlights: light from points
  // all over the lights, without shadows, times the share of the light that arrives. Normal maps
  // scale the irradiance by the same factor as the irradiance without shadows.
  void reflect(std::span<const Light> lights, std::span<const vec3> irradiance,
               std::vector<vec3>& radiance) const;

 private:
  struct Pixel {
    vec3 position{0.0f}, normal{0.0f}, smooth{0.0f};  // with and without the normal map
    vec3 diffuse{0.0f};                               // reflected share of irradiance, times π
    bool isLit = false, isGlossy = false, isMapped = false;
    shared::Lobe lobe{};
  };
  static size_t placesFor(const Pixel& p, std::span<const EmitterPoint> points);
  vec3 highlightOf(const Pixel& p, const LightFactor& light) const;

  vec3 eye_;
  std::vector<Pixel> pixels_;
};

}  // namespace lamplighter
