#include "tests/support/method_room.h"

#include <utility>

#include <gtest/gtest.h>

namespace lamplighter::test {

MethodRoom::MethodRoom(std::string name, std::string counted)
    : method(std::move(name)), statistic(std::move(counted)), renderer(makeCpuBackend()) {
  const int white = addMaterial(scene, vec3(0.7f));
  const int red = addMaterial(scene, vec3(0.8f, 0.2f, 0.1f));
  addMesh(scene, roomMesh(vec3(4.0f, 3.0f, 4.0f), white));
  box = addMesh(scene, boxMesh(vec3(0.8f), red), vec3(0.0f, -1.1f, 0.0f));
  lamp = addRectangleLight(scene, vec3(-0.6f, 1.3f, 0.0f), vec2(0.8f), vec3(5.0f));
  settings.set("bounces", 2);
}

GiOutput MethodRoom::frame(const SceneChanges& changes) {
  return renderer.render({scene, changes, view, method, settings});
}

Image MethodRoom::settledBy(FrameRenderer& by, SceneChanges changes, const std::string& with) {
  GiOutput out;
  count = 0.0;
  for (int i = 0; i < 3000 && !out.settled; ++i) {
    out = by.render({scene, changes, view, with, settings});
    changes = {};
    if (!statistic.empty()) count += out.stats.of(statistic);
  }
  EXPECT_TRUE(out.settled);
  return out.radiance->pixels();
}

Image MethodRoom::fresh(const std::string& with) {
  FrameRenderer own(makeCpuBackend());
  return settledBy(own, SceneChanges::all(), with);
}

SceneChanges MethodRoom::edit(const std::function<void(Scene&)>& change) {
  const Scene old = scene;
  change(scene);
  return compare(old, scene);
}

}  // namespace lamplighter::test
