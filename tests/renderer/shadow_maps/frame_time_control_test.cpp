#include "renderer/shadow_maps/frame_time_control.h"

#include <gtest/gtest.h>

namespace lamplighter {
namespace {

GiStats frame(int vpls, double perVpl, double rest) {
  GiStats stats;
  stats.mapsRendered = vpls;
  stats.stageSeconds = {{"shadow maps", 0.5 * perVpl * vpls},
                        {"visibility", 0.3 * perVpl * vpls},
                        {"light maps", 0.2 * perVpl * vpls},
                        {"g-buffer", 0.4 * rest},
                        {"light sums", 0.6 * rest}};
  return stats;
}

TEST(FrameTimeControl, FillsTheFrame) {
  FrameTimeControl control;
  EXPECT_EQ(control.vplsWithin(0.05), 16);
  for (int i = 0; i < 30; ++i) control.measured(frame(40, 0.0005, 0.02));
  EXPECT_EQ(control.vplsWithin(0.0451), 50);
  // The rest alone takes longer: it goes on all the same.
  EXPECT_EQ(control.vplsWithin(0.01), 16);
  EXPECT_EQ(control.vplsWithin(0.0301), 20);
}

TEST(FrameTimeControl, FollowsWhatFramesCost) {
  FrameTimeControl control;
  for (int i = 0; i < 30; ++i) control.measured(frame(40, 0.0005, 0.02));
  for (int i = 0; i < 30; ++i) control.measured(frame(40, 0.001, 0.02));
  EXPECT_EQ(control.vplsWithin(0.0451), 25);
  // Frames at rest take no part.
  for (int i = 0; i < 30; ++i) control.measured(frame(0, 0.0, 0.0));
  EXPECT_EQ(control.vplsWithin(0.0451), 25);
}

}  // namespace
}  // namespace lamplighter
