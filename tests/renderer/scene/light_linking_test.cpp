// Light linking: excluded objects get no direct light of the light, nothing else changes, and all
// methods agree. An edit of the lists gives the picture of the newly opened scene.
#include "renderer/scene/light_linking.h"

#include <fstream>

#include <gmock/gmock.h>

#include "renderer/base/error.h"
#include "renderer/image/average_blocks.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/render.h"
#include "tests/support/scenes/gltf_files.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scene_equality.h"
#include "tests/support/scenes/scenes.h"
#include "tests/support/scenes/skies.h"

namespace lamplighter {
namespace {

using testing::ElementsAre;

// Two squares side by side in one plane, a box on the left one, and two lights.
struct Tiles {
  Scene scene;
  NodeId left, right, box, group, lamp, bulb;
  View view = test::lookAt(vec3(0, 4, 4.5f), vec3(0, 0, 0), 64, 40, 0.8f);

  Tiles() {
    const int white = test::addMaterial(scene, vec3(0.7f));
    left = test::addMesh(scene, test::squareMesh(4.0f, white), vec3(-2, 0, 0));
    right = test::addMesh(scene, test::squareMesh(4.0f, white), vec3(2, 0, 0));
    group = test::addNode(scene, "group");
    box = test::addMesh(scene, test::boxMesh(vec3(0.8f), white), vec3(-1.2f, 0.41f, 0));
    scene.find(box)->parent = group;
    lamp = test::addRectangleLight(scene, vec3(0.3f, 3, 0), vec2(0.6f), vec3(20, 18, 16));
    bulb = test::addNode(scene, "bulb", kNoNode, vec3(1, 2, 1));
    scene.find(bulb)->punctual = PunctualLight{PunctualKind::point, vec3(3, 4, 5)};
  }
  std::vector<NodeId>& leftOut(NodeId light) { return scene.find(light)->light.leftOut; }
};

TEST(LightLinking, EqualListsAreSharedAndIncludeDescendants) {
  Tiles t;
  t.leftOut(t.lamp) = {t.left, t.group};
  t.leftOut(t.bulb) = {t.left, t.group, 77};  // the last one does not exist
  t.scene.skyLight.leftOut = {t.right};
  const LightLinks links = lightLinks(t.scene);
  EXPECT_EQ(links.count, 2u);
  EXPECT_EQ(countLinks(t.scene), 2u);
  EXPECT_THAT(links.leftOutBy, ElementsAre(1u, 2u, 1u, 1u, 0u, 0u));
  EXPECT_THAT(links.ofLight, ElementsAre(0, 0, 0, 0, 1, 1));
  EXPECT_EQ(links.ofSky, 2);
  EXPECT_TRUE(isLeftOut(links.leftOutBy[0], 1));
  EXPECT_FALSE(isLeftOut(links.leftOutBy[0], 2));
  EXPECT_FALSE(isLeftOut(~0u, 0));
}

// Direct light only, at two points: the lamp by Lambert's formula, the bulb by I cos θ / d².
TEST(LightLinking, DirectLightIsThatOfTheOtherLights) {
  Tiles t;
  t.leftOut(t.lamp) = {t.left};
  const View view = test::lookAt(vec3(0, 6, 0.01f), vec3(0), 64, 64, 0.9f);
  const Image picture = test::renderReference(t.scene, view, 256, 0);
  t.leftOut(t.lamp) = {t.left, t.right};
  t.leftOut(t.bulb) = {t.left};
  const Image dark = test::renderReference(t.scene, view, 4, 0);
  for (const vec3& p : {vec3(-1.9f, 0, 0.8f), vec3(0.9f, 0, -1.1f)}) {
    const vec2 at(view.project(p));
    const auto pixel = [&](const Image& image) {
      vec3 sum(0.0f);
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          sum += image.at(static_cast<int>(at.x) + dx, static_cast<int>(at.y) + dy) / 9.0f;
      return sum;
    };
    const vec3 toBulb = vec3(1, 2, 1) - p;
    const vec3 bulb = vec3(3, 4, 5) * (toBulb.y / std::pow(glm::length(toBulb), 3.0f));
    const float h = 0.3f;
    const vec3 lamp =
        vec3(20, 18, 16) * kPi *
        static_cast<float>(std::abs(test::polygonFormFactor(
            p, vec3(0, 1, 0),
            {{0.3f - h, 3, -h}, {0.3f - h, 3, h}, {0.3f + h, 3, h}, {0.3f + h, 3, -h}})));
    const bool isLeft = p.x < 0.0f;
    const vec3 expected = 0.7f / kPi * (isLeft ? bulb : bulb + lamp);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(pixel(picture)[c], expected[c], 0.05f * expected[c]) << p.x << " " << c;
      if (isLeft) {
        EXPECT_EQ(pixel(dark)[c], 0.0f);
      }
    }
  }
}

Settings manyLights(const char* technique, bool prt, int prtBounces = 0) {
  Settings s;
  s.set("vpls", 300);
  s.set("bounces", 2);
  s.set("updates", 4096);
  s.set("antialias", 1);
  s.set("map_resolution", 64);
  s.set("technique", technique);
  s.set("share_memory", 0);  // shares are summed without light maps
  s.set("prt", prt);
  s.set("prt_bounces", prtBounces);
  s.set("bias_compensation", false);
  return s;
}

struct Variant {
  const char* name;
  const char* technique;
  bool prt;
  const char* block;
  bool speculars;
  int prtBounces = 0;
};
void PrintTo(const Variant& v, std::ostream* out) { *out << v.name; }
class LiveLinking : public testing::TestWithParam<Variant> {};

// The lists change between moves of lights and objects: the bits are those of a fresh render.
TEST_P(LiveLinking, EqualsAFreshRender) {
  Tiles t;
  const int gloss = test::addMaterial(t.scene, vec3(0.6f));
  t.scene.materials[static_cast<size_t>(gloss)].roughness = 0.3f;
  const NodeId ball =
      test::addMesh(t.scene, test::sphereMesh(0.5f, 10, 0.0f, gloss), vec3(1, 0.7f, 0));
  t.scene.sky = test::gradientSky();
  Settings settings = manyLights(GetParam().technique, GetParam().prt, GetParam().prtBounces);
  settings.set("block", std::string(GetParam().block));
  settings.set("speculars", GetParam().speculars);
  FrameRenderer live(makeCpuBackend());
  test::settledPicture(live, t.scene, SceneChanges::all(), t.view, settings);
  const auto edit = [&](const char* what, auto change) {
    const Scene before = t.scene;
    change();
    const Image edited =
        test::settledPicture(live, t.scene, compare(before, t.scene), t.view, settings);
    const Image expected = test::freshPicture(makeCpuBackend(), t.scene, t.view, settings);
    EXPECT_TRUE(test::sameBits(edited, expected)) << what;
    return edited;
  };
  edit("lamp excludes the left square", [&] { t.leftOut(t.lamp) = {t.left}; });
  edit("bulb excludes the ball", [&] { t.leftOut(t.bulb) = {ball}; });
  edit("left square moved", [&] { t.scene.find(t.left)->local.translation.z = -0.3f; });
  edit("sky excludes the group", [&] { t.scene.skyLight.leftOut = {t.group}; });
  edit("lamp moved", [&] { t.scene.find(t.lamp)->local.translation.x = -0.6f; });
  edit("lamp lights all", [&] { t.leftOut(t.lamp).clear(); });  // changes the numbers of links
  edit("all lights light all", [&] {
    t.leftOut(t.bulb).clear();
    t.scene.skyLight.leftOut.clear();
  });
}

INSTANTIATE_TEST_SUITE_P(All, LiveLinking,
                         testing::Values(Variant{"naive", "naive", false, "1", true},
                                         Variant{"visibility", "visibility", false, "1", false},
                                         Variant{"light_maps", "light_maps", false, "1", true},
                                         Variant{"low_resolution", "light_maps", false, "4", false},
                                         Variant{"transfer", "light_maps", true, "1", false},
                                         Variant{"reflecting", "light_maps", true, "1", false, 4}),
                         [](const auto& i) { return std::string(i.param.name); });

// All techniques give nearly the picture of the path tracer.
TEST(LightLinking, MethodsAgree) {
  Tiles t;
  t.leftOut(t.lamp) = {t.left, t.box};
  t.scene.sky = vec3(0.2f, 0.3f, 0.4f);
  t.scene.skyLight.leftOut = {t.right};
  const Image reference = test::renderReference(t.scene, t.view, 400, 2);
  const auto blockMeans = [](const Image& image) { return averageBlocks(image, 4); };
  for (const char* technique : {"naive", "visibility", "light_maps"}) {
    Settings s = manyLights(technique, false);
    s.set("vpls", 2048);
    s.set("antialias", 4);
    s.set("bias_compensation", true);
    const Image picture = test::freshPicture(makeCpuBackend(), t.scene, t.view, s);
    const Metrics m = compareImages(blockMeans(picture), blockMeans(reference));
    EXPECT_LT(m.relRmse, 0.05) << technique;
    EXPECT_NEAR(m.bias, 1.0, 0.02) << technique;
  }
  // Verifies that linking changes the picture.
  Tiles plain;
  plain.scene.sky = t.scene.sky;
  const Metrics other = compareImages(blockMeans(test::renderReference(plain.scene, t.view, 64, 2)),
                                      blockMeans(reference));
  EXPECT_GT(other.relRmse, 0.3);
}

// If all light paths end on excluded objects, there is no indirect light.
TEST(LightLinking, ExcludedObjectsReflectNoneOfTheLight) {
  Tiles t;
  std::erase_if(t.scene.nodes, [&](const Node& n) { return n.id == t.bulb; });
  t.leftOut(t.lamp) = {t.left, t.right, t.group};
  const RenderScene render = test::renderSceneOf(t.scene);
  const RayCaster rays(render);
  const VplSet set = generateVpls(render, rays, LightSet(render), {200, 0.5f, 2, 1});
  ASSERT_FALSE(set.vpls.empty());
  for (const SceneVpl& v : set.vpls) {
    EXPECT_EQ(v.id.bounce, 0u);
    EXPECT_EQ(v.vpl.footprint.y, 1.0f);
  }
  EXPECT_EQ(test::meanOf(
                test::renderReference(t.scene, test::lookAt(vec3(0, 2, 3), vec3(0), 16, 8), 8, 2)),
            vec3(0.0f));
}

TEST(LightLinking, IsSavedByNodeIndex) {
  const test::TemporaryFolder folder;
  Tiles t;
  t.leftOut(t.lamp) = {t.left, t.group};
  t.scene.skyLight.leftOut = {t.box};
  saveGltf(t.scene, folder.path() / "s.gltf");
  Scene loaded = loadGltf(folder.path() / "s.gltf").scene;
  EXPECT_EQ(lightLinks(loaded).count, 2u);
  const auto names = [](const Scene& scene, const std::vector<NodeId>& ids) {
    std::vector<int> meshes;
    for (const NodeId id : ids) meshes.push_back(scene.find(id)->mesh);
    return meshes;
  };
  const auto lampOf = [](Scene& scene) -> Node& {
    return *std::find_if(scene.nodes.begin(), scene.nodes.end(),
                         [](const Node& n) { return n.area.has_value(); });
  };
  EXPECT_EQ(lampOf(loaded).light.leftOut.size(), 2u);
  EXPECT_EQ(names(loaded, loaded.skyLight.leftOut), std::vector<int>{t.scene.find(t.box)->mesh});
  // Removing a node changes the indices of the nodes behind it.
  const int box = t.scene.find(t.box)->mesh;
  std::erase_if(loaded.nodes, [](const Node& n) { return n.mesh == 0; });
  saveGltf(loaded, folder.path() / "less.gltf");
  Scene again = loadGltf(folder.path() / "less.gltf").scene;
  EXPECT_EQ(lampOf(again).light.leftOut.size(), 1u);
  ASSERT_EQ(again.skyLight.leftOut.size(), 1u);
  EXPECT_EQ(again.find(again.skyLight.leftOut[0])->mesh, box);

  std::ifstream in(folder.path() / "s.gltf");
  std::string text((std::istreambuf_iterator<char>(in)), {});
  const size_t at = text.find("leaves_out");
  ASSERT_NE(at, std::string::npos);
  const size_t open = text.find('[', at);
  text.replace(open, text.find(']', open) + 1 - open, "[999]");
  std::ofstream(folder.path() / "bad.gltf") << text;
  EXPECT_THROW(loadGltf(folder.path() / "bad.gltf"), InputError);
}

}  // namespace
}  // namespace lamplighter
