// From a frame's radiance to the texture that the viewport shows.
#pragma once

#include <filesystem>

#include "renderer/backends/kernels.h"
#include "renderer/gl/program.h"
#include "renderer/gl/shader_source.h"
#include "renderer/image/tone_map.h"

namespace lamplighter::gl {

class DisplayPass {
 public:
  explicit DisplayPass(const std::filesystem::path& shaders = defaultShaderFolder());

  // Tone-maps the picture with exposure in EV and returns a texture of its size (RGBA8,
  // sRGB-encoded, opaque; row 0 is the top), which stays this pass's own and is drawn over by the
  // next call. A picture in main memory is uploaded first, unless it is the one of the last call.
  GLuint render(const std::shared_ptr<RadianceImage>& image, float exposureEv,
                ToneMapper mapper = ToneMapper::filmic);

  // The same into a framebuffer of the picture's size.
  void draw(GLuint radianceTexture, float exposureEv, ToneMapper mapper, GLuint framebuffer,
            int width, int height);

  // Compiles the shaders anew; throws ShaderError and keeps the old ones when they are broken.
  void reload(const std::filesystem::path& shaders);

 private:
  GLuint upload(const std::shared_ptr<RadianceImage>& image);
  void resize(int width, int height);

  Program program_;
  VertexArray vertexArray_;
  Framebuffer framebuffer_;
  Texture target_;
  Texture uploaded_;  // a host picture's
  std::shared_ptr<RadianceImage> uploadedFrom_;
  int width_ = 0, height_ = 0;
};

}  // namespace lamplighter::gl
