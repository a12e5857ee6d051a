// Debug views of stored light data: counts per patch, false colour, a shadow map, the mask of the
// low-resolution pass. The scene is a floor below a plate and a lamp, and a second floor beside it.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/debug_views/view_colours.h"
#include "renderer/debug_views/view_picture.h"
#include "renderer/frame/frame.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

namespace colours = view_colours;

constexpr vec3 kHidden{0.25f, 0.0f, 0.25f}, kOpen{6.25f, 0.0f, 0.25f}, kPlateSide{0.5f, 1.0f, 2.0f};
constexpr float kRadiance = 100.0f, kSide = 0.2f, kHeight = 4.0f;

class EngineViews : public testing::Test {
 protected:
  EngineViews() {
    const int black = test::addMaterial(scene_, vec3(0.0f));
    test::addMesh(scene_, test::squareMesh(1.0f, black));
    test::addMesh(scene_, test::squareMesh(1.0f, black), vec3(6, 0, 0));
    test::addMesh(scene_, test::boxMesh(vec3(4.0f, 0.4f, 4.0f), black), vec3(0, 1, 0));
    lamp_ = test::addRectangleLight(scene_, vec3(0, kHeight, 0), vec2(kSide), vec3(kRadiance));
    settings_.set("technique", std::string("light_maps"));
    settings_.set("vpls", 24);
    settings_.set("map_resolution", 16);
    settings_.set("antialias", 1);
    settings_.set("light_map_texel", 0.25f);
  }
  void settle(bool lightOnly = false) {
    for (int i = 0; i < 40; ++i) {
      out_ = renderer_.render({scene_, i == 0 && !started_ ? SceneChanges::all() : SceneChanges(),
                               view_, "many_lights", settings_, lightOnly});
      started_ = true;
      if (out_.settled) return;
    }
    FAIL() << "not settled";
  }
  ViewPicture draw(DebugView view, FalseColour f = {}) {
    const Inspection inspection = renderer_.inspect();
    ViewSubject subject{renderer_.scene(), *renderer_.rays(), view_, inspection};
    subject.chosenNode = lamp_;
    subject.falseColour = f;
    takeFromBackend(view, renderer_.backend(), *out_.radiance, subject);
    return drawView(view, subject);
  }
  vec3 colourAt(const ViewPicture& picture, const vec3& world) const {
    const vec3 p = view_.project(world);
    const uint8_t* c = picture.image.at(static_cast<int>(p.x), static_cast<int>(p.y));
    return vec3(c[0], c[1], c[2]) / 255.0f;
  }

  Scene scene_;
  NodeId lamp_ = 0;
  View view_ = test::lookAt(vec3(3, 0.75f, 5), vec3(3, 0.75f, 0), 640, 300);
  Settings settings_;
  FrameRenderer renderer_{makeCpuBackend()};
  GiOutput out_;
  bool started_ = false;
};

testing::AssertionResult isHue(const vec3& seen, const vec3& legend) {
  if (glm::dot(glm::normalize(seen), glm::normalize(legend)) > 0.9995f)
    return testing::AssertionSuccess();
  return testing::AssertionFailure() << seen.r << " " << seen.g << " " << seen.b << " is no "
                                     << legend.r << " " << legend.g << " " << legend.b;
}

// Unshadowed illuminance of the small lamp [lx].
float irradianceAt(const vec3& x) {
  const vec3 d = vec3(0, kHeight, 0) - x;
  const float d2 = glm::dot(d, d);
  return kRadiance * kSide * kSide * d.y * d.y / (d2 * d2);
}

TEST_F(EngineViews, FalseColourIsIlluminanceByItsLegend) {
  settle(true);
  const FalseColour range{true, 1e-3f, 1.0f};
  const ViewPicture picture = draw(DebugView::falseColour, range);
  EXPECT_EQ(picture.problem, "");
  const float t = std::log(irradianceAt(kOpen) / 1e-3f) / std::log(1e3f);
  EXPECT_LT(glm::length(colourAt(picture, kOpen) - colours::ramp(t)), 0.02f);
  EXPECT_LT(glm::length(colourAt(picture, kHidden) - colours::ramp(0.0f)), 0.01f);
  ASSERT_EQ(picture.legend.ticks.size(), 4u);  // one per decade
  EXPECT_EQ(picture.legend.ticks.front().second, "0.001");
  EXPECT_EQ(picture.legend.ticks.back().second, "1");
  EXPECT_EQ(picture.legend.title, "Illuminance [lx]");
  // Without a given range, the range is found from the picture.
  const ViewPicture automatic = draw(DebugView::falseColour);
  EXPECT_FALSE(isHue(colourAt(automatic, kOpen), colours::ramp(0.0f)));
}

TEST_F(EngineViews, FalseColourInNitsIsThePicture) {
  settle();
  const ViewPicture picture = draw(DebugView::falseColour, {false, 0.1f, 1000.0f});
  const float t = std::log(kRadiance / 0.1f) / std::log(1e4f);
  // The lamp from below.
  view_ = test::lookAt(vec3(6, 0.5f, 0), vec3(0, kHeight, 0), 320, 200, 0.2f);
  settle();
  const ViewPicture lamp = draw(DebugView::falseColour, {false, 0.1f, 1000.0f});
  EXPECT_LT(glm::length(colourAt(lamp, vec3(0, kHeight, 0)) - colours::ramp(t)), 0.02f);
  EXPECT_TRUE(picture.legend.swatches.empty());
}

TEST_F(EngineViews, PatchesCountLightsThatReachThem) {
  settle();
  const ViewPicture lights = draw(DebugView::lightsPerPatch);
  EXPECT_EQ(lights.problem, "");
  EXPECT_TRUE(isHue(colourAt(lights, kHidden), colours::ramp(0.0f)));
  // All light samples: the legend ends at 24 of 24.
  EXPECT_TRUE(isHue(colourAt(lights, kOpen), colours::ramp(1.0f)));
  const ViewPicture occlusion = draw(DebugView::lightOcclusion);
  EXPECT_TRUE(isHue(colourAt(occlusion, kOpen), colours::kNone));
  EXPECT_TRUE(isHue(colourAt(occlusion, kHidden), colours::kFull));
  EXPECT_TRUE(isHue(colourAt(occlusion, kPlateSide), colours::kAway));
}

TEST_F(EngineViews, PatchesArePendingOnlyWhileLightsAre) {
  settle();
  EXPECT_TRUE(isHue(colourAt(draw(DebugView::pendingPatches), kOpen), colours::kSettled));
  // A large move of the lamp with one update per frame: nearly all light samples are pending.
  settings_.set("updates", 1);
  scene_.find(lamp_)->local.translation.x = 3.0f;
  out_ = renderer_.render({scene_, SceneChanges::all(), view_, "many_lights", settings_});
  ASSERT_FALSE(out_.settled);
  EXPECT_FALSE(isHue(colourAt(draw(DebugView::pendingPatches), kOpen), colours::kSettled));
}

TEST_F(EngineViews, LightMapDensityIsTheSpacingOfTexels) {
  settle();
  const ViewPicture picture = draw(DebugView::lightMapDensity);
  EXPECT_EQ(picture.problem, "");
  EXPECT_FALSE(isHue(colourAt(picture, kOpen), colours::kNoData));
  const std::string& high = picture.legend.high;
  EXPECT_NE(high.find(" cm"), std::string::npos);
  EXPECT_GE(std::stof(high), 24.0f);  // texels of 0.25 m
  EXPECT_LE(std::stof(high), 100.0f);
}

TEST_F(EngineViews, TheShadowMapIsThatOfTheSelectedSample) {
  settings_.set("technique", std::string("naive"));
  settle();
  const ViewPicture picture = draw(DebugView::shadowMap);
  EXPECT_EQ(picture.problem, "");
  EXPECT_EQ(picture.legend.title, "Shadow map of light sample 0");
  // The texel below the lamp's centre shows the top of the plate; a texel at the rim has no hit.
  const uint8_t* middle = picture.image.at(320, 150);
  const vec3 plate = vec3(middle[0], middle[1], middle[2]) / 255.0f;
  EXPECT_FALSE(isHue(plate, colours::kAway));
  const float farthest = std::stof(picture.legend.low);
  EXPECT_GT(farthest, kHeight - 1.2f);
  EXPECT_LT(farthest, 10.0f);
  const uint8_t* rim = picture.image.at(320 - 130, 150);
  EXPECT_TRUE(isHue(vec3(rim[0], rim[1], rim[2]) / 255.0f, colours::kAway));
}

TEST_F(EngineViews, TheEdgeMaskShowsWhatWasInterpolated) {
  settings_.set("block", std::string("4"));
  settle();
  const ViewPicture picture = draw(DebugView::edgeMask);
  EXPECT_EQ(picture.problem, "");
  size_t between = 0, all = 0;
  auto* kernels = renderer_.backend().kernelsInUse<ManyLightsKernels>();
  ASSERT_NE(kernels, nullptr);
  for (const uint8_t p : kernels->readInterpolated()) {
    const uint8_t* c = picture.image.at(static_cast<int>(all % 640), static_cast<int>(all / 640));
    const vec3 colour = vec3(c[0], c[1], c[2]) / 255.0f;
    if (p != 0) {
      ASSERT_TRUE(isHue(colour, colours::kSettled)) << all;
    }
    between += p;
    ++all;
  }
  ASSERT_EQ(all, size_t{640} * 300);
  EXPECT_NEAR(static_cast<float>(between) / static_cast<float>(all),
              out_.stats.of("interpolated_share"), 0.02f);
  EXPECT_GT(between, 1000u);
  settings_.set("block", std::string("1"));
  settle();
  EXPECT_NE(draw(DebugView::edgeMask).problem, "");
}

TEST_F(EngineViews, TransferObjectsAreMarked) {
  settle();
  EXPECT_NE(draw(DebugView::prtObjects).problem, "");
  test::addMesh(scene_, test::sphereMesh(0.3f, 12), vec3(4, 0.5f, 0.5f));
  settings_.set("prt", true);
  started_ = false;
  settle();
  const ViewPicture picture = draw(DebugView::prtObjects);
  EXPECT_EQ(picture.problem, "");
  EXPECT_TRUE(isHue(colourAt(picture, vec3(4, 0.5f, 0.8f)), colours::kNone));
  EXPECT_TRUE(isHue(colourAt(picture, kOpen), colours::kNoData));
}

}  // namespace
}  // namespace lamplighter
