// The method multi_mesh.
#include <gtest/gtest.h>

#include "renderer/image/metrics.h"
#include "renderer/methods/path_tracer/path_tracer.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

Scene boxInRoom() {
  Scene scene;
  const int white = test::addMaterial(scene, vec3(0.75f));
  const int red = test::addMaterial(scene, vec3(0.7f, 0.2f, 0.1f));
  test::addMesh(scene, test::roomMesh(vec3(4.0f, 3.0f, 4.0f), white));
  test::addMesh(scene, test::boxMesh(vec3(1.0f), red), vec3(0.4f, -1.0f, 0.0f));
  test::addMesh(scene, test::sphereMesh(0.4f, 24, 0.0f, white), vec3(-0.9f, -1.1f, 0.2f));
  test::addRectangleLight(scene, vec3(0.0f, 1.45f, 0.0f), vec2(1.0f), vec3(6.0f));
  return scene;
}

GiOutput settled(const std::string& method, const Scene& scene, const View& view,
                 const Settings& settings) {
  FrameRenderer renderer(makeCpuBackend());
  SceneChanges changes = SceneChanges::all();
  GiOutput out;
  for (int frame = 0; frame < 300 && !out.settled; ++frame) {
    out = renderer.render({scene, changes, view, method, settings});
    changes = {};
  }
  EXPECT_TRUE(out.settled);
  return out;
}

TEST(MultiMesh, IsNearTheReference) {
  const Scene scene = boxInRoom();
  const View view = test::lookAt(vec3(1.2f, 0.6f, 1.9f), vec3(-0.1f, -0.7f, 0.0f), 48, 36);
  Settings settings;
  settings.set("bounces", 3);
  settings.set("updates", 300);
  const Image picture = settled("multi_mesh", scene, view, settings).radiance->pixels();
  const Image reference = test::renderReference(scene, view, 512, 3);
  const Metrics m = compareImages(picture, reference);
  RecordProperty("relRmse", std::to_string(m.relRmse));
  EXPECT_LT(m.relRmse, 0.05);
  EXPECT_LT(std::abs(m.bias - 1.0), 0.01);
}

TEST(MultiMesh, WithLightSamplesIsManyLights) {
  const Scene scene = boxInRoom();
  const View view = test::lookAt(vec3(1.2f, 0.6f, 1.9f), vec3(-0.1f, -0.7f, 0.0f), 48, 36);
  Settings settings;
  settings.set("vpls", 40);
  settings.set("direct", std::string("samples"));
  settings.set("bounces", 2);
  const GiOutput own = settled("multi_mesh", scene, view, settings);
  settings.set("indirect", std::string("meshes"));
  const GiOutput same = settled("many_lights", scene, view, settings);
  EXPECT_TRUE(test::sameBits(own.radiance->pixels(), same.radiance->pixels()));
  EXPECT_GT(own.stats.of("elements"), 100.0);
  EXPECT_EQ(own.stats.of("light_samples"), 40.0);
}

}  // namespace
}  // namespace lamplighter
