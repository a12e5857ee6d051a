#include "renderer/backends/gl/gl_composition.h"

#include "renderer/gl/pass_state.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/sky.h"

namespace lamplighter::gl {

GlComposition::GlComposition(const std::filesystem::path& shaders,
                             std::shared_ptr<PicturePasses> passes)
    : passes_(std::move(passes)),
      emptyVertexArray_(VertexArray::make()),
      pictureFramebuffer_(Framebuffer::make()) {
  reload(shaders);
}

void GlComposition::reload(const std::filesystem::path& shaders) {
  Program compose[3];
  for (int i = 0; i < 3; ++i) {
    compose[i] = Program(shaders, {"common/full_screen.vert.glsl",
                                   "passes/compose.frag.glsl",
                                   {"SKY_KIND " + std::to_string(i)}});
  }
  std::move(std::begin(compose), std::end(compose), compose_);
}

void GlComposition::resize(int width, int height) {
  if (width_ == width && height_ == height) return;
  width_ = width;
  height_ = height;
  pictures_.clear();
  irradiance_ = {};
  gainsTexture_ = {};
  gains_.reset();
}

std::shared_ptr<RadianceTexture> GlComposition::freePicture() {
  for (const auto& picture : pictures_) {
    if (picture.use_count() == 1) {
      picture->forgetPixels();
      return picture;
    }
  }
  return pictures_.emplace_back(std::make_shared<RadianceTexture>(width_, height_, passes_));
}

// Sets the uniforms of compose.frag.glsl that describe the sky.
const Program& GlComposition::setSky(const GlGBuffer& gbuffer, const Sky& sky) {
  if (skyImage_ != sky.image) {
    skyImage_ = sky.image;
    skyTexture_ = Texture();
    if (skyImage_) {
      const Image& image = skyImage_->pixels;
      skyTexture_ = makeTexture2D(GL_RGB32F, image.width, image.height);
      glTextureSubImage2D(skyTexture_.name(), 0, 0, 0, image.width, image.height, GL_RGB, GL_FLOAT,
                          image.pixels.data());
    }
  }
  if (skyTexture_) glBindTextureUnit(shared::kSkyPicture, skyTexture_.name());
  const bool isConstant = sky.kind == SkyKind::constant;
  const int kind = isConstant                      ? shared::kSkyConstant
                   : sky.kind == SkyKind::gradient ? shared::kSkyGradient
                                                   : shared::kSkyImage;
  const Program& compose = compose_[kind];
  compose.set(0, isConstant ? sky.radiance : sky.horizon);
  compose.set(2, sky.zenith);
  compose.set(3, sky.ground);
  compose.set(5, vec2(sky.rotation, sky.scale));
  // View::rayDirection() of a pixel: forward + right · x + up · y, in pixels from the top left
  // corner.
  const View& view = gbuffer.view();
  const vec3 corner = view.rayPlane(0.0f, 0.0f);
  compose.set(6, corner);
  compose.set(7, view.rayPlane(1.0f, 0.0f) - corner);
  compose.set(8, view.rayPlane(0.0f, 1.0f) - corner);
  compose.set(9, gbuffer.jitter());
  return compose;
}

std::shared_ptr<RadianceTexture> GlComposition::compose(const GlGBuffer& gbuffer, const Sky& sky,
                                                        GLuint irradiance, bool white,
                                                        bool withEmission) {
  resize(gbuffer.width(), gbuffer.height());
  auto picture = freePicture();
  glNamedFramebufferTexture(pictureFramebuffer_.name(), GL_COLOR_ATTACHMENT0, picture->texture(),
                            0);
  const PassState state(pictureFramebuffer_.name(), width_, height_);
  gbuffer.bind();
  glBindTextureUnit(shared::kIrradiance, irradiance);
  const Program& compose = setSky(gbuffer, sky);
  compose.set(1, white ? 1 : 0);
  compose.set(4, withEmission ? 1 : 0);
  compose.use();
  drawFullScreen(emptyVertexArray_.name());
  return picture;
}

std::shared_ptr<RadianceTexture> GlComposition::compose(const GlGBuffer& gbuffer, const Sky& sky,
                                                        const Image& irradiance, bool white) {
  resize(gbuffer.width(), gbuffer.height());
  if (!irradiance_) irradiance_ = makeTexture2D(GL_RGB32F, width_, height_);
  glTextureSubImage2D(irradiance_.name(), 0, 0, 0, width_, height_, GL_RGB, GL_FLOAT,
                      irradiance.pixels.data());
  return compose(gbuffer, sky, irradiance_.name(), white);
}

std::shared_ptr<RadianceTexture> GlComposition::multiplied(
    const RadianceTexture& picture, const std::shared_ptr<const Image>& gains) {
  resize(picture.width(), picture.height());
  if (gains_ != gains) {
    if (!gainsTexture_) gainsTexture_ = makeTexture2D(GL_RGB32F, width_, height_);
    glTextureSubImage2D(gainsTexture_.name(), 0, 0, 0, width_, height_, GL_RGB, GL_FLOAT,
                        gains->pixels.data());
    gains_ = gains;
  }
  auto result = freePicture();
  passes_->multiply(picture.texture(), gainsTexture_.name(), result->texture(), {width_, height_});
  return result;
}

std::shared_ptr<RadianceTexture> GlComposition::difference(const RadianceTexture& picture,
                                                           const RadianceTexture& taken) {
  resize(picture.width(), picture.height());
  auto result = freePicture();
  passes_->subtract(picture.texture(), taken.texture(), result->texture(), {width_, height_});
  return result;
}

uint64_t GlComposition::bytes() const {
  const uint64_t pixels = static_cast<uint64_t>(width_) * static_cast<uint64_t>(height_);
  uint64_t bytes =
      (pictures_.size() * uint64_t{16} + (irradiance_ ? 12 : 0) + (gainsTexture_ ? 12 : 0)) *
      pixels;
  if (skyTexture_) bytes += skyImage_->pixels.pixels.size() * sizeof(vec3);
  return bytes;
}

}  // namespace lamplighter::gl
