// Pixels as points of the surface mesh: which of them an edit replaces.
#include "renderer/surface_light/pixels/surface_picture.h"

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// A slab slides along its own top: pixels there keep position, triangle and normal, but show other
// points of the slab.
TEST(SurfacePicture, ReplacesPixelsOfAnObjectThatSlides) {
  Scene scene;
  const int wall = test::addMaterial(scene, vec3(0.6f, 0.5f, 0.4f));
  test::addMesh(scene, test::roomMesh(vec3(4, 3, 5), wall));
  const NodeId slab =
      test::addMesh(scene, test::boxMesh(vec3(2.5f, 0.2f, 2.0f), wall), vec3(-0.3f, -1.2f, 0));
  test::addRectangleLight(scene, vec3(1.2f, 0.4f, 0), vec2(0.8f, 0.5f), vec3(9, 8, 7));
  RenderScene render = test::renderSceneOf(scene);
  RayCaster rays(render);
  SurfaceLight light;
  const SurfaceLightOptions options{3, 0.4f, 64};
  light.update(render, test::everythingRebuilt(), rays, options, SurfaceLight::kAllRays);
  const auto backend = makeCpuBackend();
  backend->setScene(render, test::everythingRebuilt(), rays);
  const View view = test::lookAt(vec3(0, 0.5f, 2.2f), vec3(0, -1.0f, -1.0f), 60, 45, 0.9f);
  const Rows all{0, view.height};
  const ViewRecords records;
  const auto gathered = [&] { return GatherScene{render, rays, light.mesh(), light.cuts()}; };
  const auto drawn = [&](const SurfacePicture& picture) {
    Image out(view.width, view.height);
    picture.addTo(light.values(), records.values(), out);
    return out;
  };

  backend->renderGBuffer(view, vec2(0.0f));
  SurfacePicture kept, fresh;
  kept.restart(view.width, view.height, 1);
  kept.add(gathered(), light, records, backend->hostGBuffer(), view.eye, {}, all);
  const Image first = drawn(kept);

  const Scene before = scene;
  scene.find(slab)->local.translation.x += 0.25f;
  const RenderSceneChanges changes = update(render, scene, compare(before, scene));
  rays.update(changes);
  light.update(render, changes, rays, options, SurfaceLight::kAllRays);
  ASSERT_FALSE(light.hasOtherElements());
  backend->setScene(render, changes, rays);
  backend->renderGBuffer(view, vec2(0.0f));
  kept.replaceChanged(gathered(), light, records, backend->hostGBuffer(), view.eye, {});
  fresh.restart(view.width, view.height, 1);
  fresh.add(gathered(), light, records, backend->hostGBuffer(), view.eye, {}, all);
  EXPECT_FALSE(test::sameBits(drawn(kept), first));
  EXPECT_TRUE(test::sameBits(drawn(kept), drawn(fresh)));
}

}  // namespace
}  // namespace lamplighter
