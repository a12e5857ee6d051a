// The sum of many lights over the G-buffer, and the picture made of it.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "renderer/backends/gl/gl_gbuffer.h"
#include "renderer/backends/gl/gl_shadow_maps.h"
#include "renderer/gl/radiance_texture.h"

namespace lamplighter::gl {

class GlLighting {
 public:
  GlLighting(const std::filesystem::path& shaders, const VplBuffer& vpls);
  void reload(const std::filesystem::path& shaders, const VplBuffer& vpls);

  // Irradiance of the G-buffer's pixels, starting from zero.
  void sum(const GlGBuffer& gbuffer, const GlShadowMaps& maps, const VplBuffer& buffer,
           std::span<const shared::Vpl> vpls, const shared::ShadingParams& params);
  // No light at all, for a G-buffer that nothing was summed over yet.
  void clear(int width, int height);
  std::shared_ptr<RadianceTexture> compose(const GlGBuffer& gbuffer, const vec3& sky);

  uint64_t bytes() const;

 private:
  std::shared_ptr<RadianceTexture> freePicture(int width, int height);

  Program kinds_[3];  // by Vpl.position.w
  Program compose_;
  VertexArray emptyVertexArray_;
  Framebuffer irradianceFramebuffer_, pictureFramebuffer_;
  Texture irradiance_;  // RGBA32F: hundreds of additions must not lose the small ones
  int width_ = 0, height_ = 0;
  // Those that nobody else holds are drawn over.
  std::vector<std::shared_ptr<RadianceTexture>> pictures_;
};

}  // namespace lamplighter::gl
