// The display pass gives the same colours as the tone mapping of saved pictures.
#include <limits>

#include "renderer/gl/display_pass.h"
#include "renderer/gl/radiance_texture.h"
#include "renderer/image/tone_map.h"
#include "tests/renderer/gl/gl_test.h"

namespace lamplighter {
namespace {

using Display = test::GlTest;

// From dark to far above white, with a different ramp per channel and an odd width.
Image ramp() {
  Image image(61, 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float v = std::exp2(static_cast<float>(x - 40) / 4.0f);
      image.at(x, y) = vec3(v, 0.5f * v, y == 1 ? 0.0f : 2.0f * v);
    }
  }
  image.at(0, 2) =
      vec3(std::numeric_limits<float>::infinity(), -1.0f, std::numeric_limits<float>::quiet_NaN());
  return image;
}

std::vector<uint8_t> read(GLuint texture, const Image& size) {
  std::vector<uint8_t> bytes(4 * size.pixels.size());
  glGetTextureImage(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(bytes.size()),
                    bytes.data());
  return bytes;
}

void expectNear(const std::vector<uint8_t>& shown, const Image8& written) {
  ASSERT_EQ(shown.size(), written.pixels.size());
  for (size_t i = 0; i < shown.size(); ++i) {
    ASSERT_NEAR(int{shown[i]}, int{written.pixels[i]}, 1) << "pixel " << i / 4;
  }
}

TEST_F(Display, ShowsAHostPictureAsItWouldBeSaved) {
  gl::DisplayPass pass;
  const auto image = std::make_shared<HostImage>(ramp());
  for (const float ev : {0.0f, -3.0f, 2.5f}) {
    expectNear(read(pass.render(image, ev), image->pixels()), toneMap(image->pixels(), ev));
  }
  for (const ToneMapperInfo& m : toneMappers()) {
    SCOPED_TRACE(m.name);
    expectNear(read(pass.render(image, 1.0f, m.mapper), image->pixels()),
               toneMap(image->pixels(), 1.0f, m.mapper));
  }
  // A second picture with another size.
  const auto other = std::make_shared<HostImage>(Image(7, 5, vec3(0.18f)));
  expectNear(read(pass.render(other, 0), other->pixels()), toneMap(other->pixels(), 0));
}

TEST_F(Display, ShowsARadianceTextureTheRightWayUp) {
  const Image image = ramp();
  const auto texture = std::make_shared<gl::RadianceTexture>(
      image.width, image.height, std::make_shared<gl::PicturePasses>(gl::defaultShaderFolder()));
  glTextureSubImage2D(texture->texture(), 0, 0, 0, image.width, image.height, GL_RGB, GL_FLOAT,
                      image.pixels.data());
  gl::DisplayPass pass;
  expectNear(read(pass.render(texture, 1.0f), image), toneMap(image, 1.0f));
  EXPECT_EQ(textureOf(*texture), texture->texture());
  EXPECT_EQ(texture->pixels().at(5, 1), image.at(5, 1));
  EXPECT_EQ(textureOf(HostImage(image)), 0u);
}

TEST_F(Display, KeepsItsShaderWhenTheNewOneIsBroken) {
  gl::DisplayPass pass;
  EXPECT_THROW(pass.reload("/nowhere"), gl::ShaderError);
  const auto image = std::make_shared<HostImage>(ramp());
  expectNear(read(pass.render(image, 0), image->pixels()), toneMap(image->pixels(), 0));
}

}  // namespace
}  // namespace lamplighter
