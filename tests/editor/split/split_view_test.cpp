// The split view: two pictures of the same view, the divider, and the heat map of the difference.
#include "editor/split/split_view.h"

#include "editor/split/heat_map.h"
#include "renderer/base/error.h"
#include "renderer/image/tone_map.h"
#include "tests/editor/session_fixture.h"
#include "tests/support/scenes/lit_scene.h"

namespace lamplighter {
namespace {

class SplitViewTest : public test::SessionFixture {
 protected:
  void SetUp() override {
    SessionFixture::SetUp();
    settle();
  }
  void settle() {
    for (int i = 0; i < 300 && !session_.renderFrame().settled; ++i) {
    }
    EXPECT_TRUE(session_.output().settled);
  }
  void run(const std::string& action) {
    ASSERT_TRUE(session_.runAction(action)) << session_.status();
    settle();
  }
  static bool sameColumns(const Image8& a, const Image8& b, int from, int to) {
    for (int y = 0; y < a.height; ++y)
      if (!std::equal(a.at(from, y), a.at(from, y) + size_t{4} * (to - from), b.at(from, y)))
        return false;
    return true;
  }
};

TEST_F(SplitViewTest, ShowsEachSideOnItsSideOfTheDivider) {
  const uint64_t before = hash();
  const Image8 alone = session_.picture();
  run("split.on live many_lights,vpls=40,bounces=0");
  const Image8 other = toneMap(session_.split().secondPicture()->pixels(), 0.0f);
  run("split.position 0.25");
  const Image8 both = session_.picture();
  EXPECT_TRUE(sameColumns(both, alone, 0, 80));
  EXPECT_TRUE(sameColumns(both, other, 80, 320));
  EXPECT_FALSE(sameColumns(both, alone, 80, 320));
  run("render.reference");  // Space
  EXPECT_EQ(session_.picture().pixels, other.pixels);
  EXPECT_EQ(session_.document().render.method, "many_lights");
  run("split.toggle");
  EXPECT_EQ(session_.picture().pixels, alone.pixels);
  run("split.off");
  EXPECT_EQ(session_.picture().pixels, alone.pixels);
  EXPECT_EQ(hash(), before);  // the split view is not part of the document
}

// The second side shows the same picture as a separate session.
TEST_F(SplitViewTest, TheSecondSideFollowsEveryEdit) {
  run("split.on live many_lights,vpls=40");
  Transform moved = local(box_);
  moved.translation.x += 1.0f;
  session_.setNodeTransform(box_, moved);
  lookFrom(vec3(0.5f, 2, 6), -0.25f);
  settle();
  const Image second = session_.split().secondPicture()->pixels();
  run("split.off");
  run("render.set vpls=40");
  EXPECT_TRUE(test::sameBits(second, session_.output().radiance->pixels()));
}

TEST_F(SplitViewTest, EitherSideMayBeTheReference) {
  session_.resizeViewport(32, 20);
  run("render.set vpls=16");
  session_.runAction("split.on reference,samples_per_pixel=4 live");
  settle();
  EXPECT_EQ(session_.output().stats.samplesPerPixel, 4);
  EXPECT_EQ(session_.document().render.method, "many_lights");
  run("split.heat");
  ASSERT_TRUE(session_.split().heat());
  EXPECT_FALSE(session_.split().heat()->legend.empty());
  EXPECT_EQ(session_.picture().pixels, session_.split().heat()->image.pixels);
  run("split.heat");
  EXPECT_FALSE(session_.split().heat());
}

// The reference that a worker traced for the error meter is shown, and not traced again.
TEST_F(SplitViewTest, TheReferenceOfTheErrorMeterIsUsed) {
  session_.runAction("error.meter");
  session_.runAction("split.show heat");
  session_.renderFrame();
  EXPECT_FALSE(session_.split().secondPicture());
  EXPECT_FALSE(session_.output().settled);  // it waits for the worker
  const ErrorMeter& meter = session_.watch().meter;
  ReferenceSampler sampler;
  sampler.begin(*meter.wanted());
  sampler.step();
  const auto halves = std::make_shared<const ReferenceHalves>(sampler.halves());
  session_.watch().meter.take(halves);
  session_.renderFrame();
  ASSERT_TRUE(session_.split().secondPicture());
  const Image& second = session_.split().secondPicture()->pixels();
  EXPECT_EQ(second.width, 320);
  EXPECT_EQ(second.at(5, 2), halves->mean().at(1, 0));
  EXPECT_EQ(second.at(319, 199), halves->mean().at(79, 49));
  EXPECT_TRUE(session_.split().heat());
  session_.runAction("split.show first");
  EXPECT_FALSE(session_.runAction("split.show nothing"));
  session_.runAction("split.show off");
  EXPECT_FALSE(session_.split().on());
}

TEST_F(SplitViewTest, TheDividerIsDragged) {
  run("split.on live many_lights,vpls=40");
  const View view = session_.view();
  session_.select({});
  press(vec2(160, 100));
  dragTo(vec2(200, 90));
  EXPECT_FLOAT_EQ(session_.split().position(), 200.0f / 320.0f);
  dragTo(vec2(900, 90));
  EXPECT_EQ(session_.split().position(), 1.0f);
  dragTo(vec2(240, 90));
  release();
  dragTo(vec2(10, 90));
  EXPECT_FLOAT_EQ(session_.split().position(), 0.75f);
  EXPECT_TRUE(session_.document().selection.empty());  // the drag did not select anything
  EXPECT_TRUE(session_.view() == view);
}

// If the second side cannot be created, the split ends with a message and the first side stays.
TEST_F(SplitViewTest, AFailedSecondSideKeepsTheFirst) {
  const Image8 alone = session_.picture();
  session_.split().setRenderer([]() -> std::unique_ptr<FrameRenderer> {
    throw InputError("no room for a second renderer");
  });
  ASSERT_TRUE(session_.runAction("split.on live many_lights,vpls=40"));
  settle();
  EXPECT_FALSE(session_.split().on());
  EXPECT_EQ(session_.renderError(), "");
  EXPECT_EQ(session_.status(), "Split view: no room for a second renderer");
  EXPECT_EQ(session_.picture().pixels, alone.pixels);
}

TEST_F(SplitViewTest, InvalidSidesAreRefusedAndChangeNothing) {
  run("split.on live many_lights,vpls=40");
  for (const char* bad :
       {"split.on live", "split.on live nothing", "split.on live many_lights,vpls",
        "split.on live many_lights,vpls=0", "split.on live,samples_per_pixel=3 live",
        "split.position 2", "split.position x", "split.heat_scale 0"})
    EXPECT_FALSE(session_.runAction(bad)) << bad;
  EXPECT_EQ(session_.split().second().text, "many_lights,vpls=40");
  EXPECT_EQ(session_.split().position(), 0.5f);
}

TEST(HeatMap, ColoursShowTheDifferenceRelativeToTheMean) {
  Image a(4, 2, vec3(1.0f)), b(4, 2, vec3(1.0f));
  a.at(1, 0).g = 1.25f;
  a.at(2, 0).b = 0.5f;
  a.at(3, 0).r = 9.0f;
  const ViewPicture heat = heatMapOf(a, b, 0.5f, 8, 4, "live", "reference");
  EXPECT_EQ(heat.image.width, 8);
  const auto pixel = [&](int x, int y) {
    const uint8_t* p = heat.image.at(x, y);
    return std::vector<int>{p[0], p[1], p[2]};
  };
  EXPECT_EQ(pixel(2, 0), pixel(3, 1));  // a block covers several pixels
  EXPECT_EQ(pixel(0, 0), pixel(7, 3));
  EXPECT_NE(pixel(0, 0), pixel(2, 0));
  EXPECT_NE(pixel(2, 0), pixel(4, 0));
  EXPECT_EQ(pixel(4, 0), pixel(6, 0));  // both are beyond the end of the colour scale
  EXPECT_EQ(heat.legend.high, "50% of the mean");
}

}  // namespace
}  // namespace lamplighter
