// What the gl backend provides to every method.
#include "renderer/backends/gl/gl_backend.h"
#include "tests/renderer/backends/backend_checks.h"
#include "tests/renderer/gl/gl_test.h"

namespace lamplighter {
namespace {

using GlBackendTest = test::GlTest;

TEST_F(GlBackendTest, ComposesAnyIrradiance) { test::expectComposesAnyIrradiance(makeGlBackend()); }

TEST_F(GlBackendTest, HostGBufferEqualsRayHits) {
  test::expectHostGBufferEqualsRayHits(makeGlBackend());
}

TEST_F(GlBackendTest, ReportsThatTheDeviceIsOutOfMemoryOnce) {
  const auto backend = makeGlBackend();
  EXPECT_NO_THROW(backend->checkDevice());
  GLint layers = 0, size = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &size);
  const auto takeTerabytes = [&] {
    const gl::Texture texture = gl::Texture::make(GL_TEXTURE_2D_ARRAY);
    glTextureStorage3D(texture.name(), 1, GL_RGBA32F, size, size, layers);
  };
  takeTerabytes();
  const bool isRefused = glGetError() == GL_OUT_OF_MEMORY;
  context().debugLog()->clear();
  if (!isRefused) GTEST_SKIP() << "this driver promises more memory than there is";
  takeTerabytes();
  EXPECT_THROW(backend->checkDevice(), DeviceError);
  EXPECT_NO_THROW(backend->checkDevice());
  context().debugLog()->clear();
}

}  // namespace
}  // namespace lamplighter
