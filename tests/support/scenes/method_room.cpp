#include "tests/support/scenes/method_room.h"

#include <utility>

#include <gtest/gtest.h>

#include "renderer/image/average_blocks.h"

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

Metrics MethodRoom::freshAgainstReference() {
  const Image reference = averageBlocks(renderReference(scene, view, 1024, 2), 4);
  const Metrics m = compareImages(averageBlocks(fresh(), 4), reference);
  ::testing::Test::RecordProperty("relRmse", std::to_string(m.relRmse));
  ::testing::Test::RecordProperty("bias", std::to_string(m.bias));
  return m;
}

Image MethodRoom::freshPart(LightPart part, bool lightOnly) {
  FrameRenderer own(makeCpuBackend());
  SceneChanges changes = SceneChanges::all();
  GiOutput out;
  for (int i = 0; i < 3000 && !out.settled; ++i) {
    out = own.render({.scene = scene,
                      .changes = changes,
                      .view = view,
                      .method = method,
                      .settings = settings,
                      .lightOnly = lightOnly,
                      .part = part});
    changes = {};
  }
  EXPECT_TRUE(out.settled);
  return out.radiance->pixels();
}

void MethodRoom::expectEditsLeaveFreshBits() {
  const Image before = picture(SceneChanges::all());
  const auto expectFresh = [&](const Image& now) { EXPECT_TRUE(sameBits(now, fresh())); };
  expectFresh(edited([&](Scene& s) { s.find(lamp)->area->radiance *= vec3(0.5f, 0.7f, 0.1f); }));
  edited([&](Scene& s) { s.find(lamp)->area->radiance = vec3(5.0f); });
  expectFresh(edited([&](Scene& s) { s.find(lamp)->local.translation.x += 0.5f; }));
  edited([&](Scene& s) { s.find(lamp)->local.translation.x -= 0.5f; });
  expectFresh(edited([&](Scene& s) { s.find(box)->local.translation.z += 0.5f; }));
  expectFresh(edited([&](Scene& s) { s.find(box)->visible = false; }));
  edited([&](Scene& s) { s.find(box)->visible = true; });
  const Image back = edited([&](Scene& s) { s.find(box)->local.translation.z -= 0.5f; });
  expectFresh(back);
  EXPECT_TRUE(sameBits(back, before));
}

void MethodRoom::expectMaterialEditsLeaveFreshBits() {
  picture(SceneChanges::all());
  const auto expectFresh = [&](const Image& now) { EXPECT_TRUE(sameBits(now, fresh())); };
  const Image coloured = edited([](Scene& s) { s.materials[1].baseColor.g = 0.7f; });
  EXPECT_EQ(count, 0.0);  // other colours need no visibility
  expectFresh(coloured);
  expectFresh(edited([](Scene& s) { s.materials[1].doubleSided = true; }));
  expectFresh(edited([](Scene& s) { s.materials[1].transmission = 1.0f; }));
}

}  // namespace lamplighter::test
