// What texels see by rays and by depths, and how far both are found.
#include "renderer/surface_depths/texel_sight.h"

#include <gtest/gtest.h>

#include "renderer/texels/texel_rays.h"
#include "tests/renderer/surface_depths/lit_texels.h"

namespace lamplighter {
namespace {

constexpr DepthMapLayout kFine{DepthMapKind::cube, 32};
constexpr float kLinkError = 0.02f;

TEST(TexelSight, TheErrorOfDepthsIsTheShareOfTestsThatRaysContradict) {
  const test::RoomTexels empty(false), full(true);
  const TexelTree tree(empty.texels);
  const SurfaceDepths depths = empty.depths(kFine);
  float own = 0.0f, other = 0.0f, largest = 0.0f;
  for (uint32_t t = 0; t < empty.texels.size(); t += 5) {
    own += queryErrorOf(t, empty.scene, *empty.rays, empty.texels, tree, depths, kLinkError, 64);
    // Rays find a box that the depths do not know.
    const float error =
        queryErrorOf(t, full.scene, *full.rays, empty.texels, tree, depths, kLinkError, 64);
    other += error;
    largest = std::max(largest, error);
  }
  EXPECT_LT(own, 0.01f * static_cast<float>(empty.texels.size() / 5));
  EXPECT_GT(other, 10.0f * own);
  EXPECT_GT(largest, 0.1f);
  EXPECT_LE(largest, 1.0f);
}

TEST(TexelSight, AreaLightsHideNothing) {
  test::RoomTexels room(false);
  const SurfaceTexel& texel = room.texels[0];
  const vec3 point = texel.spot.position + 2.0f * texel.spot.geometricNormal;
  EXPECT_TRUE(seesByRay(room.scene, *room.rays, texel, point));
  EXPECT_FALSE(seesByRay(room.scene, *room.rays, texel,
                         texel.spot.position - 2.0f * texel.spot.geometricNormal));
  EXPECT_FALSE(seesByRay(room.scene, *room.rays, texel,
                         texel.spot.position + 20.0f * texel.spot.geometricNormal));
  room.scene.objects[0].isAreaLight = true;
  EXPECT_TRUE(seesByRay(room.scene, *room.rays, texel,
                        texel.spot.position + 20.0f * texel.spot.geometricNormal));
}

TEST(SurfaceDepths, TellWhatIsFoundAndHowWellItIsCompressed) {
  const test::RoomTexels room(true);
  SurfaceDepths depths;
  depths.restart(room.scene, room.texels, kFine);
  const auto found = [&] {
    size_t count = 0;
    for (size_t t = 0; t < room.texels.size(); ++t) count += depths.isFound(t) ? 1 : 0;
    return count;
  };
  EXPECT_EQ(found(), 0u);
  while (depths.progress() < 0.5f) depths.goOn(room.scene, *room.rays, room.texels, 100'000);
  EXPECT_GT(found(), 0u);
  EXPECT_LT(found(), room.texels.size());
  while (!depths.isDone()) depths.goOn(room.scene, *room.rays, room.texels, 10'000'000);
  EXPECT_EQ(found(), room.texels.size());
  double sum = 0.0;
  for (size_t t = 0; t < room.texels.size(); ++t)
    sum += static_cast<double>(depths.segmentShareOf(t));
  const double expected =
      static_cast<double>(depths.segments()) / static_cast<double>(kFine.pixels());
  EXPECT_NEAR(sum / expected, 1.0, 1e-5);
}

}  // namespace
}  // namespace lamplighter
