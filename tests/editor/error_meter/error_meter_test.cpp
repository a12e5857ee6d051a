// The error meter, tested with pictures whose error is known.
#include "editor/error_meter/error_meter.h"

#include <cmath>
#include <random>

#include "renderer/image/average_blocks.h"
#include "tests/editor/session_fixture.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"

namespace lamplighter {
namespace {

constexpr int kSide = 24;

// The true picture, with varying brightness.
Image truth() {
  Image image(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      image.at(x, y) = vec3(1.0f + 0.05f * static_cast<float>(x), 1.5f,
                            0.4f + 0.1f * static_cast<float>((x + y) % 5));
  return image;
}

// A picture with an error of known size, larger on the left.
Image offBy(const Image& truth, float amount) {
  Image image = truth;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      image.at(x, y) *= 1.0f + amount * (x < 6 ? 3.0f : (y % 2 == 0 ? 1.0f : -1.0f));
  return image;
}

double relRmse(const Image& a, const Image& b) {
  double sum = 0.0, mean = 0.0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    const vec3 d = a.pixels[i] - b.pixels[i];
    sum += static_cast<double>(glm::dot(d, d));
    mean += static_cast<double>(b.pixels[i].r + b.pixels[i].g + b.pixels[i].b);
  }
  const double n = 3.0 * static_cast<double>(a.pixels.size());
  return std::sqrt(sum / n) / (mean / n);
}

// The true picture with the noise of a path tracer. Each half has `samples` samples per pixel. Like
// a shadow ray, a sample gets all of the light or none.
ReferenceHalves noisy(const Image& truth, int samples, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  ReferenceHalves halves{1, 1, samples, Image(kSide, kSide), Image(kSide, kSide)};
  for (Image* half : {&halves.first, &halves.second}) {
    for (size_t i = 0; i < truth.pixels.size(); ++i) {
      float sum = 0.0f;
      for (int s = 0; s < samples; ++s) sum += unit(random) < 0.25f ? 4.0f : 0.0f;
      half->pixels[i] = truth.pixels[i] * (sum / static_cast<float>(samples));
    }
  }
  return halves;
}

// Over many references, the estimate is right on average, and its spread matches its uncertainty.
TEST(ErrorEstimate, IsRightWithinItsStatedUncertainty) {
  const Image real = truth();
  for (const float amount : {0.05f, 0.2f}) {
    const Image picture = offBy(real, amount);
    const double error = relRmse(picture, real);
    for (const int samples : {16, 256}) {
      SCOPED_TRACE(testing::Message() << amount << ", " << samples << " paths");
      constexpr int kTrials = 200;
      int within = 0, known = 0;
      double squares = 0.0, sum = 0.0;
      for (int trial = 0; trial < kTrials; ++trial) {
        const ErrorEstimate e =
            estimateError(picture, noisy(real, samples, 1000u + static_cast<uint32_t>(trial)));
        const bool isRight =
            e.isKnown ? std::abs(e.error - error) <= 2.0 * e.uncertainty : error <= e.atMost;
        within += isRight ? 1 : 0;
        known += e.isKnown ? 1 : 0;
        squares += e.error * e.error;
        sum += std::pow((e.error - error) / e.uncertainty, 2);
      }
      EXPECT_GE(within, kTrials * 90 / 100);
      if (known < kTrials) continue;
      // Where the error is above the noise, the estimate is unbiased and its spread as stated.
      EXPECT_NEAR(std::sqrt(squares / kTrials), error, 0.02 * error);
      EXPECT_GT(std::sqrt(sum / kTrials), 0.6);
      EXPECT_LT(std::sqrt(sum / kTrials), 1.4);
    }
  }
}

TEST(ErrorEstimate, NoiseOfTheReferenceIsSubtracted) {
  const Image real = truth();
  const ReferenceHalves halves = noisy(real, 16, 7);
  const ErrorEstimate e = estimateError(real, halves);
  EXPECT_GT(relRmse(halves.mean(), real), 0.2);  // the error without subtracting the noise
  EXPECT_LT(e.error, 0.2 * relRmse(halves.mean(), real) + 2.0 * e.uncertainty);
  EXPECT_LT(e.atMost, relRmse(halves.mean(), real));
}

TEST(ErrorEstimate, TextHasAsManyDigitsAsAreKnown) {
  ErrorEstimate e{0.0312, 0.0041, 0.04, 64, true};
  EXPECT_EQ(e.text(), "3.1% \u00b1 0.4%");
  e = {0.0312, 0.0004, 0.04, 64, true};
  EXPECT_EQ(e.text(), "3.12% \u00b1 0.04%");
  e = {0.01, 0.02, 0.052, 64, false};
  EXPECT_EQ(e.text(), "below 5.2%");
}

TEST(ErrorEstimate, BlocksAreMeansAndIncompleteBlocksAreIgnored) {
  Image image(5, 4);
  for (int i = 0; i < 20; ++i) image.pixels[static_cast<size_t>(i)] = vec3(static_cast<float>(i));
  const Image blocks = averageBlocks(image, 2);
  ASSERT_EQ(blocks.width, 2);
  ASSERT_EQ(blocks.height, 2);
  EXPECT_EQ(blocks.at(0, 0), vec3((0 + 1 + 5 + 6) / 4.0f));
  EXPECT_EQ(blocks.at(1, 1), vec3((12 + 13 + 17 + 18) / 4.0f));
}

class ErrorMeterTest : public test::SessionFixture {
 protected:
  MeterSubject subject(int block) const {
    return {1,  1,    std::make_shared<const Scene>(session_.document().scene), session_.view(),
            {}, block};
  }
};

// Both halves agree with the path tracer at both block sizes.
TEST_F(ErrorMeterTest, TheReferenceMatchesThePathTracer) {
  session_.resizeViewport(48, 32);
  const Image truth = test::renderReference(session_.document().scene, session_.view(), 512, 5, 9);
  for (const int block : {1, 4}) {
    ReferenceSampler sampler;
    sampler.begin(subject(block));
    for (int i = 0; i < 64; ++i) ASSERT_TRUE(sampler.step());
    const ReferenceHalves halves = sampler.halves();
    const Image wanted = averageBlocks(truth, block);
    const vec3 mean = test::meanOf(wanted);
    EXPECT_NEAR(test::meanOf(halves.first).g, mean.g, 0.04f * mean.g) << block;
    EXPECT_NEAR(test::meanOf(halves.second).g, mean.g, 0.04f * mean.g) << block;
    EXPECT_FALSE(test::sameBits(halves.first, halves.second));
  }
}

// A reference picture of the scene with a known error: a third of it is 30% brighter.
TEST_F(ErrorMeterTest, MeasuresAKnownErrorOfARenderedPicture) {
  session_.resizeViewport(48, 32);
  Image picture = test::renderReference(session_.document().scene, session_.view(), 2048, 5, 9);
  const Image real = averageBlocks(picture, 2);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 16; ++x) picture.at(x, y) *= 1.3f;
  const Image seen = averageBlocks(picture, 2);
  ReferenceSampler sampler;
  sampler.begin(subject(2));
  for (int i = 0; i < 64; ++i) sampler.step();
  const ErrorEstimate e = estimateError(seen, sampler.halves());
  EXPECT_TRUE(e.isKnown);
  EXPECT_NEAR(e.error, relRmse(seen, real), 3.0 * e.uncertainty);
  EXPECT_LT(e.uncertainty, 0.25 * e.error);
}

// Visible lamps are excluded, because errors at their bright outlines would dominate.
TEST_F(ErrorMeterTest, VisibleLampsAreExcluded) {
  session_.resizeViewport(48, 32);
  View view = session_.view();
  view.eye = vec3(0, 1, 5);
  view.orientation = glm::angleAxis(0.5f, vec3(1, 0, 0));
  session_.setView(view);
  AreaLight light = *node(light_).area;
  light.radiance = vec3(1000.0f);
  session_.setAreaLight(light_, light);
  const vec2 lamp = pixelOf(vec3(0, 4, 0));
  ASSERT_TRUE(lamp.x > 8 && lamp.y > 8 && lamp.x < 40 && lamp.y < 24) << lamp.x << " " << lamp.y;
  ReferenceSampler sampler;
  sampler.begin(subject(2));
  for (int i = 0; i < 16; ++i) sampler.step();
  const ReferenceHalves halves = sampler.halves();
  EXPECT_EQ(halves.counts[static_cast<size_t>(static_cast<int>(lamp.y) / 2 * 24 +
                                              static_cast<int>(lamp.x) / 2)],
            0);
  EXPECT_GT(std::count(halves.counts.begin(), halves.counts.end(), 1), 24 * 16 * 3 / 4);
  Image picture = halves.mean();
  for (size_t i = 0; i < picture.pixels.size(); ++i)
    if (halves.counts[i] == 0) picture.pixels[i] += vec3(500.0f);
  EXPECT_LT(estimateError(picture, halves).error, 0.1);
}

TEST_F(ErrorMeterTest, AfterAnEditTheReferenceStartsFromNothing) {
  session_.resizeViewport(24, 16);
  ReferenceSampler kept, fresh;
  kept.begin(subject(2));
  kept.step();
  Transform moved = local(box_);
  moved.translation.x += 1.0f;
  session_.setNodeTransform(box_, moved);
  kept.begin(subject(2));
  fresh.begin(subject(2));
  for (int i = 0; i < 3; ++i) {
    kept.step();
    fresh.step();
  }
  EXPECT_TRUE(test::sameBits(kept.halves().first, fresh.halves().first));
  EXPECT_TRUE(test::sameBits(kept.halves().second, fresh.halves().second));
}

TEST_F(ErrorMeterTest, RestartsAtEachEditAndIsMeasuredByAnAction) {
  ErrorMeter& meter = session_.watch().meter;
  EXPECT_EQ(meter.text(), "");
  ASSERT_TRUE(session_.runAction("error.block 8")) << session_.status();
  ASSERT_TRUE(session_.runAction("error.measure 2")) << session_.status();
  session_.renderFrame();
  ASSERT_TRUE(meter.estimate());
  EXPECT_EQ(meter.estimate()->samples, 4);
  EXPECT_TRUE(session_.status().starts_with("error ")) << session_.status();
  const double first = meter.estimate()->error;
  session_.renderFrame();
  EXPECT_TRUE(meter.estimate());
  AreaLight light = *node(light_).area;
  light.radiance *= 2.0f;
  session_.setAreaLight(light_, light);
  session_.renderFrame();
  EXPECT_FALSE(meter.estimate());  // the old estimate is invalid after the edit
  session_.undo();
  session_.runAction("error.measure 2");
  session_.renderFrame();
  EXPECT_TRUE(meter.estimate());
  for (int i = 0; i < 100 && !session_.renderFrame().settled; ++i) {
  }
  session_.runAction("error.measure 2");
  session_.renderFrame();
  EXPECT_NEAR(meter.estimate()->error, first, 0.5);

  EXPECT_FALSE(session_.runAction("error.measure 0"));
  EXPECT_FALSE(session_.runAction("error.measure 2.5"));
  EXPECT_FALSE(session_.runAction("error.block 3"));
}

TEST_F(ErrorMeterTest, ReferencesOfAnOldSubjectAreDropped) {
  ErrorMeter& meter = session_.watch().meter;
  session_.runAction("error.meter");
  session_.renderFrame();
  const auto early = meter.wanted();
  ASSERT_TRUE(early);
  session_.renderFrame();
  EXPECT_EQ(meter.wanted(), early);  // nothing changed
  lookFrom(vec3(0, 2, 5), -0.25f);
  session_.renderFrame();
  EXPECT_NE(meter.wanted(), early);
  ReferenceSampler sampler;
  sampler.begin(*early);
  sampler.step();
  meter.take(std::make_shared<const ReferenceHalves>(sampler.halves()));
  EXPECT_FALSE(meter.reference());
  sampler.begin(*meter.wanted());
  sampler.step();
  meter.take(std::make_shared<const ReferenceHalves>(sampler.halves()));
  session_.renderFrame();
  EXPECT_TRUE(meter.estimate());
  session_.runAction("error.meter");
  EXPECT_FALSE(meter.wanted());
}

}  // namespace
}  // namespace lamplighter
