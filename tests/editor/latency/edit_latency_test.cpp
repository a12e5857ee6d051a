// Edit latency, from the edit to the settled picture, tested with pictures that approach the
// settled one at a known rate.
#include "editor/latency/edit_latency.h"

#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

class EditLatencyTest : public testing::Test {
 protected:
  // A frame of 10 ms that shows a uniform grey.
  void show(float grey, bool settled, bool edited = false) {
    const double begin = clock_;
    clock_ += 0.01;
    latency_.frame({edited, edited ? "Move lamp" : "", settled, view_,
                    std::make_shared<HostImage>(Image(16, 8, vec3(grey))), begin, clock_});
  }
  void rest() { show(1.0f, true); }

  EditLatency latency_;
  View view_;
  double clock_ = 5.0;
};

TEST_F(EditLatencyTest, CountsFramesAndMillisecondsToEachShare) {
  rest();
  // The difference from the settled picture falls from 100% to 60, 40, 20, 4, 2, 0.5 and 0%.
  show(0.6f, false, true);
  EXPECT_TRUE(latency_.running());
  for (const float grey : {0.4f, 0.2f, 0.04f, 0.02f, 0.005f}) show(grey, false);
  show(0.0f, true);
  ASSERT_EQ(latency_.results().size(), 1u);
  const LatencyResult& r = latency_.results().back();
  EXPECT_EQ(r.what, "Move lamp");
  EXPECT_TRUE(r.visible);
  EXPECT_EQ(r.within[0].frames, 2);
  EXPECT_EQ(r.within[1].frames, 4);
  EXPECT_EQ(r.within[2].frames, 6);
  EXPECT_EQ(r.settled.frames, 7);
  EXPECT_NEAR(r.within[1].milliseconds, 40.0, 1e-6);
  EXPECT_EQ(latencyText(r, false), "50% in 2, 95% in 4, 99% in 6, settled in 7 frames");
  EXPECT_EQ(latencyText(r, true),
            "50% in 2 (20 ms), 95% in 4 (40 ms), 99% in 6 (60 ms), settled in 7 (70 ms) frames");
  EXPECT_FALSE(latency_.running());
}

// A picture that is close for one frame only does not count.
TEST_F(EditLatencyTest, CountsWhenThePictureStaysClose) {
  rest();
  show(0.01f, false, true);
  show(0.7f, false);
  show(0.3f, false);
  show(0.0f, true);
  const LatencyResult& r = latency_.results().back();
  EXPECT_EQ(r.within[0].frames, 3);
  EXPECT_EQ(r.within[1].frames, 4);
}

TEST_F(EditLatencyTest, TheLastEditOfADragCounts) {
  rest();
  show(0.9f, false, true);
  show(0.8f, false, true);
  show(0.1f, false, true);
  show(0.0f, true);
  ASSERT_EQ(latency_.results().size(), 1u);
  const LatencyResult& r = latency_.results().back();
  EXPECT_EQ(r.settled.frames, 2);    // since the third edit
  EXPECT_EQ(r.within[0].frames, 1);  // from 0.8, shown before the edit, to 0.1
  EXPECT_EQ(r.within[1].frames, 2);
}

TEST_F(EditLatencyTest, ACameraMovementEndsTheMeasurement) {
  rest();
  show(0.5f, false, true);
  view_.eye.x += 1.0f;
  show(0.2f, false);
  EXPECT_FALSE(latency_.running());
  show(0.0f, true);
  EXPECT_TRUE(latency_.results().empty());
}

TEST_F(EditLatencyTest, AnInvisibleEditIsReported) {
  rest();
  show(1.0f, false, true);
  show(1.0f, true);
  const LatencyResult& r = latency_.results().back();
  EXPECT_FALSE(r.visible);
  EXPECT_EQ(latencyText(r, false), "not seen, settled in 2 frames");
}

// With more frames than stored pictures, the results are exact to within the dropped frames.
TEST_F(EditLatencyTest, LongMeasurementsAreThinnedOut) {
  rest();
  constexpr int kFrames = 3000;
  for (int i = 1; i < kFrames; ++i) show(1.0f - static_cast<float>(i) / kFrames, false, i == 1);
  show(0.0f, true);
  const LatencyResult& r = latency_.results().back();
  EXPECT_EQ(r.settled.frames, kFrames);
  EXPECT_NEAR(r.within[0].frames, kFrames / 2, 16);
  EXPECT_NEAR(r.within[1].frames, kFrames * 95 / 100, 16);
}

class SessionLatency : public test::SessionFixture {};

// End to end: an edit of a real scene, measured in frames only.
TEST_F(SessionLatency, EditsOfASessionAreMeasured) {
  for (int i = 0; i < 200 && !session_.renderFrame().settled; ++i) {
  }
  session_.renderFrame();
  const size_t before = session_.watch().latency.measured();
  AreaLight light = *node(light_).area;
  light.radiance *= 3.0f;
  session_.setAreaLight(light_, light);
  int frames = 0;
  do ++frames;
  while (!session_.renderFrame().settled && frames < 200);
  const EditLatency& latency = session_.watch().latency;
  ASSERT_EQ(latency.measured(), before + 1);
  const LatencyResult& r = latency.results().back();
  EXPECT_TRUE(r.visible);
  EXPECT_EQ(r.settled.frames, frames);
  EXPECT_LE(r.within[0].frames, r.within[1].frames);
  EXPECT_LE(r.within[1].frames, r.within[2].frames);
  EXPECT_LE(r.within[2].frames, r.settled.frames);
  EXPECT_EQ(r.settled.milliseconds, 0.0);  // no clock was given

  session_.runAction("render.exposure 1");  // changes only the display of the same radiance
  session_.renderFrame();
  EXPECT_EQ(latency.measured(), before + 1);
  EXPECT_FALSE(latency.running());
}

}  // namespace
}  // namespace lamplighter
