// The view "light only" is the same on both backends.
#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/image/metrics.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

class LightOnly : public test::GlTest {};

TEST_F(LightOnly, IsTheSameOnBothBackends) {
  Scene scene;
  const int red = test::addMaterial(scene, vec3(0.8f, 0.1f, 0.05f));
  test::addMesh(scene, test::squareMesh(6.0f, red));
  test::addRectangleLight(scene, vec3(0, 2, 0), vec2(1.0f), vec3(5.0f));
  const View view = test::lookAt(vec3(0, 3, 4), vec3(0), 64, 48);
  Settings settings;
  settings.set("vpls", 16);
  settings.set("bounces", 0);
  settings.set("antialias", 1);
  Image pictures[2][2];
  for (const int backend : {0, 1}) {
    FrameRenderer renderer(backend == 0 ? makeGlBackend() : makeCpuBackend());
    test::renderSettled(renderer, scene, SceneChanges::all(), view, settings);
    // Switch to light only and back: the switch alone must cause a new picture.
    for (const int lightOnly : {1, 0})
      pictures[backend][lightOnly] =
          renderer.render({scene, {}, view, "many_lights", settings, lightOnly == 1})
              .radiance->pixels();
  }
  for (const int lightOnly : {0, 1})
    EXPECT_LT(compareImages(pictures[0][lightOnly], pictures[1][lightOnly]).relRmse, 0.01);
  const vec3 lit = pictures[0][0].at(32, 40), white = pictures[0][1].at(32, 40);
  EXPECT_NEAR(lit.r / white.r, 0.8f, 0.002f);
  EXPECT_NEAR(lit.g / white.g, 0.1f, 0.002f);
}

// Direct and indirect light: both backends give the same pictures.
TEST_F(LightOnly, PartsAreTheSameOnBothBackends) {
  Scene scene;
  const int red = test::addMaterial(scene, vec3(0.8f, 0.3f, 0.2f));
  test::addMesh(scene, test::roomMesh(vec3(4, 3, 4), red), vec3(0, 1.5f, 0));
  test::addMesh(scene, test::boxMesh(vec3(0.8f), red), vec3(0.3f, 0.4f, 0));
  test::addRectangleLight(scene, vec3(0, 2.5f, 0), vec2(1.0f), vec3(5.0f));
  const View view = test::lookAt(vec3(0, 1.5f, 1.8f), vec3(0, 1, 0), 64, 48, 1.0f);
  for (const char* technique : {"naive", "light_maps"}) {
    SCOPED_TRACE(technique);
    Settings settings;
    settings.set("technique", std::string(technique));
    settings.set("indirect", std::string("samples"));
    settings.set("vpls", 40);
    settings.set("antialias", 1);
    settings.set("bias_compensation", false);
    Image pictures[2][3];
    for (const int backend : {0, 1}) {
      FrameRenderer renderer(backend == 0 ? makeGlBackend() : makeCpuBackend());
      test::renderSettled(renderer, scene, SceneChanges::all(), view, settings);
      for (const LightPart part : {LightPart::all, LightPart::direct, LightPart::indirect})
        pictures[backend][static_cast<int>(part)] =
            renderer.render({scene, {}, view, "many_lights", settings, false, {}, part})
                .radiance->pixels();
    }
    for (const int part : {0, 1, 2})
      EXPECT_LT(compareImages(pictures[0][part], pictures[1][part]).relRmse, 0.03) << part;
    Image sum = pictures[0][1];
    for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += pictures[0][2].pixels[i];
    EXPECT_LT(compareImages(sum, pictures[0][0]).relRmse, 0.02);
    EXPECT_GT(luminance(test::meanOf(pictures[0][2])), 0.05f * luminance(test::meanOf(sum)));
  }
}

}  // namespace
}  // namespace lamplighter
