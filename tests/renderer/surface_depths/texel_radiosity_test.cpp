#include "renderer/surface_depths/texel_radiosity.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace lamplighter {
namespace {

// While an object moves, pixels find their texels in its space.
TEST(TexelRadiosity, TexelsGoWithAnObjectThatMoves) {
  Scene scene;
  test::addMesh(scene, test::roomMesh(vec3(4.0f), test::addMaterial(scene, vec3(0.7f))));
  const NodeId box = test::addMesh(scene, test::boxMesh(vec3(1.0f), 0));
  RenderScene render = test::renderSceneOf(scene);
  RayCaster rays(render);
  Services services;
  TexelRadiosity light;
  TexelRadiosityOptions options;
  options.visibility = TexelVisibility::rays;
  const auto update = [&](const RenderSceneChanges& changes) {
    services.beginFrame(render, changes, rays, {}, changes.rebuilt);
    light.outdate(changes);
    light.update(render, services, options, 100'000);
  };
  update(test::everythingRebuilt());
  while (!light.isDone()) update({});
  const vec3 corner = render.positions[render.objects[1].firstVertex];
  const vec3 own = light.atlases()[1].toOwn(corner);

  const Scene old = scene;
  const vec3 way(0.5f, 0.2f, -0.3f);
  scene.find(box)->local.translation += way;
  const RenderSceneChanges moved = lamplighter::update(render, scene, compare(old, scene));
  rays.update(moved);
  update(moved);
  EXPECT_FALSE(light.isDone());
  EXPECT_LT(glm::distance(light.atlases()[1].toOwn(corner + way), own), 1e-5f);
}

}  // namespace
}  // namespace lamplighter
