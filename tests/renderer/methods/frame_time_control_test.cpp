#include "renderer/methods/frame_time_control.h"

#include <gtest/gtest.h>

#include "renderer/methods/many_lights/stages.h"

namespace lamplighter {
namespace {

// Simulates frames that cost a constant time, a time per refreshed VPL and a time for light on
// surfaces.
struct Machine {
  double perVpl, constant;  // seconds
  int pending;
  double surfaces = 0.0;  // of the usual work [s]

  GiStats frame(const FrameTimeControl::Work& work) const {
    GiStats stats;
    stats.updates = std::min(work.updates, pending);
    if (surfaces > 0.0) stats.surfaceWork = work.surfaces;
    stats.stageSeconds = {{kShadowMapsStage, perVpl * stats.updates},
                          {kMeshesStage, surfaces * static_cast<double>(stats.surfaceWork)},
                          {kLightSumsStage, 0.6 * constant},
                          {kGBufferStage, 0.4 * constant}};
    return stats;
  }
};

FrameTimeControl::Work workAfter(FrameTimeControl& control, const Machine& machine, double seconds,
                                 int frames) {
  for (int i = 0; i < frames; ++i) control.measured(machine.frame(control.within(seconds)));
  return control.within(seconds);
}

TEST(FrameTimeControl, FillsTheFrame) {
  FrameTimeControl control;
  EXPECT_EQ(control.within(0.05).updates, 64);
  EXPECT_NEAR(workAfter(control, {0.0005, 0.02, 1000}, 0.05, 40).updates, 60, 1);
  EXPECT_NEAR(workAfter(control, {0.0005, 0.02, 1000}, 0.1, 40).updates, 160, 2);
  // The constant part alone exceeds the target: a quarter of it remains for updates.
  EXPECT_NEAR(workAfter(control, {0.0005, 0.12, 1000}, 0.06, 40).updates, 30, 1);
  EXPECT_EQ(workAfter(control, {0.05, 0.12, 1000}, 0.06, 40).updates, 16);
}

// Neither direct nor bounced light starves the other.
TEST(FrameTimeControl, DividesTheFrameBetweenUpdatesAndSurfaces) {
  FrameTimeControl control;
  const FrameTimeControl::Work work = workAfter(control, {0.0005, 0.0, 1000, 0.2}, 0.06, 60);
  EXPECT_NEAR(work.updates, 90, 2);          // 45 ms
  EXPECT_NEAR(work.surfaces, 0.15f, 0.01f);  // 30 ms, the least
  const FrameTimeControl::Work few = workAfter(control, {0.0005, 0.0, 10, 0.2}, 0.06, 60);
  EXPECT_NEAR(few.surfaces, 0.275f, 0.02f);  // 55 ms; 10 updates take 5
}

TEST(FrameTimeControl, FollowsChangesOfTheCost) {
  FrameTimeControl control;
  workAfter(control, {0.0005, 0.02, 1000}, 0.05, 40);
  EXPECT_NEAR(workAfter(control, {0.001, 0.02, 1000}, 0.05, 40).updates, 30, 1);
}

TEST(FrameTimeControl, IgnoresFramesWithLittleWork) {
  FrameTimeControl control;
  workAfter(control, {0.0005, 0.02, 1000}, 0.05, 40);
  EXPECT_NEAR(workAfter(control, {0.0005, 0.02, 3}, 0.05, 40).updates, 60, 1);
  EXPECT_NEAR(workAfter(control, {0.0005, 0.02, 0}, 0.05, 40).updates, 60, 1);
}

TEST(FrameTimeControl, RecoversFromOneSlowFrame) {
  FrameTimeControl control;
  workAfter(control, {0.0005, 0.02, 1000}, 0.05, 40);
  control.measured(Machine{0.0005, 10.0, 1000}.frame(control.within(0.05)));
  EXPECT_GE(control.within(0.05).updates, 16);
  EXPECT_NEAR(workAfter(control, {0.0005, 0.02, 1000}, 0.05, 20).updates, 60, 2);
}

// The cost of refinement differs from that of updates.
TEST(FrameTimeControl, FillsTheFrameWithRefinement) {
  FrameTimeControl control;
  for (int i = 0; i < 40; ++i) {
    GiStats stats;
    stats.refineUpdates = control.within(0.05).refineUpdates;
    stats.stageSeconds = {{kShadowMapsStage, 1e-6},
                          {kRefinementStage, 0.002 * stats.refineUpdates}};
    control.measured(stats);
  }
  EXPECT_NEAR(control.within(0.05).refineUpdates, 25, 1);
  EXPECT_EQ(control.within(0.05).updates, 64);
}

// The frame in which a picture settles may be long. Later ones are not held up by that, although
// whole numbers of updates are a little less than the limits that were computed.
TEST(FrameTimeControl, RefinementRecoversFromALongFrame) {
  FrameTimeControl control;
  for (int i = 0; i < 40; ++i) {
    GiStats stats;
    stats.refineUpdates = control.within(0.05).refineUpdates;
    stats.stageSeconds = {{kRefinementStage, i == 0 ? 0.06 : 0.0003 * stats.refineUpdates}};
    control.measured(stats);
  }
  EXPECT_NEAR(control.within(0.05).refineUpdates, 166, 3);
}

// Frames of paths alone take seven tenths of the time, and keep the limit.
TEST(FrameTimeControl, APreviewHasFramesOfItsOwn) {
  constexpr StageSpec kPreview{"preview", "", "", StageWork::preview};
  for (const double constant : {0.01, 0.15}) {
    const Machine machine{0.0005, constant, 1000};
    FrameTimeControl control;
    double ofMethod = 0.0, ofPaths = 0.0;
    for (int i = 0; i < 60; ++i) {
      FrameTimeControl::Work work = control.within(0.05);
      const GiStats method = machine.frame(work);
      control.measured(method);
      for (const StageTime& t : method.stageSeconds) ofMethod += t.seconds;
      for (int frames = work.previewFrames; frames > 0; --frames) {
        work = control.within(0.05);
        GiStats paths;
        paths.previewUpdates = work.previewUpdates;
        paths.stageSeconds = {{kPreview, 0.0005 * work.previewUpdates}};
        control.measured(paths);
        ofPaths += paths.stageSeconds[0].seconds;
      }
    }
    EXPECT_NEAR(control.within(0.05).previewUpdates, 100, 2) << constant;
    EXPECT_NEAR(ofPaths / (ofPaths + ofMethod), 0.7, 0.06) << constant;
  }
}

}  // namespace
}  // namespace lamplighter
