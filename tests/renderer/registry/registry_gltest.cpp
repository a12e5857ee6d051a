// A method of a library that uses OpenGL: it is added to the registry and draws with OpenGL.
#include <epoxy/gl.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/base/error.h"
#include "renderer/frame/frame.h"
#include "renderer/registry/registry.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/render.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// Fills the picture with one colour by OpenGL.
class Clear final : public GiMethod {
 public:
  GiOutput render(const FrameInputs& in) override {
    GLuint texture = 0, framebuffer = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_RGBA32F, in.view.width, in.view.height);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
    const float colour[] = {0.25f, 0.5f, 1.0f, 1.0f};
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, colour);
    Image image(in.view.width, in.view.height);
    glGetTextureImage(texture, 0, GL_RGB, GL_FLOAT,
                      static_cast<GLsizei>(image.pixels.size() * sizeof(vec3)),
                      image.pixels.data());
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &texture);
    GiOutput out;
    out.radiance = std::make_shared<HostImage>(std::move(image));
    out.settled = true;
    return out;
  }
  void reset() override {}
};

class RegistryGl : public test::GlTest {};

TEST_F(RegistryGl, AMethodOfTheGlLibraryRunsOnItsBackendOnly) {
  MethodInfo info;
  info.name = "clear";
  info.label = "Clear";
  info.make = [](Backend&) { return std::make_unique<Clear>(); };
  info.needs.openGl = true;
  addMethod(info);
  Scene scene;
  test::addMesh(scene, test::squareMesh(1.0f));
  const View view = test::lookAt(vec3(0, 2, 4), vec3(0), 8, 6);
  const Settings settings;
  FrameRenderer onGl(makeGlBackend()), onCpu(makeCpuBackend());
  const GiOutput out = onGl.render({scene, SceneChanges::all(), view, "clear", settings});
  EXPECT_EQ(out.radiance->pixels().at(3, 3), vec3(0.25f, 0.5f, 1.0f));
  EXPECT_THROW(onCpu.render({scene, SceneChanges::all(), view, "clear", settings}), InputError);
}

}  // namespace
}  // namespace lamplighter
