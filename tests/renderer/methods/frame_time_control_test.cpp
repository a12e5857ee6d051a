#include "renderer/methods/frame_time_control.h"

#include <gtest/gtest.h>

#include "renderer/methods/many_lights/stages.h"

namespace lamplighter {
namespace {

// Frames of a machine on which some of the time is the same whatever is refreshed.
struct Machine {
  double perVpl, rest;  // seconds
  int pending;

  GiStats frame(int allowed) const {
    const int vpls = std::min(allowed, pending);
    GiStats stats;
    stats.updates = vpls;
    stats.stageSeconds = {{kShadowMapsStage, 0.5 * perVpl * vpls},
                          {kLightSumsStage, 0.5 * perVpl * vpls + 0.6 * rest},
                          {kGBufferStage, 0.4 * rest}};
    return stats;
  }
};

int after(FrameTimeControl& control, const Machine& machine, double seconds, int frames) {
  for (int i = 0; i < frames; ++i) control.measured(machine.frame(control.updatesWithin(seconds)));
  return control.updatesWithin(seconds);
}

TEST(FrameTimeControl, FillsTheFrame) {
  FrameTimeControl control;
  EXPECT_EQ(control.updatesWithin(0.05), 16);
  EXPECT_NEAR(after(control, {0.0005, 0.02, 1000}, 0.05, 40), 60, 1);
  EXPECT_NEAR(after(control, {0.0005, 0.02, 1000}, 0.1, 40), 160, 2);
  // The rest alone takes longer: it goes on all the same.
  EXPECT_EQ(after(control, {0.0005, 0.02, 1000}, 0.01, 40), 16);
}

TEST(FrameTimeControl, FollowsWhatFramesCost) {
  FrameTimeControl control;
  after(control, {0.0005, 0.02, 1000}, 0.05, 40);
  EXPECT_NEAR(after(control, {0.001, 0.02, 1000}, 0.05, 40), 30, 1);
}

TEST(FrameTimeControl, FramesWithLittleToDoTakeNoPart) {
  FrameTimeControl control;
  after(control, {0.0005, 0.02, 1000}, 0.05, 40);
  EXPECT_NEAR(after(control, {0.0005, 0.02, 3}, 0.05, 40), 60, 1);
  EXPECT_NEAR(after(control, {0.0005, 0.02, 0}, 0.05, 40), 60, 1);
}

TEST(FrameTimeControl, ASlowFrameDoesNotBringItToAStop) {
  FrameTimeControl control;
  after(control, {0.0005, 0.02, 1000}, 0.05, 40);
  control.measured(Machine{0.0005, 10.0, 1000}.frame(control.updatesWithin(0.05)));
  EXPECT_GE(control.updatesWithin(0.05), 16);
  EXPECT_NEAR(after(control, {0.0005, 0.02, 1000}, 0.05, 20), 60, 2);
}

}  // namespace
}  // namespace lamplighter
