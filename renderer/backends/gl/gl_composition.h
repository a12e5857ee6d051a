// Composes the picture of the gl backend from light and surfaces.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "renderer/backends/gl/gl_gbuffer.h"
#include "renderer/gl/radiance_texture.h"

namespace lamplighter::gl {

class GlComposition {
 public:
  GlComposition(const std::filesystem::path& shaders, std::shared_ptr<PicturePasses> passes);
  void reload(const std::filesystem::path& shaders);

  // Le + ρ/π · E of each pixel; the sky where nothing is hit. `irradiance`: a texture of the size
  // of the G-buffer. `white`: with ρ = 1. Without emission: only ρ/π · E.
  std::shared_ptr<RadianceTexture> compose(const GlGBuffer& gbuffer, const Sky& sky,
                                           GLuint irradiance, bool white, bool withEmission = true);
  // The same with E in main memory.
  std::shared_ptr<RadianceTexture> compose(const GlGBuffer& gbuffer, const Sky& sky,
                                           const Image& irradiance, bool white);

  // Each pixel times that of `gains`, which has the size of the picture and stays on the GPU until
  // other gains come; and each pixel minus that of `taken`.
  std::shared_ptr<RadianceTexture> multiplied(const RadianceTexture& picture,
                                              const std::shared_ptr<const Image>& gains);
  std::shared_ptr<RadianceTexture> difference(const RadianceTexture& picture,
                                              const RadianceTexture& taken);

  uint64_t bytes() const;

 private:
  // Sets the sky of the compose program for its kind of sky, and returns that program.
  const Program& setSky(const GlGBuffer& gbuffer, const Sky& sky);
  void resize(int width, int height);
  std::shared_ptr<RadianceTexture> freePicture();

  std::shared_ptr<PicturePasses> passes_;
  Program compose_[3];  // by kind of sky (shaders/shared/sky.h)
  VertexArray emptyVertexArray_;
  Framebuffer pictureFramebuffer_;
  std::shared_ptr<const SkyImage> skyImage_;  // the image that skyTexture_ holds
  Texture skyTexture_;
  Texture irradiance_;  // RGB32F, holds the irradiance image of the last call that had one
  std::shared_ptr<const Image> gains_;  // what gainsTexture_ holds
  Texture gainsTexture_;                // RGB32F
  // Pictures of this size; those that nobody else holds are reused.
  std::vector<std::shared_ptr<RadianceTexture>> pictures_;
  int width_ = 0, height_ = 0;
};

}  // namespace lamplighter::gl
