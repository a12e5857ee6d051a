// Debug views of a small level whose visibility is known: a plate below a small lamp, and floors in
// its umbra, half in its shadow, and outside its shadow.
#include "renderer/debug_views/view_picture.h"

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/base/error.h"
#include "renderer/base/threads.h"
#include "renderer/debug_views/view_colours.h"
#include "renderer/frame/frame.h"
#include "renderer/image/tone_map.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

namespace colours = view_colours;

// Not at the centres, where patches may be divided.
constexpr vec3 kHidden{0.25f, 0.0f, 0.25f}, kHalf{2.95f, 0.0f, 0.25f}, kOpen{6.25f, 0.0f, 0.25f};
constexpr vec3 kPlateSide{0.5f, 1.0f, 2.0f};
constexpr vec3 kAlbedo{0.6f, 0.5f, 0.4f};

class Views : public testing::Test {
 protected:
  Views() {
    const int grey = test::addMaterial(scene_, kAlbedo);
    hidden_ = test::addMesh(scene_, test::squareMesh(1.5f, grey));
    half_ = test::addMesh(scene_, test::squareMesh(1.5f, grey), vec3(2.7f, 0, 0));
    open_ = test::addMesh(scene_, test::squareMesh(1.5f, grey), vec3(6, 0, 0));
    plate_ = test::addMesh(scene_, test::boxMesh(vec3(4.0f, 0.4f, 4.0f), grey), vec3(0, 1, 0));
    test::addRectangleLight(scene_, vec3(0, 4, 0), vec2(0.2f), vec3(100.0f));
    settings_.set("technique", std::string("light_maps"));
    settings_.set("vpls", 24);
    settings_.set("indirect", std::string("samples"));
    settings_.set("map_resolution", 16);
    settings_.set("antialias", 1);
    settings_.set("light_map_texel", 0.5f);
  }

  void settle(const SceneChanges& changes = SceneChanges::all()) {
    test::renderSettled(renderer_, scene_, changes, view_, settings_);
  }
  ViewPicture draw(DebugView view, int light = 0, float exposure = 0.0f) {
    const Inspection inspection = renderer_.inspect();
    return drawView(view,
                    {renderer_.scene(), *renderer_.rays(), view_, inspection, light, exposure});
  }
  vec3 colourAt(const ViewPicture& picture, const vec3& world) const {
    const vec3 p = view_.project(world);
    if (!(p.x >= 0.0f && p.x < static_cast<float>(view_.width) && p.y >= 0.0f &&
          p.y < static_cast<float>(view_.height) && p.z > 0.0f)) {
      ADD_FAILURE() << "not in the picture";
      return vec3(0.0f);
    }
    const uint8_t* c = picture.image.at(static_cast<int>(p.x), static_cast<int>(p.y));
    return vec3(c[0], c[1], c[2]) / 255.0f;
  }
  uint32_t objectOf(NodeId node) {
    const auto& objects = renderer_.scene().objects;
    for (uint32_t i = 0; i < objects.size(); ++i)
      if (objects[i].node == node) return i;
    ADD_FAILURE();
    return 0;
  }

  Scene scene_;
  NodeId hidden_ = 0, half_ = 0, open_ = 0, plate_ = 0;
  View view_ = test::lookAt(vec3(3, 0.75f, 5), vec3(3, 0.75f, 0), 640, 300);
  Settings settings_;
  FrameRenderer renderer_{makeCpuBackend()};
};

// The colour is that of the legend up to brightness, which depends on the light at the camera.
testing::AssertionResult isHue(const vec3& seen, const vec3& legend) {
  const float cosine = glm::dot(glm::normalize(seen), glm::normalize(legend));
  const float brightness = glm::length(seen) / glm::length(legend);
  if (cosine > 0.9995f && brightness > 0.55f && brightness < 1.02f)
    return testing::AssertionSuccess();
  return testing::AssertionFailure() << seen.r << " " << seen.g << " " << seen.b << " is no "
                                     << legend.r << " " << legend.g << " " << legend.b;
}

TEST_F(Views, OcclusionShowsTheStatesOfTheSelectedLight) {
  settle();
  const Inspection inspection = renderer_.inspect();
  ASSERT_EQ(inspection.lights.front().id.bounce, 0u);
  const ViewPicture picture = draw(DebugView::occlusion);
  EXPECT_EQ(picture.problem, "");
  EXPECT_TRUE(isHue(colourAt(picture, kOpen), colours::kNone));
  EXPECT_TRUE(isHue(colourAt(picture, kHalf), colours::kPartial));
  EXPECT_TRUE(isHue(colourAt(picture, kHidden), colours::kFull));
  EXPECT_TRUE(isHue(colourAt(picture, kPlateSide), colours::kAway));
  EXPECT_EQ(colourAt(picture, vec3(4.5f, 2.2f, 0)).r,
            std::round(colours::kBackground.r * 255) / 255);
  EXPECT_EQ(picture.legend.swatches.size(), 4u);
}

TEST_F(Views, OcclusionFollowsTheSelectedLight) {
  settle();
  const auto lights = renderer_.inspect().lights;
  const auto bounce = std::find_if(lights.begin(), lights.end(), [](const LightSample& l) {
    return l.id.bounce > 0 && l.vpl.normal.y > 0.5f;  // faces away from all lower surfaces
  });
  ASSERT_NE(bounce, lights.end());
  const ViewPicture picture = draw(DebugView::occlusion, static_cast<int>(bounce - lights.begin()));
  EXPECT_TRUE(isHue(colourAt(picture, kOpen), colours::kAway));
}

TEST_F(Views, PatchesHaveDifferentColoursWithDarkBorders) {
  settle();
  const ViewPicture picture = draw(DebugView::patches);
  const vec3 open = colourAt(picture, kOpen), half = colourAt(picture, kHalf);
  EXPECT_GT(glm::length(glm::normalize(open) - glm::normalize(half)), 0.05f);
  EXPECT_TRUE(isHue(colourAt(picture, kOpen + vec3(0.1f, 0, -0.1f)), open));
  // The border of a patch is darker. It lies in the last row of the front edge.
  const vec3 p = view_.project(vec3(6.25f, 0, 0.75f));
  bool darker = false;
  for (int y = -2; y <= 2; ++y)
    darker |=
        picture.image.at(static_cast<int>(p.x), static_cast<int>(p.y) + y)[1] < 0.7f * 255 * open.g;
  EXPECT_TRUE(darker);
}

TEST_F(Views, LevelsCountSubdivisions) {
  settle();
  const ViewPicture picture = draw(DebugView::patchLevels);
  const auto levelAt = [&](NodeId node, const vec3& at) {
    const auto known = renderer_.inspect().patches;
    const uint32_t object = objectOf(node);
    return known->shapeOf(object, known->patchOf(object, known->leafAt(object, 0, at))).level;
  };
  ASSERT_EQ(levelAt(open_, kOpen), 0);
  EXPECT_TRUE(isHue(colourAt(picture, kOpen), colours::ramp(0.0f)));
  ASSERT_GT(levelAt(half_, kHalf), 0);
  EXPECT_TRUE(isHue(colourAt(picture, kHalf), colours::ramp(1.0f)));
  EXPECT_EQ(picture.legend.low, "0 times");
}

TEST_F(Views, PartialLightsAreCounted) {
  settle();
  const ViewPicture picture = draw(DebugView::partialLights);
  const Inspection inspection = renderer_.inspect();
  const auto count = [&](NodeId node, const vec3& at) {
    const uint32_t object = objectOf(node);
    const int leaf = inspection.patches->leafAt(object, 0, at);
    int partial = 0;
    for (const LightSample& light : inspection.lights)
      partial += inspection.patches->state(object, leaf, light.vpl.slot) == Occlusion::partial;
    return partial;
  };
  const int half = count(half_, kHalf), open = count(open_, kOpen);
  EXPECT_GT(half, open);
  const std::string& high = picture.legend.high;  // "N of M"
  const float most = std::stof(high);
  EXPECT_EQ(high, std::to_string(static_cast<int>(most)) + " of " +
                      std::to_string(inspection.lights.size()));
  EXPECT_TRUE(isHue(colourAt(picture, kHalf), colours::ramp(static_cast<float>(half) / most)));
  EXPECT_TRUE(isHue(colourAt(picture, kOpen), colours::ramp(static_cast<float>(open) / most)));
}

TEST_F(Views, LightMapsShowTheirIrradiance) {
  settle();
  constexpr float kExposure = 1.5f;
  const ViewPicture picture = draw(DebugView::lightMaps, 0, kExposure);
  const Inspection inspection = renderer_.inspect();
  const uint32_t object = objectOf(open_);
  // The point at which the pixel's ray hits the floor.
  const vec3 pixel = glm::floor(view_.project(kOpen)) + 0.5f;
  const vec3 direction = view_.rayDirection(pixel.x, pixel.y);
  const vec3 at = view_.eye - view_.eye.y / direction.y * direction;
  ASSERT_TRUE(inspection.texels->gridAt(object, 0, at).has_value());
  const vec3 e = inspection.texels->irradianceAt(object, 0, at);
  const vec3 expected = toneMapPixel(e / kPi, kExposure), seen = colourAt(picture, kOpen);
  EXPECT_GT(expected.g, 0.05f);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 1.0f / 255.0f);
}

TEST_F(Views, LightMapsShowTheirTexels) {
  settings_.set("light_map_texel", 0.25f);
  view_ = test::lookAt(vec3(6.25f, 1.5f, 0.26f), kOpen, 200, 200);
  settle();
  const ViewPicture picture = draw(DebugView::lightMaps, 0, 1.5f);
  // Texels every 0.25 m, starting at the corner at 5.25.
  const vec3 on = colourAt(picture, vec3(6.25f, 0, 0.125f)),
             beside = colourAt(picture, vec3(6.375f, 0, 0.125f));
  EXPECT_GT(glm::length(on - beside), 0.1f * glm::length(beside));
}

TEST_F(Views, MapAgeIsThatOfPendingLights) {
  settle();
  const vec3 settled = colourAt(draw(DebugView::mapAge), kOpen);
  EXPECT_TRUE(isHue(settled, colours::kSettled));

  Scene before = scene_;
  scene_.find(plate_)->local.translation.x += 0.1f;
  settings_.set("updates", 1);
  SceneChanges changes = compare(before, scene_);
  int waiting = 0;
  for (int frame = 0; frame < 3; ++frame) {
    const GiOutput out = renderer_.render({scene_, changes, view_, "many_lights", settings_});
    changes = {};
    waiting = static_cast<int>(out.stats.of("oldest_frames"));
  }
  EXPECT_EQ(waiting, 3);
  const ViewPicture picture = draw(DebugView::mapAge);
  EXPECT_FALSE(isHue(colourAt(picture, kOpen), colours::kSettled));
  EXPECT_EQ(picture.legend.high, "5 frames");
  // All but three of the lamp's samples are three frames old, so nearly all light is.
  const vec3 seen = glm::normalize(colourAt(picture, kOpen));
  float best = 0.0f, age = 0.0f;
  for (float t = 0.0f; t <= 1.0f; t += 0.01f) {
    const float cosine = glm::dot(seen, glm::normalize(colours::ramp(glm::mix(0.35f, 1.0f, t))));
    if (cosine > best) best = cosine, age = 5.0f * t;
  }
  EXPECT_GT(age, 1.5f);
  EXPECT_LT(age, 3.01f);

  settings_.set("updates", 100);
  settle({});
  EXPECT_TRUE(isHue(colourAt(draw(DebugView::mapAge), kOpen), colours::kSettled));
}

TEST_F(Views, AlbedoNormalsAndFlatShading) {
  settle();
  const vec3 albedo = colourAt(draw(DebugView::albedo), kOpen);
  const vec3 normal = colourAt(draw(DebugView::normals), kOpen);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(albedo[c], encodeSrgb(kAlbedo[c]), 1.0f / 255.0f);
    EXPECT_NEAR(normal[c], c == 1 ? 1.0f : 0.5f, 1.0f / 255.0f);
  }
  // The light is at the camera, so surfaces that face it are brighter.
  const ViewPicture flat = draw(DebugView::flat);
  EXPECT_GT(colourAt(flat, kPlateSide).g, colourAt(flat, kOpen).g);
  EXPECT_LE(colourAt(flat, kPlateSide).g, encodeSrgb(kAlbedo.g) + 1.0f / 255.0f);
}

TEST_F(Views, SameBitsAtAnyNumberOfThreads) {
  settle();
  scene_.find(plate_)->local.translation.x += 0.1f;
  settings_.set("updates", 1);
  renderer_.render({scene_, SceneChanges::all(), view_, "many_lights", settings_});
  for (const DebugViewInfo& info : debugViews()) {
    if (isRadiance(info.view)) continue;
    SCOPED_TRACE(info.name);
    std::vector<uint8_t> first;
    for (const int threads : {1, 2, 3}) {
      const ThreadLimit limit(threads);
      const ViewPicture picture = draw(info.view);
      if (first.empty()) first = picture.image.pixels;
      EXPECT_EQ(picture.image.pixels, first) << threads;
    }
  }
}

TEST_F(Views, NameTheRequirementThatIsMissing) {
  settings_.set("technique", std::string("naive"));
  settle();
  const auto flat = draw(DebugView::flat).image.pixels;
  for (const DebugView view : {DebugView::patches, DebugView::patchLevels, DebugView::occlusion,
                               DebugView::partialLights, DebugView::lightMaps}) {
    SCOPED_TRACE(infoOf(view).name);
    const ViewPicture picture = draw(view);
    EXPECT_NE(picture.problem.find("technique"), std::string::npos);
    EXPECT_EQ(picture.image.pixels, flat);
    EXPECT_TRUE(picture.legend.empty());
  }
  EXPECT_EQ(draw(DebugView::mapAge).problem, "");
  settings_.set("technique", std::string("visibility"));
  settle({});
  EXPECT_EQ(draw(DebugView::occlusion).problem, "");
  EXPECT_NE(draw(DebugView::lightMaps).problem, "");

  Settings few;
  few.set("samples_per_pixel", 1);
  renderer_.render({scene_, {}, view_, "reference", few});
  EXPECT_NE(draw(DebugView::mapAge).problem, "");
}

TEST_F(Views, LightOnlyIsThePictureOfWhiteSurfaces) {
  for (const std::string method : {"many_lights", "reference"}) {
    SCOPED_TRACE(method);
    settings_.set("samples_per_pixel", 4);
    settings_.set("samples_per_frame", 4);
    Image pictures[2];
    for (const bool lightOnly : {false, true}) {
      GiOutput out;
      do {
        out = renderer_.render({scene_, {}, view_, method, settings_, lightOnly});
      } while (!out.settled);
      pictures[lightOnly] = out.radiance->pixels();
    }
    const vec3 p = view_.project(kOpen);
    const auto at = [&](int i) {
      return pictures[i].at(static_cast<int>(p.x), static_cast<int>(p.y));
    };
    EXPECT_GT(at(1).g, 0.0f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(at(0)[c] / at(1)[c], kAlbedo[c], 1e-4f);
  }
}

TEST(DebugViews, AreFoundByName) {
  for (const DebugViewInfo& info : debugViews()) {
    EXPECT_EQ(findDebugView(info.name).view, info.view);
    EXPECT_EQ(&infoOf(info.view), &findDebugView(info.name));
  }
  try {
    findDebugView("colour");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("light_only"), std::string::npos) << e.what();
  }
}

TEST(ViewColours, NiceMaximaAreNotLessThanTheValue) {
  for (const auto& [value, nice] :
       {std::pair{0, 1}, {1, 1}, {3, 5}, {7, 10}, {10, 10}, {11, 20}, {299, 500}})
    EXPECT_EQ(colours::niceMaximum(value), nice);
}

}  // namespace
}  // namespace lamplighter
