#include "renderer/methods/frame_time_control.h"

#include <gtest/gtest.h>

#include "renderer/methods/many_lights/stages.h"

namespace lamplighter {
namespace {

// Simulates frames that cost a constant time plus a time per refreshed VPL.
struct Machine {
  double perVpl, constant;  // seconds
  int pending;

  GiStats frame(int allowed) const {
    const int vpls = std::min(allowed, pending);
    GiStats stats;
    stats.updates = vpls;
    stats.stageSeconds = {{kShadowMapsStage, 0.5 * perVpl * vpls},
                          {kLightSumsStage, 0.5 * perVpl * vpls + 0.6 * constant},
                          {kGBufferStage, 0.4 * constant}};
    return stats;
  }
};

int updatesAfter(FrameTimeControl& control, const Machine& machine, double seconds, int frames) {
  for (int i = 0; i < frames; ++i) control.measured(machine.frame(control.updatesWithin(seconds)));
  return control.updatesWithin(seconds);
}

TEST(FrameTimeControl, FillsTheFrame) {
  FrameTimeControl control;
  EXPECT_EQ(control.updatesWithin(0.05), 16);
  EXPECT_NEAR(updatesAfter(control, {0.0005, 0.02, 1000}, 0.05, 40), 60, 1);
  EXPECT_NEAR(updatesAfter(control, {0.0005, 0.02, 1000}, 0.1, 40), 160, 2);
  // The constant part alone exceeds the target: a minimum of updates remains.
  EXPECT_EQ(updatesAfter(control, {0.0005, 0.02, 1000}, 0.01, 40), 16);
}

TEST(FrameTimeControl, FollowsChangesOfTheCost) {
  FrameTimeControl control;
  updatesAfter(control, {0.0005, 0.02, 1000}, 0.05, 40);
  EXPECT_NEAR(updatesAfter(control, {0.001, 0.02, 1000}, 0.05, 40), 30, 1);
}

TEST(FrameTimeControl, IgnoresFramesWithLittleWork) {
  FrameTimeControl control;
  updatesAfter(control, {0.0005, 0.02, 1000}, 0.05, 40);
  EXPECT_NEAR(updatesAfter(control, {0.0005, 0.02, 3}, 0.05, 40), 60, 1);
  EXPECT_NEAR(updatesAfter(control, {0.0005, 0.02, 0}, 0.05, 40), 60, 1);
}

TEST(FrameTimeControl, RecoversFromOneSlowFrame) {
  FrameTimeControl control;
  updatesAfter(control, {0.0005, 0.02, 1000}, 0.05, 40);
  control.measured(Machine{0.0005, 10.0, 1000}.frame(control.updatesWithin(0.05)));
  EXPECT_GE(control.updatesWithin(0.05), 16);
  EXPECT_NEAR(updatesAfter(control, {0.0005, 0.02, 1000}, 0.05, 20), 60, 2);
}

}  // namespace
}  // namespace lamplighter
