// The specular light of glossy pixels (shaders/shared/vpl_speculars.h), in a separate pass: every
// VPL with its shadow map at every glossy pixel. Costs nothing if the scene has no glossy surface.
#pragma once

#include <filesystem>
#include <span>

#include "renderer/backends/gl/gl_gbuffer.h"
#include "renderer/backends/gl/many_lights/gl_shadow_maps.h"
#include "renderer/gl/radiance_texture.h"

namespace lamplighter {
class PatchLights;
}

namespace lamplighter::gl {

class GlSpeculars {
 public:
  GlSpeculars(const std::filesystem::path& shaders, const VplBuffer& vpls);
  void reload(const std::filesystem::path& shaders, const VplBuffer& vpls);

  // Sums over the G-buffer's glossy pixels, if `params` asks for speculars.
  void sum(const GlScene& scene, const GlGBuffer& gbuffer, const GlShadowMaps& maps,
           const VplBuffer& buffer, std::span<const shared::Vpl> vpls,
           const shared::ShadingParams& params, const PatchLights* patches);
  // Replaces Lambertian shading, which used this irradiance, by shading with specular light.
  void addTo(const RadianceTexture& picture, const GlGBuffer& gbuffer, GLuint irradiance);
  // No speculars until the next sum.
  void clear() { isOn_ = false; }

  uint64_t bytes() const { return uint64_t{16} * static_cast<uint64_t>(width_) * height_; }

 private:
  Program sums_[3];  // by Vpl.position.w
  // The same with light linking; compiled on first use.
  Program linked_[3];
  ProgramFiles linkedFiles_[3];
  std::filesystem::path shaders_;
  Program add_;
  VertexArray emptyVertexArray_;
  Framebuffer sumFramebuffer_, pictureFramebuffer_;
  Texture radiance_;  // RGBA32F
  int width_ = 0, height_ = 0;
  bool isOn_ = false;
  float leastRoughness_ = 0.0f;
};

}  // namespace lamplighter::gl
