// What the lobes of glossy pixels give the eye (shaders/shared/vpl_speculars.h), in a pass of its
// own: every VPL with its shadow map at every glossy pixel. Costs nothing where none is in the
// scene.
#pragma once

#include <filesystem>
#include <span>

#include "renderer/backends/gl/gl_gbuffer.h"
#include "renderer/backends/gl/gl_shadow_maps.h"
#include "renderer/gl/radiance_texture.h"

namespace lamplighter {
class PatchLights;
}

namespace lamplighter::gl {

class GlSpeculars {
 public:
  GlSpeculars(const std::filesystem::path& shaders, const VplBuffer& vpls);
  void reload(const std::filesystem::path& shaders, const VplBuffer& vpls);

  // Of the G-buffer's glossy pixels, if `params` ask for it.
  void sum(const GlScene& scene, const GlGBuffer& gbuffer, const GlShadowMaps& maps,
           const VplBuffer& buffer, std::span<const shared::Vpl> vpls,
           const shared::ShadingParams& params, const PatchLights* patches);
  // Makes the picture of surfaces that are all Lambert's, with this irradiance, one with speculars.
  void addTo(const RadianceTexture& picture, const GlGBuffer& gbuffer, GLuint irradiance);
  // There are none until the next sum.
  void clear() { isOn_ = false; }

  uint64_t bytes() const { return uint64_t{16} * static_cast<uint64_t>(width_) * height_; }

 private:
  Program sums_[3];  // by Vpl.position.w
  // The same where lights leave something out; compiled when it is first so.
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
