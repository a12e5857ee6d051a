// Sums of light that are limited per frame: edges are shown coarsely at first, or as in the last
// view, and the next frames go on until the picture is that of an unlimited sum.
#include <gtest/gtest.h>

#include "renderer/image/metrics.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/random_boxes.h"

namespace lamplighter {
namespace {

struct Boxes {
  View view = test::lookAt(vec3(0.5f, 2.2f, 7.5f), vec3(0.0f, 1.4f, 0.0f), 192, 128);
  test::LitScene lit;
  std::vector<shared::Vpl> vpls = test::randomVpls(24, 3);

  explicit Boxes(const Scene& scene = test::randomBoxes(20, 4)) : lit(scene) {
    for (size_t i = 0; i < vpls.size(); ++i) vpls[i].slot = static_cast<int>(i);
    lit.kernels->reserveShadowMaps(static_cast<int>(vpls.size()), 64);
    lit.kernels->renderShadowMaps(vpls);
    lit.backend->renderGBuffer(view, vec2(0.0f));
  }
  // `limit` in units of kLightPixelsUnit; 0: none.
  Image sum(float limit) {
    lit.kernels->sumVpls(vpls, {vec4(0.3f, 0.002f, 0.0f, 64.0f), vec4(4.0f, 0.0f, limit, 0.0f)},
                         nullptr);
    return lit.kernels->compose()->pixels();
  }
  uint64_t lightPixels() const { return lit.kernels->lightCounts().lightPixels; }
};

TEST(LimitedSums, EndAtThePictureOfAnUnlimitedSum) {
  Boxes boxes, other;
  const Image whole = other.sum(0.0f);
  EXPECT_FALSE(other.lit.kernels->sumIsLimited());
  double last = 1e9;
  int frames = 0;
  for (bool isLimited = true; isLimited; ++frames) {
    const uint64_t before = boxes.lightPixels();
    const Image picture = boxes.sum(1.0f);
    isLimited = boxes.lit.kernels->sumIsLimited();
    EXPECT_TRUE(boxes.lit.kernels->sumIsLong());
    // The samples, of which there are 49 × 33, come in addition.
    EXPECT_LT(boxes.lightPixels() - before, 65536u + 49u * 33u * 24u);
    const double error = compareImages(picture, whole).relRmse;
    EXPECT_LE(error, last);
    last = error;
    ASSERT_LT(frames, 100);
    EXPECT_EQ(test::sameBits(picture, whole), !isLimited);
    if (frames == 0) {
      EXPECT_GT(error, 0.0);
      EXPECT_NEAR(compareImages(picture, whole).bias, 1.0, 0.1) << "lit, if coarsely";
    }
  }
  EXPECT_GT(frames, 2);
}

// An edit in between leaves no trace.
TEST(LimitedSums, FollowEdits) {
  Boxes boxes, other;
  boxes.sum(1.0f);
  for (Boxes* b : {&boxes, &other}) {
    for (size_t i = 0; i < 5; ++i) b->vpls[i].intensity *= 3.0f;
    b->vpls[7].position.x += 0.3f;
    b->lit.kernels->renderShadowMaps({&b->vpls[7], 1});
  }
  Image picture = boxes.sum(1.0f);
  while (boxes.lit.kernels->sumIsLimited()) picture = boxes.sum(1.0f);
  EXPECT_TRUE(test::sameBits(picture, other.sum(0.0f)));
}

// While the camera moves, pixels that are not summed take over the light of the picture before.
TEST(LimitedSums, TakeOverLightWhileTheCameraMoves) {
  Boxes boxes, fresh, other;
  do boxes.sum(1.0f);
  while (boxes.lit.kernels->sumIsLimited());
  for (Boxes* b : {&boxes, &fresh, &other}) {
    b->view.eye += vec3(0.004f, 0.002f, -0.006f);
    b->lit.backend->renderGBuffer(b->view, vec2(0.0f));
  }
  const Image whole = other.sum(0.0f);
  const Image carried = boxes.sum(1.0f), coarse = fresh.sum(1.0f);
  EXPECT_TRUE(boxes.lit.kernels->sumIsLimited());
  EXPECT_LT(compareImages(carried, whole).relRmse, 0.3 * compareImages(coarse, whole).relRmse);

  Image picture = boxes.sum(1.0f);
  while (boxes.lit.kernels->sumIsLimited()) picture = boxes.sum(1.0f);
  EXPECT_TRUE(test::sameBits(picture, whole)) << "when the camera rests nothing of it is left";
}

Scene glossyBoxes() {
  Scene scene = test::randomBoxes(20, 4);
  for (Material& m : scene.materials) m.roughness = 0.3f;
  return scene;
}

// The share of a group of lights is the same in one call and in several.
TEST(LimitedSums, SharesEndAtThoseOfAnUnlimitedSum) {
  Boxes boxes(glossyBoxes()), other(glossyBoxes());
  for (const vec2 jitter : {vec2(0.0f), vec2(0.3f, -0.2f)}) {
    boxes.lit.backend->renderGBuffer(boxes.view, jitter);
    other.lit.backend->renderGBuffer(other.view, jitter);
    for (size_t group = 0; group < 2; ++group) {
      const auto lights = std::span(boxes.vpls).subspan(group * 12, 12);
      const auto share = [&](Boxes& in, float limit) {
        return in.lit.kernels->shareOf(
            group, lights,
            {vec4(0.3f, 0.002f, 0.0f, 64.0f), vec4(4.0f, 0.0f, limit, 0.0f), vec4(1, 0.1f, 0, 0)},
            nullptr, false);
      };
      const Image whole = share(other, 0.0f)->pixels();
      int calls = 1;
      std::shared_ptr<RadianceImage> picture = share(boxes, 0.5f);
      for (; picture == nullptr && calls < 100; ++calls) picture = share(boxes, 0.5f);
      ASSERT_NE(picture, nullptr);
      EXPECT_GT(calls, 2);
      EXPECT_TRUE(test::sameBits(picture->pixels(), whole)) << group;
    }
  }
}

}  // namespace
}  // namespace lamplighter
