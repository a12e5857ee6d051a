#include "renderer/scene/camera.h"

#include <gtest/gtest.h>

namespace lamplighter {
namespace {

View someView() {
  View v;
  v.eye = vec3(1, 2, 3);
  v.orientation = glm::angleAxis(0.6f, glm::normalize(vec3(0.2f, 1.0f, 0.1f)));
  v.width = 320;
  v.height = 200;
  return v;
}

TEST(View, ProjectingAPointOnAPixelsRayGivesThePixel) {
  const View v = someView();
  for (const vec2& p : {vec2(0.5f, 0.5f), vec2(100.0f, 50.0f), vec2(319.5f, 199.5f)}) {
    const vec3 back = v.project(v.eye + 4.0f * v.rayDirection(p.x, p.y));
    EXPECT_NEAR(back.x, p.x, 1e-2f);
    EXPECT_NEAR(back.y, p.y, 1e-2f);
  }
}

TEST(View, ClipSpaceAgreesWithRays) {
  const View v = someView();
  const vec3 world = v.eye + 4.0f * v.rayDirection(100.0f, 50.0f);
  const vec4 clip = v.worldToClip() * vec4(world, 1.0f);
  EXPECT_NEAR((clip.x / clip.w * 0.5f + 0.5f) * 320.0f, 100.0f, 1e-2f);
  EXPECT_NEAR((0.5f - clip.y / clip.w * 0.5f) * 200.0f, 50.0f, 1e-2f);
  EXPECT_NEAR(clip.z / clip.w, v.znear / glm::dot(world - v.eye, v.forward()), 1e-6f);
}

TEST(View, BoundsAreWhollyShown) {
  Bounds b;
  b.add(vec3(-110, 0, -110));
  b.add(vec3(110, 3, 110));
  const View v = viewOfBounds(b, 640, 360);
  for (int i = 0; i < 8; ++i) {
    const vec3 corner((i & 1) ? b.max.x : b.min.x, (i & 2) ? b.max.y : b.min.y,
                      (i & 4) ? b.max.z : b.min.z);
    const vec3 p = v.project(corner);
    EXPECT_GT(p.z, 0.0f);
    EXPECT_GE(p.x, 0.0f);
    EXPECT_LE(p.x, 640.0f);
    EXPECT_GE(p.y, 0.0f);
    EXPECT_LE(p.y, 360.0f);
  }
}

}  // namespace
}  // namespace lamplighter
