// Glossy reflections: shown in the second frame at rest, also without antialiasing.
#include <gtest/gtest.h>

#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// A mirror on the back wall shows the red wall beside the camera.
struct MirrorRoom {
  Scene scene;
  NodeId lamp = kNoNode;
  View view = test::lookAt(vec3(0.0f, 0.0f, 1.5f), vec3(0.0f, 0.0f, -2.0f), 64, 48, 0.5f);

  MirrorRoom() {
    const int white = test::addMaterial(scene, vec3(0.7f), 0.0f, 1.0f);
    const int red = test::addMaterial(scene, vec3(0.8f, 0.1f, 0.1f), 0.0f, 1.0f);
    const int mirror = test::addMaterial(scene, vec3(0.9f), 1.0f, 0.05f);
    test::addMesh(scene, test::roomMesh(vec3(4, 3, 4), white));
    test::addMesh(scene, test::boxMesh(vec3(4.0f, 3.0f, 0.1f), red), vec3(0, 0, 1.94f));
    test::addMesh(scene, test::boxMesh(vec3(1.2f, 0.9f, 0.1f), mirror), vec3(0, 0, -1.9f));
    lamp = test::addRectangleLight(scene, vec3(0.3f, 1.45f, 0.0f), vec2(1.0f), vec3(8.0f));
  }
};

class Mirrors : public testing::TestWithParam<const char*> {
 protected:
  Settings settings(int antialias) const {
    Settings s;
    s.set("indirect", std::string(GetParam()));
    s.set("bounces", 3);
    s.set("antialias", antialias);
    return s;
  }
  // The mean of the mirror's middle, a sixteenth of the picture.
  static vec3 mirrored(const Image& picture) {
    vec3 sum(0.0f);
    int count = 0;
    for (int y = 18; y < 30; ++y)
      for (int x = 24; x < 40; ++x, ++count) sum += picture.at(x, y);
    return sum / static_cast<float>(count);
  }
  MirrorRoom room_;
};

TEST_P(Mirrors, ShowTheRoomWithoutAntialiasing) {
  Settings paths;
  paths.set("bounces", 3);
  paths.set("samples_per_pixel", 256);
  FrameRenderer tracer(makeCpuBackend()), plain(makeCpuBackend()), smooth(makeCpuBackend());
  GiOutput reference;
  for (SceneChanges changes = SceneChanges::all(); !reference.settled; changes = {})
    reference = tracer.render({room_.scene, changes, room_.view, "reference", paths});
  const vec3 truth = mirrored(reference.radiance->pixels());
  ASSERT_GT(truth.r, 2.0f * truth.g) << "it shows the red wall";
  for (const int antialias : {1, 4}) {
    const vec3 shown =
        mirrored(test::settledPicture(antialias == 1 ? plain : smooth, room_.scene,
                                      SceneChanges::all(), room_.view, settings(antialias)));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c] / truth[c], 1.0f, 0.1f) << antialias;
  }
}

TEST_P(Mirrors, AreThereInTheSecondFrameAtRest) {
  FrameRenderer renderer(makeCpuBackend());
  test::settledPicture(renderer, room_.scene, SceneChanges::all(), room_.view, settings(4));
  const Scene before = room_.scene;
  room_.scene.find(room_.lamp)->local.translation.x -= 0.1f;
  renderer.render(
      {room_.scene, compare(before, room_.scene), room_.view, "many_lights", settings(4)});
  const GiOutput second =
      renderer.render({room_.scene, {}, room_.view, "many_lights", settings(4)});
  EXPECT_FALSE(second.settled);
  const vec3 early = mirrored(second.radiance->pixels());
  const Image settled = test::settledPicture(renderer, room_.scene, {}, room_.view, settings(4));
  const vec3 late = mirrored(settled);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(early[c] / late[c], 1.0f, 0.1f);
  EXPECT_TRUE(test::sameBits(
      settled, test::freshPicture(makeCpuBackend(), room_.scene, room_.view, settings(4))));
}

// The picture is so large that its pixels take several frames.
TEST_P(Mirrors, FollowTheBrightnessOfALamp) {
  room_.view.width = 480;
  room_.view.height = 360;
  FrameRenderer renderer(makeCpuBackend());
  const Image dark =
      test::settledPicture(renderer, room_.scene, SceneChanges::all(), room_.view, settings(2));
  const Scene before = room_.scene;
  room_.scene.find(room_.lamp)->area->radiance *= 3.0f;
  const Image bright = test::settledPicture(renderer, room_.scene, compare(before, room_.scene),
                                            room_.view, settings(2));
  EXPECT_FALSE(test::sameBits(bright, dark));
  EXPECT_TRUE(test::sameBits(
      bright, test::freshPicture(makeCpuBackend(), room_.scene, room_.view, settings(2))));
}

INSTANTIATE_TEST_SUITE_P(Carriers, Mirrors, testing::Values("meshes", "links", "field"),
                         [](const auto& carrier) { return std::string(carrier.param); });

}  // namespace
}  // namespace lamplighter
