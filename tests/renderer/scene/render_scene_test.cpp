#include "renderer/scene/render_scene.h"

#include <gtest/gtest.h>

#include "renderer/scene/surface.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

using test::addMaterial;
using test::addMesh;
using test::addRectangleLight;

float surfaceArea(const RenderScene& s, const RenderObject& o) {
  float area = 0.0f;
  for (uint32_t i = o.firstIndex; i < o.firstIndex + o.indexCount; i += 3) {
    const vec3 &a = s.positions[s.indices[i]], &b = s.positions[s.indices[i + 1]],
               &c = s.positions[s.indices[i + 2]];
    area += 0.5f * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}

TEST(RenderScene, MovingEqualsRebuilding) {
  Scene scene;
  addMaterial(scene, vec3(0.5f));
  const NodeId box = addMesh(scene, test::boxMesh(vec3(1.0f), 0));
  addMesh(scene, test::squareMesh(10.0f, 0), vec3(0, -1, 0));
  const NodeId light = addRectangleLight(scene, vec3(0, 3, 0), vec2(1.0f), vec3(5.0f));
  RenderScene render;
  update(render, scene, SceneChanges::all());

  Scene moved = scene;
  moved.find(box)->local.translation = vec3(1, 2, 3);
  moved.find(box)->local.scale = vec3(1, 2, -1);
  moved.find(light)->area->size = vec2(2.0f, 0.5f);
  moved.find(light)->area->radiance = vec3(7.0f);
  const RenderSceneChanges c = update(render, moved, compare(scene, moved));
  EXPECT_FALSE(c.rebuilt);
  EXPECT_EQ(c.movedObjects, (std::vector<uint32_t>{0, 2}));
  EXPECT_FALSE(c.materials);
  EXPECT_EQ(c.emissions, (std::vector<int>{2}));

  RenderScene fresh;
  update(fresh, moved, SceneChanges::all());
  EXPECT_EQ(render.positions, fresh.positions);
  EXPECT_EQ(render.normals, fresh.normals);
  EXPECT_EQ(render.indices, fresh.indices);
  EXPECT_EQ(render.materials, fresh.materials);
  EXPECT_EQ(render.bounds.min, fresh.bounds.min);
  EXPECT_EQ(render.bounds.max, fresh.bounds.max);
}

TEST(RenderScene, AChangeOfBrightnessIsAChangeOfEmissionOnly) {
  Scene scene;
  const int wall = addMaterial(scene, vec3(0.5f)), lamp = addMaterial(scene, vec3(0.5f));
  scene.materials[static_cast<size_t>(lamp)].emissive = vec3(2.0f);
  addMesh(scene, test::boxMesh(vec3(1.0f), wall));
  addMesh(scene, test::boxMesh(vec3(1.0f), lamp), vec3(0, 2, 0));
  const NodeId light = addRectangleLight(scene, vec3(0, 3, 0), vec2(1.0f), vec3(5.0f));
  RenderScene render;
  update(render, scene, SceneChanges::all());
  const auto changesBy = [&](auto&& edit) {
    Scene after = scene;
    edit(after);
    RenderScene changed = render;
    return update(changed, after, compare(scene, after));
  };
  const auto brighter = changesBy([&](Scene& s) {
    s.materials[static_cast<size_t>(lamp)].emissive = vec3(3.0f);
    s.find(light)->area->radiance = vec3(0.5f);
  });
  EXPECT_FALSE(brighter.surfaces());
  EXPECT_EQ(brighter.emissions, (std::vector<int>{lamp, 3}));
  EXPECT_FALSE(brighter.none());
  const auto off = changesBy([&](Scene& s) { s.find(light)->area->radiance = vec3(0.0f); });
  EXPECT_FALSE(off.surfaces());
  EXPECT_EQ(off.emissions, (std::vector<int>{3}));
  // A mesh that begins to emit, or reflects differently, changes as a surface.
  EXPECT_TRUE(changesBy([&](Scene& s) {
                s.materials[static_cast<size_t>(wall)].emissive = vec3(1.0f);
              }).materials);
  EXPECT_TRUE(changesBy([&](Scene& s) {
                s.materials[static_cast<size_t>(lamp)].emissive = vec3(3.0f);
                s.materials[static_cast<size_t>(lamp)].baseColor = vec4(0.1f);
              }).materials);
}

TEST(RenderScene, MergedChangesKeepTheFirstBounds) {
  RenderSceneChanges changes, later;
  changes.movedObjects = {2};
  changes.movedBounds.emplace_back().add(vec3(1.0f));
  later.movedObjects = {3, 2};
  later.movedBounds.emplace_back().add(vec3(5.0f));
  later.movedBounds.emplace_back().add(vec3(9.0f));
  later.sky = true;
  changes.emissions = {1, 4};
  later.emissions = {2, 4};
  changes.merge(later);
  EXPECT_EQ(changes.emissions, (std::vector<int>{1, 2, 4}));
  EXPECT_EQ(changes.movedObjects, (std::vector<uint32_t>{2, 3}));
  EXPECT_EQ(changes.movedBounds[0].min, vec3(1.0f));
  EXPECT_EQ(changes.movedBounds[1].min, vec3(5.0f));
  EXPECT_TRUE(changes.sky);
  later.rebuilt = true;
  changes.merge(later);
  EXPECT_TRUE(changes.rebuilt);
  EXPECT_TRUE(changes.movedObjects.empty());
  EXPECT_TRUE(changes.movedBounds.empty());
  EXPECT_TRUE(changes.emissions.empty());
}

TEST(RenderScene, AMirroredBoxStillFacesOutwards) {
  Scene scene;
  const NodeId id = addMesh(scene, test::boxMesh(vec3(2.0f)));
  scene.find(id)->local.scale = vec3(-1, 1, 1);
  RenderScene render;
  update(render, scene, SceneChanges::all());
  for (uint32_t t = 0; t < render.objects[0].triangleCount(); ++t) {
    const Surface s = surfaceAt(render, 0, t, 0.3f, 0.3f);
    EXPECT_GT(glm::dot(s.geometricNormal, s.position), 0.0f) << "triangle " << t;
    EXPECT_GT(glm::dot(s.normal, s.geometricNormal), 0.99f) << "triangle " << t;
  }
}

TEST(RenderScene, LightShapesHaveExactlyTheirAreaAndFaceOut) {
  struct Case {
    AreaShape shape;
    vec2 size;
    float area;
  };
  for (const Case& c :
       {Case{AreaShape::rectangle, {2.0f, 3.0f}, 6.0f}, Case{AreaShape::disk, {2.0f, 0.0f}, kPi},
        Case{AreaShape::sphere, {2.0f, 0.0f}, 4.0f * kPi}}) {
    Scene scene;
    const NodeId id = test::addNode(scene, "light");
    scene.find(id)->area = AreaLight{c.shape, vec3(1.0f), c.size};
    RenderScene render;
    update(render, scene, SceneChanges::all());
    ASSERT_EQ(render.objects.size(), 1u);
    EXPECT_NEAR(surfaceArea(render, render.objects[0]), c.area, 1e-5f * c.area);
    for (uint32_t t = 0; t < render.objects[0].triangleCount(); ++t) {
      const Surface s = surfaceAt(render, 0, t, 0.3f, 0.3f);
      const vec3 out = c.shape == AreaShape::sphere ? s.position : vec3(0, 0, -1);
      EXPECT_GT(glm::dot(s.geometricNormal, glm::normalize(out)), 0.9f);
      EXPECT_EQ(s.emission, vec3(1.0f));
      EXPECT_EQ(s.albedo, vec3(0.0f));
    }
  }
}

TEST(RenderScene, AHiddenParentHidesItsChildren) {
  Scene scene;
  const NodeId parent = test::addNode(scene, "parent");
  const NodeId child = addMesh(scene, test::squareMesh(1.0f));
  scene.find(child)->parent = parent;
  scene.find(parent)->visible = false;
  RenderScene render;
  update(render, scene, SceneChanges::all());
  EXPECT_EQ(render.triangleCount(), 0u);
  EXPECT_TRUE(render.positions.empty());
}

TEST(Surface, TexturesUseTheirWrapMode) {
  auto image = std::make_shared<Image8>(2, 1);
  const uint8_t texels[] = {0, 0, 0, 255, 255, 255, 255, 255};
  image->pixels.assign(texels, texels + 8);
  Texture t;
  t.image = image;
  t.nearest = true;
  const auto red = [&](float u) { return sampleTexture(t, vec2(u, 0.5f), false).r; };
  EXPECT_EQ(red(0.25f), 0.0f);
  EXPECT_EQ(red(1.25f), 0.0f);
  EXPECT_EQ(red(-0.25f), 1.0f);
  t.wrapS = Wrap::clamp;
  EXPECT_EQ(red(1.25f), 1.0f);
  EXPECT_EQ(red(-0.25f), 0.0f);
  t.wrapS = Wrap::mirror;
  EXPECT_EQ(red(1.25f), 1.0f);
  EXPECT_EQ(red(1.75f), 0.0f);
  t.nearest = false;
  EXPECT_NEAR(red(0.5f), 0.5f, 1e-6f);
}

}  // namespace
}  // namespace lamplighter
