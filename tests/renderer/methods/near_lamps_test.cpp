// Near a lamp its light is its form factor in closed form, times what is seen of it.
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/image/metrics.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

constexpr float kHeight = 0.25f;  // of the lamp above the floor: less than between its samples

// A large lamp above a white floor, seen from below the lamp.
struct LowLamp {
  Scene scene;
  View view = test::lookAt(vec3(0.0f, 0.22f, 1.4f), vec3(0.0f, 0.0f, 0.3f), 96, 64);
  Settings settings;
  NodeId lamp = kNoNode;

  LowLamp() {
    const int white = test::addMaterial(scene, vec3(0.5f));
    test::addMesh(scene, test::squareMesh(6.0f, white));
    lamp =
        test::addRectangleLight(scene, vec3(0.0f, kHeight, 0.0f), vec2(3.0f, 2.0f), vec3(4, 2, 1));
    settings.set("bounces", 0);
    settings.set("vpls", 48);
    settings.set("antialias", 2);
  }
  Image picture() const { return test::freshPicture(makeCpuBackend(), scene, view, settings); }
  // Without the lamp itself, at the edge of which antialiasing decides.
  Image below() const {
    Image mask(view.width, view.height);
    for (int y = 0; y < view.height; ++y)
      for (int x = 0; x < view.width; ++x) mask.at(x, y).r = rayAt(x, y).y < -0.02f ? 1.0f : 0.0f;
    return mask;
  }
  vec3 rayAt(int x, int y) const {
    return view.rayDirection(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  }
  Image without() {
    settings.set("bias_compensation", false);
    const Image image = picture();
    settings.reset("bias_compensation");
    return image;
  }
};

TEST(NearLamps, GiveTheFormFactor) {
  LowLamp s;
  s.settings.set("antialias", 1);
  s.settings.set("block", std::string("1"));  // interpolation is off by up to 2%
  const Image image = s.picture(), without = s.without();
  const std::vector<vec3> lamp = {vec3(-1.5f, kHeight, -1.0f), vec3(1.5f, kHeight, -1.0f),
                                  vec3(1.5f, kHeight, 1.0f), vec3(-1.5f, kHeight, 1.0f)};
  double worst = 0.0, worstWithout = 0.0;
  int pixels = 0;
  for (int y = 0; y < s.view.height; ++y)
    for (int x = 0; x < s.view.width; ++x) {
      const vec3 way = s.rayAt(x, y);
      if (way.y >= 0.0f) continue;
      const vec3 at = s.view.eye - s.view.eye.y / way.y * way;
      if (std::abs(at.x) > 1.0f || std::abs(at.z) > 0.6f) continue;
      const double truth = 4.0 * 0.5 * std::abs(test::polygonFormFactor(at, vec3(0, 1, 0), lamp));
      worst = std::max(worst, std::abs(image.at(x, y).x / truth - 1.0));
      worstWithout = std::max(worstWithout, std::abs(without.at(x, y).x / truth - 1.0));
      ++pixels;
    }
  EXPECT_GT(pixels, 150);
  EXPECT_LT(worst, 0.005);
  EXPECT_GT(worstWithout, 0.3);
}

TEST(NearLamps, CastSoftShadows) {
  LowLamp s;
  s.settings.set("antialias", 16);
  test::addMesh(s.scene, test::boxMesh(vec3(0.3f, 0.15f, 0.3f)), vec3(0.2f, 0.075f, 0.3f));
  const Image truth = test::renderReference(s.scene, s.view, 256, 0);
  const Image mask = s.below();
  const double with = compareImages(s.picture(), truth, &mask).relRmse,
               without = compareImages(s.without(), truth, &mask).relRmse;
  EXPECT_LT(with, 0.05);
  EXPECT_LT(with, 0.3 * without);
}

// Tubes and spheres have hundreds of triangles.
TEST(NearLamps, AreAlsoRound) {
  LowLamp s;
  s.scene.find(s.lamp)->local.translation.y = 0.4f;  // above the eye, so that it is not below()
  for (const AreaShape shape : {AreaShape::tube, AreaShape::sphere}) {
    AreaLight& light = *s.scene.find(s.lamp)->area;
    light.shape = shape;
    light.size = vec2(shape == AreaShape::tube ? 2.0f : 0.3f, 0.2f);
    s.settings.set("antialias", 16);
    const Image truth = test::renderReference(s.scene, s.view, 1024, 0);
    const Image mask = s.below();
    const double with = compareImages(s.picture(), truth, &mask).relRmse,
                 without = compareImages(s.without(), truth, &mask).relRmse;
    EXPECT_LT(with, 0.05) << static_cast<int>(shape);
    EXPECT_LT(with, 0.3 * without) << static_cast<int>(shape);
  }
}

// A picture that is not divided into shares has the same light.
TEST(NearLamps, NeedNoShares) {
  LowLamp s;
  s.settings.set("antialias", 1);
  const Image shares = s.picture();
  s.settings.set("share_memory", 0);
  const Image mask = s.below();
  EXPECT_LT(compareImages(s.picture(), shares, &mask).relRmse, 0.02);
}

// While the lamp moves pixels keep their gain, but not those that show the lamp now.
TEST(NearLamps, DoNotBrightenADraggedLamp) {
  LowLamp s;
  s.settings.set("updates", 1);
  FrameRenderer renderer(makeCpuBackend());
  test::renderSettled(renderer, s.scene, SceneChanges::all(), s.view, s.settings);
  const Scene before = s.scene;
  s.scene.find(s.lamp)->local.translation = vec3(0.0f, 0.05f, -0.6f);  // in front of the floor
  s.scene.find(s.lamp)->local.rotation = glm::angleAxis(kPi, vec3(0, 1, 0));  // faces the eye
  const GiOutput out =
      renderer.render({s.scene, compare(before, s.scene), s.view, "many_lights", s.settings});
  ASSERT_FALSE(out.settled);
  float most = 0.0f;
  for (const vec3& p : out.radiance->pixels().pixels) most = std::max(most, p.x);
  EXPECT_EQ(most, 4.0f);  // its radiance
}

// An object that the lamp leaves out gets nothing of it.
TEST(NearLamps, KeepToTheirLinks) {
  LowLamp s;
  const NodeId box =
      test::addMesh(s.scene, test::boxMesh(vec3(0.4f, 0.1f, 0.4f)), vec3(0.0f, 0.05f, 0.5f));
  s.scene.find(s.lamp)->light.leftOut = {box};
  const Image image = s.picture();
  int pixels = 0;
  for (int y = 0; y < s.view.height; ++y)
    for (int x = 0; x < s.view.width; ++x) {
      const vec3 way = s.rayAt(x, y), at = s.view.eye + (0.7f - s.view.eye.z) / way.z * way;
      if (std::abs(at.x) > 0.15f || at.y < 0.03f || at.y > 0.07f) continue;
      EXPECT_EQ(luminance(image.at(x, y)), 0.0f);
      ++pixels;
    }
  EXPECT_GT(pixels, 10);
}

}  // namespace
}  // namespace lamplighter
