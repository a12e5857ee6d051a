// Ambient occlusion on the gl backend equals that of the cpu backend.
#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/metrics.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/render.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

class AmbientOcclusionGl : public test::GlTest {};

TEST_F(AmbientOcclusionGl, IsTheSameOnBothBackends) {
  Scene scene;
  const int red = test::addMaterial(scene, vec3(0.8f, 0.3f, 0.2f));
  test::addMesh(scene, test::roomMesh(vec3(4, 3, 4), red), vec3(0, 1.5f, 0));
  test::addMesh(scene, test::boxMesh(vec3(0.8f), red), vec3(0.3f, 0.4f, 0));
  const View view = test::lookAt(vec3(0, 1.5f, 1.8f), vec3(0, 1, 0), 64, 48, 1.0f);
  Settings settings;
  settings.set("samples_per_pixel", 16);
  settings.set("samples_per_frame", 8);
  for (const bool lightOnly : {false, true}) {
    Image pictures[2];
    for (const int backend : {0, 1}) {
      FrameRenderer renderer(backend == 0 ? makeGlBackend() : makeCpuBackend());
      SceneChanges changes = SceneChanges::all();
      GiOutput out;
      do {
        out = renderer.render({scene, changes, view, "ambient_occlusion", settings, lightOnly});
        changes = {};
      } while (!out.settled);
      pictures[backend] = out.radiance->pixels();
    }
    EXPECT_LT(compareImages(pictures[0], pictures[1]).relRmse, 0.005);
    EXPECT_GT(test::meanOf(pictures[0]).r, 0.2f);
  }
}

}  // namespace
}  // namespace lamplighter
