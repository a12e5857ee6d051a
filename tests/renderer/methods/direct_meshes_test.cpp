// Direct light on the meshes of multi_mesh.
#include <functional>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "renderer/image/average_blocks.h"
#include "renderer/image/metrics.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

struct Work {
  double samples = 0.0, rays = 0.0, open = 0.0;
};

// A room with a box and two lights.
struct LitRoom {
  Scene scene;
  NodeId box = kNoNode, one = kNoNode, other = kNoNode;
  View view = test::lookAt(vec3(1.4f, 0.7f, 1.9f), vec3(0.0f, -0.6f, 0.0f), 96, 72);
  Settings settings;
  FrameRenderer renderer{makeCpuBackend()};
  Work work;  // of the last picture

  explicit LitRoom(float roughness = 0.4f) {
    const int white = test::addMaterial(scene, vec3(0.8f));
    const int red = test::addMaterial(scene, vec3(0.8f, 0.2f, 0.1f), 0.0f, roughness);
    test::addMesh(scene, test::roomMesh(vec3(4.0f, 3.0f, 4.0f), white));
    box = test::addMesh(scene, test::boxMesh(vec3(0.8f), red), vec3(0.0f, -1.1f, 0.0f));
    one = test::addRectangleLight(scene, vec3(-0.6f, 1.4f, 0.0f), vec2(0.8f), vec3(5.0f));
    other =
        test::addRectangleLight(scene, vec3(0.9f, 1.4f, 0.3f), vec2(0.4f), vec3(2.0f, 4.0f, 8.0f));
    settings.set("bounces", 0);
    settings.set("antialias", 2);
  }

  static Image pictureBy(FrameRenderer& renderer, const Scene& scene, const View& view,
                         const Settings& settings, SceneChanges changes, Work& work) {
    GiOutput out;
    work = {};
    for (int frame = 0; frame < 500 && !out.settled; ++frame) {
      out = renderer.render({scene, changes, view, "multi_mesh", settings});
      changes = {};
      work.samples += out.stats.of("direct_samples");
      work.rays += static_cast<double>(out.stats.raysTraced);
      work.open += out.stats.of("direct_open");
    }
    EXPECT_TRUE(out.settled);
    return out.radiance->pixels();
  }
  Image picture(const SceneChanges& changes = {}) {
    return pictureBy(renderer, scene, view, settings, changes, work);
  }
  Image fresh() const {
    FrameRenderer own(makeCpuBackend());
    Work ignored;
    return pictureBy(own, scene, view, settings, SceneChanges::all(), ignored);
  }
  Image edited(const std::function<void(Scene&)>& edit) {
    const Scene old = scene;
    edit(scene);
    return picture(compare(old, scene));
  }
};

// Means of 4 × 4 pixels, because the path tracer is noisy: about 0.7% of them.
TEST(DirectMeshes, IsNearTheReferenceAndNearerWithLessContrast) {
  LitRoom room(1.0f);
  room.settings.set("antialias", 16);
  const Image reference = averageBlocks(test::renderReference(room.scene, room.view, 1024, 0), 4);
  const auto errorOf = [&](float leastPixels, float contrast) {
    room.settings.set("least_pixels", leastPixels);
    room.settings.set("contrast", contrast);
    return compareImages(averageBlocks(room.fresh(), 4), reference).relRmse;
  };
  const double asDefault = errorOf(4.0f, 2.0f), fine = errorOf(1.0f, 0.5f);
  EXPECT_LT(asDefault, 0.02);
  EXPECT_LT(fine, 0.005);
}

// With highlights, whose light is found at pixels.
TEST(DirectMeshes, HighlightsAreThoseOfLightSamples) {
  LitRoom room(0.3f);
  room.settings.set("least_pixels", 1.0f);
  room.settings.set("contrast", 0.5f);
  const Image shown = averageBlocks(room.picture(SceneChanges::all()), 4);
  room.settings.set("direct", std::string("samples"));
  const Image samples = averageBlocks(room.fresh(), 4);
  room.settings.set("speculars", false);
  const Image without = averageBlocks(room.fresh(), 4);
  EXPECT_LT(compareImages(shown, samples).relRmse, 0.01);
  EXPECT_GT(compareImages(without, samples).relRmse, 0.02);
}

TEST(DirectMeshes, AnOpenFloorIsTheClosedFormWithoutAnyRay) {
  LitRoom room;
  room.scene = {};
  const int white = test::addMaterial(room.scene, vec3(1.0f));
  const vec2 size(0.8f, 0.5f);
  test::addMesh(room.scene, test::squareMesh(4.0f, white));
  const vec3 at(0.2f, 2.0f, 0.1f);
  test::addRectangleLight(room.scene, at, size, vec3(1.0f));
  room.view = test::lookAt(vec3(0.0f, 3.0f, 0.02f), vec3(0.0f), 64, 64);
  room.view.eye.y = 1.9f;  // below the light
  room.settings.set("contrast", 0.1f);
  room.settings.set("least_pixels", 1.0f);
  room.settings.set("antialias", 1);
  const Image picture = room.picture(SceneChanges::all());
  EXPECT_EQ(room.work.rays, 0.0);
  EXPECT_EQ(room.work.open, room.work.samples);
  EXPECT_GT(room.work.samples, 100.0);
  const std::vector<vec3> polygon{
      at + 0.5f * vec3(-size.x, 0.0f, -size.y), at + 0.5f * vec3(size.x, 0.0f, -size.y),
      at + 0.5f * vec3(size.x, 0.0f, size.y), at + 0.5f * vec3(-size.x, 0.0f, size.y)};
  for (const int y : {8, 31, 50}) {
    for (const int x : {5, 32, 58}) {
      const vec3 d =
          room.view.rayDirection(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const vec3 place = room.view.eye - room.view.eye.y / d.y * d;
      const double expected = std::abs(test::polygonFormFactor(place, vec3(0, 1, 0), polygon));
      EXPECT_NEAR(picture.at(x, y).r, expected, 0.002 * expected) << x << ", " << y;
    }
  }
}

TEST(DirectMeshes, BrightnessFindsNoLightAnew) {
  LitRoom room;
  room.picture(SceneChanges::all());
  EXPECT_GT(room.work.samples, 1000.0);
  const Image dimmed =
      room.edited([&](Scene& s) { s.find(room.one)->area->radiance *= vec3(0.5f, 0.7f, 0.1f); });
  EXPECT_EQ(room.work.samples, 0.0);
  EXPECT_EQ(room.work.rays, 0.0);
  EXPECT_TRUE(test::sameBits(dimmed, room.fresh()));
}

TEST(DirectMeshes, ALightThatMovesLeavesTheMeshOfTheOther) {
  LitRoom room;
  room.picture(SceneChanges::all());
  const double both = room.work.samples;
  const Image moved = room.edited([&](Scene& s) { s.find(room.one)->local.translation.x -= 0.3f; });
  const double one = room.work.samples;
  EXPECT_TRUE(test::sameBits(moved, room.fresh()));
  EXPECT_LT(one, both);
  room.settings.set("separate_lights", false);
  room.picture();
  room.edited([&](Scene& s) { s.find(room.one)->local.translation.x += 0.3f; });
  EXPECT_GT(room.work.samples, 0.0);
}

TEST(DirectMeshes, EditsLeaveTheBitsOfAFreshStart) {
  LitRoom room;
  const Image before = room.picture(SceneChanges::all());
  const double all = room.work.samples;
  const Image moved = room.edited([&](Scene& s) { s.find(room.box)->local.translation.x += 0.4f; });
  EXPECT_FALSE(test::sameBits(moved, before));
  EXPECT_TRUE(test::sameBits(moved, room.fresh()));
  EXPECT_LT(room.work.samples, 0.9 * all);
  const Image back = room.edited([&](Scene& s) { s.find(room.box)->local.translation.x -= 0.4f; });
  EXPECT_TRUE(test::sameBits(back, before));
  const Image off = room.edited([&](Scene& s) { s.find(room.one)->visible = false; });
  EXPECT_LT(room.work.samples, 0.2 * all);  // behind the lamp that went
  EXPECT_TRUE(test::sameBits(off, room.fresh()));
  const Image on = room.edited([&](Scene& s) { s.find(room.one)->visible = true; });
  EXPECT_TRUE(test::sameBits(on, before));
}

TEST(DirectMeshes, ACameraThatReturnsFindsNoLightAnew) {
  LitRoom room;
  const Image before = room.picture(SceneChanges::all());
  const View view = room.view;
  room.view = test::lookAt(vec3(-1.2f, 0.9f, 1.7f), vec3(0.0f, -0.6f, 0.0f), 96, 72);
  const Image elsewhere = room.picture();
  EXPECT_TRUE(test::sameBits(elsewhere, room.fresh()));
  room.view = view;
  EXPECT_TRUE(test::sameBits(room.picture(), before));
  EXPECT_EQ(room.work.samples, 0.0);
}

TEST(DirectMeshes, ThePictureDependsOnNeitherOrderNorThreads) {
  LitRoom room;
  const Image expected = room.picture(SceneChanges::all());
  for (const std::string priority : {"paper", "random"}) {
    room.settings.set("priority", priority);
    EXPECT_TRUE(test::sameBits(room.fresh(), expected)) << priority;
  }
  for (const size_t threads : {1u, 5u}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_TRUE(test::sameBits(room.fresh(), expected)) << threads;
  }
}

TEST(DirectMeshes, OneMeshForAllLightsShowsTheSame) {
  LitRoom room;
  const Image separate = room.picture(SceneChanges::all());
  room.settings.set("separate_lights", false);
  EXPECT_LT(compareImages(room.fresh(), separate).relRmse, 0.02);
}

TEST(DirectMeshes, LittleMemoryForgetsOtherViewsOnly) {
  LitRoom room;
  room.settings.set("mesh_memory", 1);
  room.picture(SceneChanges::all());
  room.view = test::lookAt(vec3(-1.2f, 0.9f, 1.7f), vec3(0.0f, -0.6f, 0.0f), 96, 72);
  EXPECT_TRUE(test::sameBits(room.picture(), room.fresh()));
}

}  // namespace
}  // namespace lamplighter
