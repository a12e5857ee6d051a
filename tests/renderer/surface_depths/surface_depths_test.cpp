#include "renderer/surface_depths/surface_depths.h"

#include <algorithm>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "renderer/base/random.h"
#include "tests/renderer/surface_depths/lit_texels.h"

namespace lamplighter {
namespace {

bool seesByRay(const test::RoomTexels& room, const SurfaceTexel& texel, const vec3& point) {
  const vec3 from = texel.spot.rayOrigin(), d = point - from;
  return glm::dot(d, texel.spot.geometricNormal) > 0.0f &&
         !room.rays->occluded({from, 0.0f, d, 0.999f});
}

TEST(SurfaceDepths, AreExactInTheDirectionsOfPixels) {
  const test::RoomTexels room(true);
  for (const DepthMapKind kind : {DepthMapKind::cube, DepthMapKind::octahedral}) {
    const DepthMapLayout layout{kind, 16};
    const SurfaceDepths depths = room.depths(layout);
    size_t tested = 0, hidden = 0;
    for (uint32_t t = 0; t < room.texels.size(); t += 5) {
      const SurfaceTexel& texel = room.texels[t];
      for (uint32_t q = 0; q < layout.pixels(); q += 3) {
        const vec3 d = layout.directionOf(q);
        if (glm::dot(d, texel.spot.geometricNormal) < 0.05f) continue;
        const Hit first = room.rays->intersect({texel.spot.rayOrigin(), 0.0f, d});
        if (!first) {  // from under the box, out of the room
          EXPECT_TRUE(depths.isOpen(t, q));
          continue;
        }
        EXPECT_TRUE(depths.sees(texel, t, texel.spot.rayOrigin() + first.t * d));
        ++tested;
        // The back of the box is not lit by the texel; the wall behind it is hidden.
        Hit behind = room.rays->intersect({texel.spot.rayOrigin(), first.t + 1e-3f, d});
        if (behind) behind = room.rays->intersect({texel.spot.rayOrigin(), behind.t + 1e-3f, d});
        if (!behind) continue;
        ++hidden;
        EXPECT_FALSE(depths.sees(texel, t, texel.spot.rayOrigin() + behind.t * d));
      }
    }
    EXPECT_GT(tested, 1000u);
    EXPECT_GT(hidden, 50u);
  }
}

TEST(SurfaceDepths, AgreeWithRaysBetweenTexels) {
  const test::RoomTexels room(true);
  const SurfaceDepths depths = room.depths({DepthMapKind::cube, 32});
  int other = 0, hidden = 0;
  constexpr int kPairs = 20000;
  for (uint32_t i = 0; i < kPairs; ++i) {
    const auto count = static_cast<uint32_t>(room.texels.size());
    const uint32_t a = hash4(i, 0, 0, 1) % count, b = hash4(i, 0, 0, 2) % count;
    const SurfaceTexel &from = room.texels[a], &to = room.texels[b];
    if (glm::dot(to.spot.geometricNormal, from.spot.position - to.spot.position) <= 1e-3f) continue;
    const bool isSeen = seesByRay(room, from, to.spot.position);
    hidden += !isSeen;
    other += isSeen != depths.sees(from, a, to.spot.position);
  }
  EXPECT_GT(hidden, kPairs / 50);
  EXPECT_LT(other, kPairs / 100);
  RecordProperty("other", other);
}

TEST(SurfaceDepths, TheSameInAnyPortionsAndThreads) {
  const test::RoomTexels room(true, 0.5f);
  const DepthMapLayout layout{DepthMapKind::cube, 16};
  const SurfaceDepths expected = room.depths(layout);
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  SurfaceDepths depths;
  depths.restart(room.scene, room.texels, layout);
  int calls = 0;
  for (; !depths.isDone(); ++calls) depths.goOn(room.scene, *room.rays, room.texels, 1);
  EXPECT_GT(calls, 10);
  EXPECT_EQ(depths.segments(), expected.segments());
  for (size_t t = 0; t < room.texels.size(); ++t)
    for (uint32_t q = 0; q < layout.pixels(); ++q)
      ASSERT_EQ(depths.valueOf(t, q), expected.valueOf(t, q));
}

TEST(SurfaceDepths, ComeBackFromBytes) {
  const test::RoomTexels room(true, 0.5f);
  const DepthMapLayout layout{DepthMapKind::cube, 16};
  const SurfaceDepths expected = room.depths(layout);
  std::vector<uint8_t> bytes = expected.saved();
  SurfaceDepths depths;
  depths.restart(room.scene, room.texels, layout);
  ASSERT_TRUE(depths.restore(bytes));
  EXPECT_TRUE(depths.isDone());
  for (size_t t = 0; t < room.texels.size(); t += 3)
    for (uint32_t q = 0; q < layout.pixels(); q += 5)
      ASSERT_EQ(depths.valueOf(t, q), expected.valueOf(t, q));

  depths.restart(room.scene, room.texels, layout);
  EXPECT_FALSE(depths.restore(std::span(bytes).first(bytes.size() - 1)));
  bytes.push_back(0);
  EXPECT_FALSE(depths.restore(bytes));
  bytes.pop_back();
  // Random damage is found, or leaves depths that can be asked.
  for (uint32_t i = 0; i < 200; ++i) {
    std::vector<uint8_t> damaged = bytes;
    damaged[hash4(i, 0, 0, 1) % damaged.size()] ^=
        static_cast<uint8_t>(1 + hash4(i, 0, 0, 2) % 255);
    depths.restart(room.scene, room.texels, layout);
    if (!depths.restore(damaged)) continue;
    for (size_t t = 0; t < room.texels.size(); ++t)
      for (uint32_t q = 0; q < layout.pixels(); ++q) depths.valueOf(t, q);
  }
  EXPECT_FALSE(depths.restore({}));
}

TEST(SurfaceDepths, ASegmentStandsForSeveralPixelsInEachOrder) {
  const DepthMapLayout layout{DepthMapKind::cube, 16};
  const test::RoomTexels zigzag(true), spiral(true, 0.25f, TexelOrder::spiral);
  const SurfaceDepths a = zigzag.depths(layout), b = spiral.depths(layout);
  EXPECT_GT(static_cast<double>(a.uncompressed()) / static_cast<double>(a.segments()), 5.0);
  EXPECT_GT(static_cast<double>(b.uncompressed()) / static_cast<double>(b.segments()), 5.0);
}

}  // namespace
}  // namespace lamplighter
