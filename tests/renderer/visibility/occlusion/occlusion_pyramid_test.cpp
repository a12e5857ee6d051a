// Single occlusion pyramids with obvious results.
#include "renderer/visibility/occlusion/occlusion_pyramid.h"

#include <gtest/gtest.h>

#include "renderer/visibility/occlusion/occluders.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// A floor of side 2 below a light at a height of two metres, with an occluding screen between.
struct Setting {
  Scene scene;
  RenderScene world;
  std::vector<ObjectPatches> patches;
  Occluders occluders;

  explicit Setting(float screenSize, const vec3& at, bool masked = false) {
    const int grey = test::addMaterial(scene, vec3(0.5f));
    const int screen = test::addMaterial(scene, vec3(0.5f));
    if (masked) scene.materials[screen].alphaMode = AlphaMode::mask;
    test::addMesh(scene, test::squareMesh(2.0f, grey));
    if (screenSize > 0.0f) test::addMesh(scene, test::squareMesh(screenSize, screen), at);
    look();
  }
  explicit Setting(Scene s) : scene(std::move(s)) { look(); }

  void look() {
    update(world, scene, SceneChanges::all());
    occluders.resize(world.objects.size());
    for (uint32_t i = 0; i < world.objects.size(); ++i) {
      const MeshTopology topology = findTopology(world, i);
      patches.push_back(placePatches(world, i, topology));
      occluders.place(world, i, topology, patches[i]);
    }
    occluders.finish(world);
  }
  Occlusion of(const shared::Vpl& vpl) const {
    const PatchRegion whole(world, 0, patches[0], patches[0].patches[0]);
    Blocker met;
    return occluders.occlusionWithout(world, OcclusionPyramid(vpl, whole), {}, met);
  }
};

const shared::Vpl kAbove = test::makeVpl(vec3(0, 2, 0), vec3(0, -1, 0));

TEST(OcclusionPyramid, NothingBetweenIsNone) {
  EXPECT_EQ(Setting(0.0f, vec3(0)).of(kAbove), Occlusion::none);
  EXPECT_EQ(Setting(1.0f, vec3(3, 1, 0)).of(kAbove), Occlusion::none);      // beside
  EXPECT_EQ(Setting(4.0f, vec3(0, 2.5f, 0)).of(kAbove), Occlusion::none);   // behind the light
  EXPECT_EQ(Setting(4.0f, vec3(0, -0.5f, 0)).of(kAbove), Occlusion::none);  // below the floor
}

// At half height the pyramid is one metre wide.
TEST(OcclusionPyramid, AScreenHidesAllOrSome) {
  EXPECT_EQ(Setting(1.01f, vec3(0, 1, 0)).of(kAbove), Occlusion::full);
  EXPECT_EQ(Setting(0.99f, vec3(0, 1, 0)).of(kAbove), Occlusion::partial);
  EXPECT_EQ(Setting(0.2f, vec3(0, 1, 0)).of(kAbove), Occlusion::partial);
  EXPECT_EQ(Setting(1.01f, vec3(0.1f, 1, 0)).of(kAbove), Occlusion::partial);
}

TEST(OcclusionPyramid, OccludersWithAlphaMasksNeverHideCompletely) {
  EXPECT_EQ(Setting(1.5f, vec3(0, 1, 0), true).of(kAbove), Occlusion::partial);
}

TEST(OcclusionPyramid, ParallelLightHasAPrism) {
  const shared::Vpl sun = test::makeVpl(vec3(0), vec3(0, 1, 0), shared::kVplDirectional);
  EXPECT_EQ(Setting(0.0f, vec3(0)).of(sun), Occlusion::none);
  EXPECT_EQ(Setting(1.9f, vec3(0, 5, 0)).of(sun), Occlusion::partial);
  EXPECT_EQ(Setting(2.1f, vec3(0, 50, 0)).of(sun), Occlusion::full);
  EXPECT_EQ(Setting(2.1f, vec3(2.2f, 5, 0)).of(sun), Occlusion::none);
}

TEST(OcclusionPyramid, APatchBehindTheLightOrSeenFromItsBackIsDark) {
  const Setting open(0.0f, vec3(0));
  EXPECT_EQ(open.of(test::makeVpl(vec3(0, 2, 0), vec3(0, 1, 0))), Occlusion::full);
  EXPECT_EQ(open.of(test::makeVpl(vec3(0, -2, 0), vec3(0, 1, 0))), Occlusion::full);
}

// A light sample on the same surface, or on another surface in the same plane, is offset by the ray
// epsilon and emits away from the patch.
TEST(OcclusionPyramid, ALightSampleOnThePatchDoesNotLightIt) {
  for (const float x : {0.3f, 3.0f})
    EXPECT_EQ(Setting(0.0f, vec3(0)).of(test::makeVpl(vec3(x, 1e-5f, 0), vec3(0, 1, 0))),
              Occlusion::full);
}

// A wall at the border of the patch does not block light of any direction.
TEST(OcclusionPyramid, AWallAtTheBorderOfThePatchIsNoOccluder) {
  Setting open(0.0f, vec3(0));
  Scene scene = open.scene;
  const NodeId wall = test::addMesh(scene, test::squareMesh(2.0f, 0), vec3(-1, 1, 0));
  scene.find(wall)->local.rotation = glm::angleAxis(0.5f * kPi, vec3(0, 0, -1));
  Setting walled(scene);
  for (const vec3& at : {vec3(0.9f, 1, 0.2f), vec3(-0.5f, 2, 0), vec3(5, 0.8f, -3)})
    EXPECT_EQ(walled.of(test::makeVpl(at, glm::normalize(vec3(0, 0, 0) - at))), Occlusion::none);
}

TEST(OcclusionPyramid, ALightInThePlaneOfThePatchIsPartial) {
  EXPECT_EQ(Setting(0.0f, vec3(0)).of(test::makeVpl(vec3(3, 0, 0), vec3(-1, 0, 0))),
            Occlusion::partial);
}

}  // namespace
}  // namespace lamplighter
