// many_lights with the light of the sky on surfaces, and what glossy surfaces mirror of it.
#include <gtest/gtest.h>

#include "renderer/image/average_blocks.h"
#include "renderer/image/metrics.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

constexpr vec3 kSky(0.9f, 1.0f, 1.3f);

Settings skySettings(int bounces) {
  Settings settings;
  settings.set("indirect", std::string("meshes"));
  settings.set("bounces", bounces);
  settings.set("antialias", 4);
  return settings;
}

// A room with a window to the sky, a red box in it and a floor of one roughness.
struct SunRoom {
  Scene scene;
  NodeId box = kNoNode;
  View view = test::lookAt(vec3(1.4f, 0.2f, 2.4f), vec3(-0.4f, -0.6f, -1.0f), 96, 72);

  explicit SunRoom(float roughness, float metallic = 0.0f) {
    const int white = test::addMaterial(scene, vec3(0.7f), 0.0f, 1.0f);
    const int red = test::addMaterial(scene, vec3(0.7f, 0.2f, 0.1f), 0.0f, 1.0f);
    const int floor = test::addMaterial(scene, vec3(0.6f), metallic, roughness);
    const auto add = [&](const vec3& size, const vec3& at, int material) {
      return test::addMesh(scene, test::boxMesh(size, material), at);
    };
    add(vec3(4.0f, 0.2f, 6.0f), vec3(0.0f, -1.35f, 0.0f), floor);
    add(vec3(4.0f, 0.2f, 6.0f), vec3(0.0f, 1.35f, 0.0f), white);
    add(vec3(0.2f, 2.9f, 6.0f), vec3(2.1f, 0.0f, 0.0f), white);
    add(vec3(4.4f, 2.9f, 0.2f), vec3(0.0f, 0.0f, 3.1f), white);
    add(vec3(4.4f, 2.9f, 0.2f), vec3(0.0f, 0.0f, -3.1f), white);
    // The wall with the window: 2 m wide, 1.4 m high.
    add(vec3(0.2f, 0.8f, 6.0f), vec3(-2.1f, -1.05f, 0.0f), white);
    add(vec3(0.2f, 0.7f, 6.0f), vec3(-2.1f, 1.1f, 0.0f), white);
    add(vec3(0.2f, 1.4f, 2.0f), vec3(-2.1f, 0.05f, 2.0f), white);
    add(vec3(0.2f, 1.4f, 2.0f), vec3(-2.1f, 0.05f, -2.0f), white);
    box = add(vec3(0.7f), vec3(-0.6f, -0.9f, -0.9f), red);
    scene.sky = kSky;
  }
};

Image settled(FrameRenderer& renderer, const Scene& scene, SceneChanges changes, const View& view,
              const Settings& settings, const std::string& method = "many_lights",
              LightPart part = LightPart::all) {
  GiOutput out;
  for (int frame = 0; frame < 4000 && !out.settled; ++frame) {
    FrameRenderer::Request request{scene, changes, view, method, settings};
    request.part = part;
    out = renderer.render(request);
    changes = {};
  }
  EXPECT_TRUE(out.settled);
  return out.radiance->pixels();
}

Image freshlySettled(const Scene& scene, const View& view, const Settings& settings,
                     const std::string& method = "many_lights", LightPart part = LightPart::all) {
  FrameRenderer renderer(makeCpuBackend());
  return settled(renderer, scene, SceneChanges::all(), view, settings, method, part);
}

// Means over blocks of pixels, because the path tracer is noisy: about 1% of them.
void expectCloseToPaths(const SunRoom& room, double most) {
  const Settings settings = skySettings(3);
  Settings paths;
  paths.set("bounces", 3);
  paths.set("spp", 512);
  const Image reference =
      averageBlocks(freshlySettled(room.scene, room.view, paths, "reference"), 8);
  const Image shown = averageBlocks(freshlySettled(room.scene, room.view, settings), 8);
  const Metrics m = compareImages(shown, reference);
  testing::Test::RecordProperty("relRmse", std::to_string(m.relRmse));
  testing::Test::RecordProperty("bias", std::to_string(m.bias));
  EXPECT_LT(m.relRmse, most);
  EXPECT_NEAR(m.bias, 1.0, 0.03);
}

TEST(MeshSky, OpenGroundHasTheLightOfTheWholeSky) {
  Scene scene;
  const vec3 albedo(0.5f, 0.4f, 0.3f);
  test::addMesh(scene, test::boxMesh(vec3(8.0f, 0.2f, 8.0f), test::addMaterial(scene, albedo)));
  scene.sky = kSky;
  const View above = test::lookAt(vec3(0.0f, 3.0f, 0.1f), vec3(0.0f), 24, 24, 0.5f);
  for (const int bounces : {0, 2}) {
    const Image shown = freshlySettled(scene, above, skySettings(bounces));
    for (const vec3& pixel : shown.pixels)
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(pixel[c], albedo[c] * kSky[c], 2e-3f);
  }
}

TEST(MeshSky, RoomWithAWindowIsCloseToPaths) { expectCloseToPaths(SunRoom(1.0f), 0.04); }
TEST(MeshSky, VarnishedFloorMirrorsTheWindow) { expectCloseToPaths(SunRoom(0.25f), 0.05); }
TEST(MeshSky, MetalFloorMirrorsTheWindow) { expectCloseToPaths(SunRoom(0.15f, 1.0f), 0.06); }

TEST(MeshSky, DirectAndIndirectLightAddUpToTheWhole) {
  const SunRoom room(0.3f);
  const auto picture = [&](LightPart part) {
    return freshlySettled(room.scene, room.view, skySettings(2), "many_lights", part);
  };
  const Image whole = picture(LightPart::all), indirect = picture(LightPart::indirect);
  Image sum = picture(LightPart::direct);
  EXPECT_GT(test::meanOf(sum).g, 0.2f * test::meanOf(whole).g);
  EXPECT_GT(test::meanOf(indirect).g, 0.1f * test::meanOf(whole).g);
  for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += indirect.pixels[i];
  EXPECT_LT(compareImages(sum, whole).relRmse, 1e-3);
}

TEST(MeshSky, EditsLeaveTheBitsOfAFreshStart) {
  SunRoom room(0.2f);
  const Settings settings = skySettings(2);
  FrameRenderer renderer(makeCpuBackend());
  settled(renderer, room.scene, SceneChanges::all(), room.view, settings);
  const auto expectFresh = [&](const auto& edit) {
    const Scene old = room.scene;
    edit(room.scene);
    const Image edited =
        settled(renderer, room.scene, compare(old, room.scene), room.view, settings);
    EXPECT_TRUE(test::sameBits(edited, freshlySettled(room.scene, room.view, settings)));
  };
  expectFresh([&](Scene& s) { s.find(room.box)->local.translation.x += 0.5f; });
  expectFresh([](Scene& s) { s.sky = vec3(0.3f, 0.2f, 0.1f); });
  expectFresh([](Scene& s) { s.sky = vec3(0.0f); });
  expectFresh([](Scene& s) { s.sky = kSky; });
}

}  // namespace
}  // namespace lamplighter
