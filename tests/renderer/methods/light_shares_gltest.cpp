// A settled picture follows changes of brightness in the next frame on the gl backend, too.
#include <gtest/gtest.h>

#include "renderer/backends/gl/gl_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/metrics.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/random_boxes.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

using LightSharesGl = test::GlTest;

TEST_F(LightSharesGl, AChangeOfBrightnessIsExactInTheNextFrame) {
  Scene scene = test::randomBoxes(14, 4);
  const NodeId lamp =
      test::addRectangleLight(scene, vec3(0.3f, 3.9f, -0.2f), vec2(1.5f, 0.7f), vec3(6, 5, 3));
  const NodeId other =
      test::addRectangleLight(scene, vec3(-2, 3.5f, 1), vec2(0.5f, 0.5f), vec3(5, 6, 9));
  scene.sky = Sky(vec3(0.3f, 0.4f, 0.6f));
  const View view = test::lookAt(vec3(0.5f, 2.2f, 7.5f), vec3(0.0f, 1.4f, 0.0f), 96, 64);
  Settings settings;
  settings.set("vpls", 60);
  settings.set("antialias", 2);
  settings.set("map_resolution", 16);
  settings.set("settled_map_scale", 2);
  FrameRenderer renderer(makeGlBackend());
  test::renderSettled(renderer, scene, SceneChanges::all(), view, settings);
  const Scene before = scene;
  scene.find(lamp)->area->radiance *= vec3(1.1f, 0.9f, 1.0f);
  scene.find(other)->light.on = false;
  const uint64_t maps = test::lightCounts(renderer.backend()).shadowMaps;
  const uint64_t sums = test::lightCounts(renderer.backend()).lightPixels;
  const GiOutput out =
      renderer.render({scene, compare(before, scene), view, "many_lights", settings});
  EXPECT_TRUE(out.settled);
  EXPECT_EQ(test::lightCounts(renderer.backend()).shadowMaps, maps);
  EXPECT_EQ(test::lightCounts(renderer.backend()).lightPixels, sums);
  const Image fresh = test::freshPicture(makeGlBackend(), scene, view, settings);
  EXPECT_LT(compareImages(out.radiance->pixels(), fresh).relRmse, 1e-5);
}

}  // namespace
}  // namespace lamplighter
