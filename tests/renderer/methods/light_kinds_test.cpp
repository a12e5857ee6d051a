// Every kind of light as a source of VPLs: the refined picture of many_lights against the path
// tracer, for a floor with a box under the open sky. Means over blocks of 4 × 4 pixels are
// compared, because pixel edges and the shadow borders of map texels do not change how much light
// there is.
#include <array>
#include <cmath>
#include <ostream>

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/average_blocks.h"
#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/light_picture.h"
#include "tests/support/render.h"
#include "tests/support/scenes/scenes.h"
#include "tests/support/scenes/skies.h"

namespace lamplighter {
namespace {

struct Kind {
  const char* name;
  void (*add)(Scene&);
  double mostError =
      0.03;  // the largest errors come from the texels of the spot light's single map
};
void PrintTo(const Kind& k, std::ostream* out) { *out << k.name; }

NodeId punctual(Scene& scene, const PunctualLight& light, const vec3& at, float tilt) {
  const NodeId id = test::addNode(scene, "light", kNoNode, at);
  scene.find(id)->local.rotation = glm::angleAxis(-0.5f * kPi + tilt, vec3(1, 0, 0));
  scene.find(id)->punctual = light;
  return id;
}

// A square that emits downwards, with a texture that is bright in one corner only.
void addTextured(Scene& scene) {
  auto image = std::make_shared<Image8>(4, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      const bool bright = x < 2 && y < 2;
      const std::array<uint8_t, 4> texel{uint8_t(bright ? 255 : 60), uint8_t(bright ? 230 : 60),
                                         uint8_t(bright ? 180 : 90), 255};
      std::copy(texel.begin(), texel.end(), image->at(x, y));
    }
  }
  scene.textures.push_back({"bright corner", image, Wrap::clamp, Wrap::clamp, true, false});
  const int glow = test::addMaterial(scene, vec3(0.0f), vec3(8.0f));
  scene.materials[static_cast<size_t>(glow)].emissiveTexture.texture = 0;
  const NodeId id = test::addMesh(scene, test::squareMesh(2.0f, glow), vec3(0.5f, 3, 0));
  scene.find(id)->local.rotation = glm::angleAxis(kPi, vec3(0, 0, 1));
}

// The same as a picture on an area light, whose bright corner is the far left one.
void addPictured(Scene& scene) {
  Image8 image(4, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = uint8_t(x < 2 && y < 2 ? 255 - 40 * c : 70);
  const NodeId id = test::addRectangleLight(scene, vec3(0.5f, 3, 0), vec2(2, 1.5f), vec3(12));
  std::string why;
  scene.find(id)->area->picture = decodeLightPicture(
      std::make_shared<const std::vector<uint8_t>>(encodePng(image)), "corner.png", why);
}

void addGlowingBall(Scene& scene) {
  const int glow = test::addMaterial(scene, vec3(0.0f), vec3(8, 6, 4));
  test::addMesh(scene, test::sphereMesh(0.4f, 12, 0.0f, glow), vec3(1, 2.5f, 0.5f));
}

// A batwing profile: most light at 45°, more along X. The live picture approximates it by lobes.
void addProfiled(Scene& scene) {
  const auto profile = parseIes(
      "TILT=NONE\n1 1000 1 10 3 1 2 0 0 0 1 1 60\n"
      "0 10 20 30 40 50 60 70 80 90\n0 45 90\n"
      "200 230 300 420 500 470 300 120 30 0\n200 225 280 370 430 390 240 90 20 0\n"
      "200 220 260 320 350 300 180 60 10 0\n",
      "batwing.ies");
  PunctualLight light{PunctualKind::point, vec3(20, 18, 16)};
  light.profile = profile;
  punctual(scene, light, vec3(0.8f, 2.2f, 0.8f), 0.1f);
}

const Kind kKinds[] = {
    {"tube",
     [](Scene& s) {
       const NodeId id = test::addNode(s, "tube", kNoNode, vec3(0.5f, 2.5f, 0.4f));
       s.find(id)->area = AreaLight{AreaShape::tube, vec3(30, 27, 24), vec2(1.5f, 0.1f)};
     }},
    {"disk",
     [](Scene& s) {
       const NodeId id = test::addRectangleLight(s, vec3(0.5f, 3, 0), vec2(1, 1), vec3(20));
       s.find(id)->area->shape = AreaShape::disk;
     }},
    {"profile", addProfiled, 0.12},  // limited by the approximation by lobes
    {"point",
     [](Scene& s) {
       punctual(s, {PunctualKind::point, vec3(9, 8, 7)}, vec3(1, 2.5f, 1), 0.0f);
     }},
    {"spot",
     [](Scene& s) {
       punctual(s, {PunctualKind::spot, vec3(20, 18, 16), 0.0f, 0.4f, 0.8f}, vec3(0.5f, 3, 0.5f),
                0.2f);
     }},
    {"sun",
     [](Scene& s) {
       punctual(s, {PunctualKind::directional, vec3(3, 2.8f, 2.5f)}, vec3(0), 0.6f);
     }},
    {"area",
     [](Scene& s) { test::addRectangleLight(s, vec3(0.5f, 3, 0), vec2(1, 0.6f), vec3(20)); }},
    {"mesh", addGlowingBall},
    {"textured", addTextured},
    {"picture", addPictured},
    {"constant_sky", [](Scene& s) { s.sky = vec3(0.6f, 0.7f, 0.9f); }},
    {"gradient_sky", [](Scene& s) { s.sky = test::gradientSky(); }},
    {"image_sky", [](Scene& s) { s.sky = test::cloudySky(); }},
    {"image_sky_with_sun", [](Scene& s) { s.sky = test::sunnySky(); }},
};

class LightKinds : public testing::TestWithParam<Kind> {};

TEST_P(LightKinds, AgreeWithThePathTracer) {
  Scene scene;
  const int white = test::addMaterial(scene, vec3(0.7f, 0.65f, 0.6f));
  test::addMesh(scene, test::squareMesh(8.0f, white));
  test::addMesh(scene, test::boxMesh(vec3(1), white), vec3(-0.8f, 0.5f, -0.5f));
  GetParam().add(scene);
  const View view = test::lookAt(vec3(1.5f, 2.2f, 4.5f), vec3(0), 96, 64, 0.75f);

  Settings settings;
  settings.set("vpls", 512);
  settings.set("bounces", 1);
  settings.set("indirect", std::string("samples"));
  settings.set("updates", 4096);
  settings.set("antialias", 4);
  settings.set("refine", 8192);
  settings.set("repair", 0);
  FrameRenderer renderer(makeCpuBackend());
  GiOutput out;
  SceneChanges changes = SceneChanges::all();
  for (int frame = 0; frame < 2000 && !(out.settled && out.refined); ++frame) {
    out = renderer.render(
        {scene, changes, view, "many_lights", settings, false, {.refineUpdates = 4096}});
    changes = {};
  }
  ASSERT_TRUE(out.settled && out.refined);
  const Image reference = test::renderReference(scene, view, 256, 1);
  const Image& picture = out.radiance->pixels();
  const Metrics m = compareImages(averageBlocks(picture, 4), averageBlocks(reference, 4));
  RecordProperty("relRmse", std::to_string(m.relRmse));
  RecordProperty("bias", std::to_string(m.bias));
  EXPECT_LT(m.relRmse, GetParam().mostError);
  EXPECT_NEAR(m.bias, 1.0, 0.01);
}

INSTANTIATE_TEST_SUITE_P(All, LightKinds, testing::ValuesIn(kKinds),
                         [](const auto& i) { return std::string(i.param.name); });

// A sun has many maps, each of a tile of what the camera sees. In the first frame there are all,
// however few updates a frame may do: without one of them a part of the picture would be dark.
TEST(Sun, LightsTheWholeFirstPicture) {
  Scene scene;
  const int white = test::addMaterial(scene, vec3(0.7f));
  test::addMesh(scene, test::squareMesh(30.0f, white));
  test::addMesh(scene, test::boxMesh(vec3(1), white), vec3(-0.8f, 0.5f, -0.5f));
  punctual(scene, {PunctualKind::directional, vec3(3)}, vec3(0), 0.6f);
  const View view = test::lookAt(vec3(1.5f, 3.0f, 6.0f), vec3(0), 96, 64, 0.75f);
  Settings settings;
  settings.set("updates", 4);
  settings.set("bounces", 0);
  FrameRenderer renderer(makeCpuBackend());
  SceneChanges changes = SceneChanges::all();
  const Image first =
      renderer.render({scene, changes, view, "many_lights", settings}).radiance->pixels();
  const Image reference = test::renderReference(scene, view, 64, 0);
  EXPECT_LT(compareImages(averageBlocks(first, 8), averageBlocks(reference, 8)).relRmse, 0.15);
}

}  // namespace
}  // namespace lamplighter
