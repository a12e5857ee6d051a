// States of lights (off, solo, groups): which lights emit, the renderer's scene, and saving.
#include <fstream>

#include <gmock/gmock.h>

#include "renderer/base/error.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/render_scene.h"
#include "tests/support/scenes/gltf_files.h"
#include "tests/support/scenes/scene_equality.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

class LightStates : public testing::Test {
 protected:
  Scene scene_;
  NodeId floor_ = 0, area_ = 0, point_ = 0, glow_ = 0, twin_ = 0;

  void SetUp() override {
    floor_ = test::addMesh(scene_, test::squareMesh(10.0f));
    area_ = test::addRectangleLight(scene_, vec3(0, 4, 0), vec2(1.0f), vec3(10.0f));
    point_ = test::addNode(scene_, "bulb", kNoNode, vec3(1, 2, 0));
    scene_.find(point_)->punctual = PunctualLight{PunctualKind::point, vec3(5.0f)};
    const int glow = test::addMaterial(scene_, vec3(0), vec3(4, 2, 1));
    glow_ = test::addMesh(scene_, test::boxMesh(vec3(0.2f), glow), vec3(-1, 1, 0));
    twin_ = test::addMesh(scene_, test::boxMesh(vec3(0.2f), glow), vec3(-2, 1, 0));
    scene_.sky = vec3(0.5f);
  }
  LightState& state(NodeId id) { return scene_.find(id)->light; }
  // The nodes that emit, with kNoNode for the sky.
  std::vector<NodeId> emitting() {
    const RenderScene render = test::renderSceneOf(scene_);
    return emittersOf(render);
  }
  static std::vector<NodeId> emittersOf(const RenderScene& render) {
    std::vector<NodeId> ids;
    const LightSet lights(render);
    for (const Emitter& e : lights.emitters())
      if (e.flux != vec3(0.0f)) ids.push_back(e.node);
    std::sort(ids.begin(), ids.end());
    return ids;
  }
};

using testing::ElementsAre;

TEST_F(LightStates, OffSoloAndGroups) {
  EXPECT_THAT(emitting(), ElementsAre(kNoNode, area_, point_, glow_, twin_));
  state(area_).on = false;
  state(glow_).on = false;
  EXPECT_THAT(emitting(), ElementsAre(kNoNode, point_, twin_));
  state(twin_).solo = true;
  EXPECT_THAT(emitting(), ElementsAre(twin_));
  state(area_).solo = true;  // it is off, though
  EXPECT_THAT(emitting(), ElementsAre(twin_));
  scene_.skyLight.solo = true;
  EXPECT_THAT(emitting(), ElementsAre(kNoNode, twin_));
  scene_.skyLight = {.on = false};
  state(twin_).solo = state(area_).solo = false;
  EXPECT_THAT(emitting(), ElementsAre(point_, twin_));
}

TEST_F(LightStates, GroupsAreMutedAndSolo) {
  scene_.lightGroups = {{"a"}, {"b"}};
  state(area_).group = state(glow_).group = "a";
  state(point_).group = "b";
  state(twin_).group = "gone";  // this group does not exist
  scene_.lightGroups[0].muted = true;
  EXPECT_THAT(emitting(), ElementsAre(kNoNode, point_, twin_));
  scene_.lightGroups[0] = {"a", false, true};
  EXPECT_THAT(emitting(), ElementsAre(area_, glow_));
  // Solo on an object that is not a light has no effect.
  scene_.lightGroups[0].solo = false;
  state(floor_).solo = true;
  EXPECT_EQ(emitting().size(), 5u);
}

// After each edit, the incrementally updated RenderScene equals a new one. An object with the same
// material still emits.
TEST_F(LightStates, IncrementalUpdatesEqualANewScene) {
  RenderScene live = test::renderSceneOf(scene_);
  Scene shown = scene_;
  const auto edit = [&](const char* what, auto change) {
    change();
    const SceneChanges changes = compare(shown, scene_);
    EXPECT_FALSE(changes.none()) << what;
    const bool structure = changes.structure;
    update(live, scene_, changes);
    shown = scene_;
    const RenderScene fresh = test::renderSceneOf(scene_);
    EXPECT_EQ(emittersOf(live), emittersOf(fresh)) << what;
    EXPECT_EQ(live.materials.size(), fresh.materials.size()) << what;
    for (size_t i = 0; i < fresh.materials.size(); ++i)
      EXPECT_TRUE(live.materials[i] == fresh.materials[i]) << what << " " << i;
    for (size_t i = 0; i < fresh.objects.size(); ++i)
      EXPECT_EQ(live.objects[i].material, fresh.objects[i].material) << what;
    EXPECT_TRUE(live.sky == fresh.sky) << what;
    return structure;
  };
  EXPECT_FALSE(edit("area off", [&] { state(area_).on = false; }));
  EXPECT_FALSE(
      edit("area brighter while off", [&] { scene_.find(area_)->area->radiance *= 2.0f; }));
  EXPECT_FALSE(edit("point off", [&] { state(point_).on = false; }));
  EXPECT_FALSE(
      edit("point moved while off", [&] { scene_.find(point_)->local.translation = vec3(2); }));
  EXPECT_FALSE(edit("mesh off", [&] { state(glow_).on = false; }));
  EXPECT_FALSE(edit("its material brighter", [&] { scene_.materials[0].emissive *= 2.0f; }));
  edit("its material dark", [&] { scene_.materials[0].emissive = vec3(0); });
  edit("and bright again", [&] { scene_.materials[0].emissive = vec3(1); });
  EXPECT_FALSE(edit("sky off", [&] { scene_.skyLight.on = false; }));
  edit("area solo, which is off", [&] { state(area_) = {true, true}; });
  edit("all on", [&] {
    for (const NodeId id : {area_, point_, glow_}) state(id) = {};
    scene_.skyLight = {};
  });
}

TEST_F(LightStates, AreSavedAndLoaded) {
  const test::TemporaryFolder folder;
  scene_.lightGroups = {{"a", true, false}, {"b", false, true}};
  state(area_) = {false, true, "a"};
  state(point_).group = "b";
  scene_.skyLight = {false, false, "b"};
  saveGltf(scene_, folder.path() / "s.gltf");
  const Scene loaded = loadGltf(folder.path() / "s.gltf").scene;
  EXPECT_EQ(loaded.lightGroups, scene_.lightGroups);
  EXPECT_EQ(loaded.skyLight, scene_.skyLight);
  EXPECT_EQ(loaded.nodes[1].light, state(area_));
  EXPECT_EQ(loaded.nodes[2].light, state(point_));
  // Default states write no extras.
  Scene plain = loaded;
  plain.lightGroups.clear();
  plain.skyLight = {};
  for (Node& n : plain.nodes) n.light = {};
  saveGltf(plain, folder.path() / "plain.gltf");
  const Scene again = loadGltf(folder.path() / "plain.gltf").scene;
  EXPECT_EQ(test::difference(plain, again), "");
  EXPECT_TRUE(again.lightGroups.empty());
}

TEST_F(LightStates, ExtrasOfAWrongTypeAreRejectedWithOneLine) {
  const test::TemporaryFolder folder;
  state(area_) = {false, true, "a"};
  saveGltf(scene_, folder.path() / "s.gltf");
  std::ifstream in(folder.path() / "s.gltf");
  const std::string good((std::istreambuf_iterator<char>(in)), {});
  const auto with = [&](const std::string& what, const std::string& by) {
    std::string text = good;
    const size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    if (at != std::string::npos) text.replace(at, what.size(), by);
    std::ofstream(folder.path() / "bad.gltf") << text;
    return folder.path() / "bad.gltf";
  };
  const std::string key = good.find("\"on\": false") != std::string::npos ? "\"on\": " : "\"on\":";
  for (const char* value : {"7", "\"no\"", "[]"}) {
    try {
      loadGltf(with(key + "false", key + value));
      ADD_FAILURE() << value;
    } catch (const InputError& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    }
  }
}

TEST(TubeLights, HaveTheAreaOfACylinderAndAreSaved) {
  Scene scene;
  const NodeId id = test::addNode(scene, "tube");
  scene.find(id)->area = AreaLight{AreaShape::tube, vec3(3, 2, 1), vec2(1.2f, 0.05f)};
  const RenderScene render = test::renderSceneOf(scene);
  const LightSet lights(render);
  ASSERT_EQ(lights.emitters().size(), 1u);
  EXPECT_NEAR(lights.emitters()[0].area, kPi * 0.05f * 1.2f, 1e-6f);
  // Faces point outwards, and the tube is centred on the X axis.
  for (size_t i = 0; i < render.indices.size(); i += 3) {
    const vec3 &a = render.positions[render.indices[i]],
               &b = render.positions[render.indices[i + 1]],
               &c = render.positions[render.indices[i + 2]];
    const vec3 middle = (a + b + c) / 3.0f;
    EXPECT_GT(glm::dot(glm::cross(b - a, c - a), vec3(0, middle.y, middle.z)), 0.0f);
  }
  EXPECT_NEAR(render.bounds.min.x, -0.6f, 1e-6f);
  EXPECT_NEAR(render.bounds.max.x, 0.6f, 1e-6f);

  const test::TemporaryFolder folder;
  scene.find(test::addNode(scene, "ball"))->area =
      AreaLight{AreaShape::sphere, vec3(3, 2, 1), vec2(0.3f)};
  for (const char* name : {"t.gltf", "t.glb"}) {
    saveGltf(scene, folder.path() / name);
    const LoadedScene loaded = loadGltf(folder.path() / name);
    EXPECT_EQ(test::difference(scene, loaded.scene), "") << name;
    EXPECT_TRUE(loaded.warnings.empty());
  }
}

}  // namespace
}  // namespace lamplighter
