// Converts the radiance of a frame to the texture that the viewport shows.
#pragma once

#include <filesystem>

#include "renderer/backends/radiance_image.h"
#include "renderer/gl/program.h"
#include "renderer/gl/shader_source.h"
#include "renderer/image/tone_map.h"

namespace lamplighter::gl {

class DisplayPass {
 public:
  explicit DisplayPass(const std::filesystem::path& shaders = defaultShaderFolder());

  // Tone-maps the picture with exposure in EV. Returns a texture of the same size (RGBA8,
  // sRGB-encoded, opaque; row 0 is the top). The texture belongs to this pass, and the next call
  // overwrites it. A picture in main memory is uploaded first, unless it is the picture of the last
  // call.
  GLuint render(const std::shared_ptr<RadianceImage>& image, float exposureEv,
                ToneMapper mapper = ToneMapper::filmic);

  // The same, into a framebuffer of the picture's size.
  void draw(GLuint radianceTexture, float exposureEv, ToneMapper mapper, GLuint framebuffer,
            int width, int height);

  // Compiles the shaders again. If they have errors it throws ShaderError and keeps the old ones.
  void reload(const std::filesystem::path& shaders);

 private:
  GLuint upload(const std::shared_ptr<RadianceImage>& image);
  void resize(int width, int height);

  Program program_;
  VertexArray vertexArray_;
  Framebuffer framebuffer_;
  Texture target_;
  Texture uploaded_;  // copy of a picture in main memory
  std::shared_ptr<RadianceImage> uploadedFrom_;
  int width_ = 0, height_ = 0;
};

}  // namespace lamplighter::gl
