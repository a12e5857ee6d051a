// Direct and indirect light: each part contains only its own light, and both add up to the lit
// picture.
#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame/frame.h"
#include "tests/support/render.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

struct Case {
  const char *name, *method, *technique;
  double tolerance;  // relative to the mean of the lit picture, for every pixel
};

// A room with a lamp, a box and a glossy ball.
Scene room() {
  Scene scene;
  const int red = test::addMaterial(scene, vec3(0.7f, 0.3f, 0.2f));
  const int grey = test::addMaterial(scene, vec3(0.6f));
  const int gloss = test::addMaterial(scene, vec3(0.5f));
  scene.materials[static_cast<size_t>(gloss)].roughness = 0.4f;
  test::addMesh(scene, test::roomMesh(vec3(5, 3, 5), red), vec3(0, 1.5f, 0));
  test::addMesh(scene, test::boxMesh(vec3(1.0f), grey), vec3(-0.7f, 0.5f, 0));
  test::addMesh(scene, test::sphereMesh(0.4f, 10, 0.0f, gloss), vec3(0.8f, 0.4f, 0.5f));
  test::addRectangleLight(scene, vec3(0, 2.9f, 0), vec2(0.8f), vec3(10.0f));
  return scene;
}

class LightParts : public testing::TestWithParam<Case> {
 protected:
  Image settled(LightPart part) {
    GiOutput out;
    for (int i = 0; i < 60; ++i) {
      out = renderer_.render({scene_,
                              i == 0 && first_ ? SceneChanges::all() : SceneChanges(),
                              view_,
                              GetParam().method,
                              settings_,
                              false,
                              {},
                              part});
      first_ = false;
      if (out.settled) break;
    }
    EXPECT_TRUE(out.settled);
    return out.radiance->pixels();
  }
  void SetUp() override {
    settings_.set("vpls", 60);
    settings_.set("bounces", 2);
    settings_.set("map_resolution", 32);
    settings_.set("antialias", 2);
    settings_.set("samples_per_pixel", 8);
    // Bias compensation uses random rays that differ between the parts.
    settings_.set("bias_compensation", false);
    settings_.set("share_memory", 0);  // jitters of a part share other pixels than those of all
    settings_.set("block", std::string("1"));
    if (GetParam().technique[0] != 0) settings_.set("technique", std::string(GetParam().technique));
  }

  Scene scene_ = room();
  View view_ = test::lookAt(vec3(0.5f, 1.6f, 2.3f), vec3(0, 0.8f, 0), 48, 32, 1.1f);
  Settings settings_;
  FrameRenderer renderer_{makeCpuBackend()};
  bool first_ = true;
};

TEST_P(LightParts, AddUpToTheLitPicture) {
  const Image lit = settled(LightPart::all);
  const Image direct = settled(LightPart::direct), indirect = settled(LightPart::indirect);
  const double mean = static_cast<double>(luminance(test::meanOf(lit)));
  EXPECT_GT(luminance(test::meanOf(direct)), 0.1 * mean);
  EXPECT_GT(luminance(test::meanOf(indirect)), 0.05 * mean);
  double worst = 0.0;
  for (size_t i = 0; i < lit.pixels.size(); ++i) {
    const vec3 sum = direct.pixels[i] + indirect.pixels[i];
    for (int c = 0; c < 3; ++c)
      worst = std::max(worst, std::abs(static_cast<double>(sum[c] - lit.pixels[i][c])));
  }
  EXPECT_LT(worst, GetParam().tolerance * mean);
  // After switching back, the picture is the same as before.
  EXPECT_EQ(settled(LightPart::all).pixels, lit.pixels);
}

TEST_P(LightParts, WithoutBouncesAllIsDirect) {
  settings_.set("bounces", 0);
  const Image lit = settled(LightPart::all), direct = settled(LightPart::direct);
  const Image indirect = settled(LightPart::indirect);
  const float mean = luminance(test::meanOf(lit));
  EXPECT_NEAR(luminance(test::meanOf(direct)), mean, 1e-5f * mean);
  EXPECT_NEAR(luminance(test::meanOf(indirect)), 0.0f, 1e-5f * mean);
}

// The lamp faces down, so the ceiling gets only indirect light.
TEST_P(LightParts, TheCeilingHasNoDirectLight) {
  view_ = test::lookAt(vec3(0, 1.0f, 1.0f), vec3(0, 3.0f, -1.6f), 16, 12, 0.3f);
  EXPECT_EQ(luminance(test::meanOf(settled(LightPart::direct))), 0.0f);
  EXPECT_GT(luminance(test::meanOf(settled(LightPart::indirect))), 0.0f);
}

INSTANTIATE_TEST_SUITE_P(Methods, LightParts,
                         testing::Values(Case{"naive", "many_lights", "naive", 1e-4},
                                         Case{"visibility", "many_lights", "visibility", 1e-4},
                                         // Light maps clamp the irradiance of each part to zero
                                         // after they subtract shadows.
                                         Case{"light_maps", "many_lights", "light_maps", 4e-3},
                                         Case{"reference", "reference", "", 1e-4}),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace lamplighter
