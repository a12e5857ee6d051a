// Rooms that are lit by bounced light alone, against the path tracer, with bounced light on
// surfaces and else default settings.
#include <gtest/gtest.h>

#include "renderer/image/average_blocks.h"
#include "renderer/image/metrics.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

constexpr int kBounces = 5, kBlock = 12;

struct LitRoom {
  Scene scene;
  View view;
};

// A lamp behind the corner of a corridor.
LitRoom corridor() {
  LitRoom out;
  const int white = test::addMaterial(out.scene, vec3(0.75f));
  const int blue = test::addMaterial(out.scene, vec3(0.3f, 0.4f, 0.7f));
  test::addMesh(out.scene, test::roomMesh(vec3(6.0f, 3.0f, 6.0f), white));
  test::addMesh(out.scene, test::boxMesh(vec3(4.0f, 3.02f, 4.0f), blue), vec3(1.0f, 0.0f, 1.0f));
  test::addRectangleLight(out.scene, vec3(2.2f, 1.3f, -2.0f), vec2(0.8f), vec3(40.0f));
  out.view = test::lookAt(vec3(-2.0f, 0.1f, 2.6f), vec3(-2.0f, -0.3f, -2.0f), 96, 72);
  return out;
}

// A dark room with a door ajar to a lit one.
LitRoom doorAjar() {
  LitRoom out;
  const int white = test::addMaterial(out.scene, vec3(0.75f));
  const int wood = test::addMaterial(out.scene, vec3(0.5f, 0.3f, 0.2f));
  test::addMesh(out.scene, test::roomMesh(vec3(6.0f, 3.0f, 6.0f), white));
  test::addMesh(out.scene, test::boxMesh(vec3(3.2f, 3.02f, 0.1f), white), vec3(-1.4f, 0.0f, 0.0f));
  test::addMesh(out.scene, test::boxMesh(vec3(2.0f, 3.02f, 0.1f), white), vec3(2.0f, 0.0f, 0.0f));
  test::addMesh(out.scene, test::boxMesh(vec3(0.8f, 0.96f, 0.1f), white), vec3(0.6f, 1.03f, 0.0f));
  // Its hinge is at x = 0.2.
  const float angle = 0.7f;
  const NodeId door =
      test::addMesh(out.scene, test::boxMesh(vec3(0.76f, 2.02f, 0.04f), wood),
                    vec3(0.2f + 0.38f * std::cos(angle), -0.48f, -0.38f * std::sin(angle)));
  out.scene.find(door)->local.rotation = glm::angleAxis(angle, vec3(0.0f, 1.0f, 0.0f));
  test::addRectangleLight(out.scene, vec3(0.4f, 1.3f, 1.6f), vec2(1.0f), vec3(60.0f));
  out.view = test::lookAt(vec3(-1.8f, 0.3f, -2.7f), vec3(0.6f, -0.5f, 0.0f), 96, 72);
  return out;
}

Image settled(const LitRoom& room, const std::string& method, const Settings& settings) {
  FrameRenderer renderer(makeCpuBackend());
  SceneChanges changes = SceneChanges::all();
  GiOutput out;
  for (int frame = 0; frame < 4000 && !out.settled; ++frame) {
    out = renderer.render({room.scene, changes, room.view, method, settings});
    changes = {};
  }
  EXPECT_TRUE(out.settled);
  return out.radiance->pixels();
}

// Of means over blocks of pixels, because the path tracer is noisy: about 2% of them.
void expectCloseToPaths(const LitRoom& room) {
  Settings settings;
  settings.set("bounces", kBounces);
  Settings paths = settings;
  paths.set("spp", 2048);
  const Image reference = averageBlocks(settled(room, "reference", paths), kBlock);
  settings.set("indirect", std::string("meshes"));
  const Image shown = averageBlocks(settled(room, "many_lights", settings), kBlock);
  const Metrics m = compareImages(shown, reference);
  testing::Test::RecordProperty("relRmse", std::to_string(m.relRmse));
  testing::Test::RecordProperty("bias", std::to_string(m.bias));
  EXPECT_LT(m.relRmse, 0.05);
}

TEST(MeshRooms, CorridorWithALampBehindItsCorner) { expectCloseToPaths(corridor()); }
TEST(MeshRooms, RoomLitThroughADoorAjar) { expectCloseToPaths(doorAjar()); }

}  // namespace
}  // namespace lamplighter
