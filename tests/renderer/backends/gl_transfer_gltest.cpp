// Complex meshes lit by precomputed transfer. The gl backend gives the picture of the cpu backend,
// and the result does not depend on earlier edits or settings.
#include <spdlog/fmt/fmt.h>

#include "renderer/backends/gl/gl_backend.h"
#include "renderer/image/metrics.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// A bumpy sphere, and a bowl that is seen from inside and outside.
struct Room {
  Scene scene;
  NodeId sphere = kNoNode, light = kNoNode;
  View view = test::lookAt(vec3(2.3f, 1.7f, 2.8f), vec3(0.0f, 0.7f, 0.1f), 160, 120, 0.8f);

  Room() {
    const int white = test::addMaterial(scene, vec3(0.75f));
    const int red = test::addMaterial(scene, vec3(0.8f, 0.3f, 0.2f));
    const int blue = test::addMaterial(scene, vec3(0.3f, 0.4f, 0.8f));
    scene.materials[static_cast<size_t>(blue)].doubleSided = true;
    test::addMesh(scene, test::roomMesh(vec3(6, 3, 6), white), vec3(0, 1.5f, 0));
    sphere = test::addMesh(scene, test::sphereMesh(0.5f, 24, 0.12f, red), vec3(-0.6f, 0.75f, 0.3f));
    Mesh bowl = *test::sphereMesh(0.5f, 24, 0.1f, blue);
    Primitive& p = bowl.primitives[0];
    std::vector<uint32_t> lower;
    for (size_t i = 0; i + 2 < p.indices.size(); i += 3) {
      const float y = p.positions[p.indices[i]].y + p.positions[p.indices[i + 1]].y +
                      p.positions[p.indices[i + 2]].y;
      if (y < 0.0f) lower.insert(lower.end(), &p.indices[i], &p.indices[i] + 3);
    }
    p.indices = lower;
    test::addMesh(scene, std::make_shared<const Mesh>(bowl), vec3(0.7f, 0.8f, 0.0f));
    light = test::addRectangleLight(scene, vec3(0.6f, 2.95f, 0.6f), vec2(1.0f), vec3(12.0f));
  }
};

Settings settingsOf(bool prt, const std::string& technique = "light_maps", int block = 1,
                    int bounces = 4) {
  Settings s;
  s.set("share_memory", 0);  // the settled picture is that of the live sums
  s.set("prt", prt);
  s.set("prt_bounces", bounces);
  s.set("technique", technique);
  s.set("block", std::to_string(block));
  s.set("vpls", 200);
  s.set("updates", 200);
  s.set("antialias", 1);
  return s;
}

Image rendered(FrameRenderer& renderer, const Room& room, const SceneChanges& changes,
               const Settings& settings) {
  return test::renderSettled(renderer, room.scene, changes, room.view, settings).radiance->pixels();
}

Image rendered(std::unique_ptr<Backend> backend, const Room& room, const Settings& settings) {
  FrameRenderer renderer(std::move(backend));
  return rendered(renderer, room, SceneChanges::all(), settings);
}

using GlTransfer = test::GlTest;

TEST_F(GlTransfer, EqualsTheCpuBackend) {
  const Room room;
  const Image plain = rendered(makeGlBackend(), room, settingsOf(false));
  for (const std::string technique : {"visibility", "light_maps"}) {
    for (const auto& [block, bounces] : {std::pair(1, 4), {4, 4}, {4, 0}}) {
      const std::string variant = fmt::format("{}_{}_{}", technique, block, bounces);
      SCOPED_TRACE(variant);
      const Image gl = rendered(makeGlBackend(), room, settingsOf(true, technique, block, bounces));
      const Image cpu = rendered(makeCpuBackend(), room, settingsOf(true, technique, 1, bounces));
      const Metrics m = compareImages(gl, cpu);
      RecordProperty(variant, std::to_string(m.relRmse));
      EXPECT_LT(m.relRmse, 0.01);
      EXPECT_NEAR(m.bias, 1.0, 0.002);
      // Verifies that transfer is used: the picture differs from that of pixels with shadow maps.
      EXPECT_GT(compareImages(gl, plain).relRmse, 2.0 * m.relRmse);
    }
  }
}

TEST_F(GlTransfer, AfterEditsThePictureEqualsAFreshRender) {
  Room room;
  FrameRenderer renderer(makeGlBackend());
  const Settings settings = settingsOf(true, "light_maps", 1, 0);
  const Image first = rendered(renderer, room, SceneChanges::all(), settings);
  for (const NodeId moved : {room.sphere, room.light}) {
    const Scene before = room.scene;
    room.scene.find(moved)->local.translation += vec3(0.2f, 0.0f, -0.1f);
    const Image edited = rendered(renderer, room, compare(before, room.scene), settings);
    EXPECT_TRUE(test::sameBits(edited, rendered(makeGlBackend(), room, settings)));
    EXPECT_GT(compareImages(edited, first).relRmse, 0.01);
  }
}

TEST_F(GlTransfer, SwitchingItEqualsAFreshRender) {
  const Room room;
  FrameRenderer renderer(makeGlBackend());
  rendered(renderer, room, SceneChanges::all(), settingsOf(false));
  for (const bool prt : {true, false, true}) {
    const Image switched = rendered(renderer, room, {}, settingsOf(prt));
    EXPECT_TRUE(test::sameBits(switched, rendered(makeGlBackend(), room, settingsOf(prt)))) << prt;
  }
}

}  // namespace
}  // namespace lamplighter
