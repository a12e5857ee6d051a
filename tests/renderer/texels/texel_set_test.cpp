#include "renderer/texels/texel_set.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "renderer/texels/texel_order.h"
#include "tests/renderer/surface_depths/lit_texels.h"

namespace lamplighter {
namespace {

// Texels of a rectangle of one chart.
std::vector<SurfaceTexel> rectangle(int width, int height) {
  std::vector<SurfaceTexel> texels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      texels.emplace_back();
      texels.back().at = {x, y};
      texels.back().spot.position = vec3(x, y, 0.0f);
    }
  }
  return texels;
}

TEST(TexelOrder, VisitsEachTexelOnceAndGoesToNeighbours) {
  const auto texels = rectangle(7, 5);
  for (const TexelOrder order : {TexelOrder::zigzag, TexelOrder::spiral, TexelOrder::greedy}) {
    const auto numbers = orderOf(texels, order);
    EXPECT_EQ(std::set(numbers.begin(), numbers.end()).size(), texels.size());
    int far = 0;
    for (size_t i = 1; i < numbers.size(); ++i)
      far += glm::distance(texels[numbers[i]].spot.position, texels[numbers[i - 1]].spot.position) >
             1.001f;
    // The nearest free texel leads into dead ends.
    EXPECT_LE(far, order == TexelOrder::greedy ? 3 : 0) << static_cast<int>(order);
  }
  const auto spiral = orderOf(texels, TexelOrder::spiral);
  EXPECT_EQ(texels[spiral.back()].at, glm::ivec2(4, 2));  // inside
}

TEST(TexelSet, CoversTheSurfaceOnce) {
  const test::RoomTexels room(true);
  double area = 0.0, squares = 0.0;
  for (size_t t = 0; t < room.texels.size(); ++t) {
    const SurfaceTexel& texel = room.texels[t];
    area += static_cast<double>(texel.area);
    squares += 4.0 * static_cast<double>(glm::length(glm::cross(texel.half[0], texel.half[1])));
    EXPECT_NEAR(glm::dot(texel.half[0], texel.spot.geometricNormal), 0.0f, 1e-5f);
  }
  const double expected = 2.0 * (4 * 3 + 4 * 3 + 4 * 4) + 6.0;
  EXPECT_NEAR(area, expected, 1e-3 * expected);
  EXPECT_NEAR(squares, expected, 1e-3 * expected);
}

TEST(TexelSet, BlendsNeighboursLinearly) {
  const test::RoomTexels room(false);
  // The position of a point between the texels of a wall is the blend of their positions.
  size_t found = 0;
  for (size_t t = 0; t < room.texels.size(); t += 7) {
    const SurfaceTexel& texel = room.texels[t];
    const TexelBlend blend = room.texels.blendAt(texel.object, false, vec2(texel.at) + 0.8f);
    vec3 position(0.0f);
    float sum = 0.0f;
    bool isInside = true;
    for (size_t k = 0; k < 4; ++k) {
      sum += blend.weights[k];
      isInside = isInside && blend.weights[k] > 0.0f &&
                 std::abs(room.texels[blend.texels[k]].area - 0.0625f) < 1e-4f;
      position += blend.weights[k] * room.texels[blend.texels[k]].spot.position;
    }
    EXPECT_NEAR(sum, 1.0f, 1e-5f);
    if (!isInside) continue;
    ++found;
    // 0.3 texels further along both axes.
    EXPECT_NEAR(glm::distance(position, texel.spot.position), 0.3f * 0.25f * std::sqrt(2.0f),
                2e-2f);
  }
  EXPECT_GT(found, 20u);
}

TEST(TexelSet, LeavesOutTexelsUnderABox) {
  test::RoomTexels room(true);
  room.texels.findBuried(room.scene, *room.rays);
  size_t under = 0;
  for (size_t t = 0; t < room.texels.size(); ++t) {
    const vec3& p = room.texels[t].spot.position;
    // The box is 1 m wide.
    const float beside = std::max(std::abs(p.x - 0.3f), std::abs(p.z - 0.2f)) - 0.5f;
    const bool isUnder = room.texels[t].object == 0 && p.y < -1.49f && beside < -0.02f;
    const bool isOpen = room.texels[t].object == 0 && (p.y > -1.4f || beside > 0.02f);
    if (isUnder) {
      ++under;
      EXPECT_TRUE(room.texels.isBuried(t)) << p.x << ' ' << p.z;
    }
    if (isOpen) {
      EXPECT_FALSE(room.texels.isBuried(t)) << p.x << ' ' << p.y << ' ' << p.z;
    }
  }
  EXPECT_GT(under, 8u);
}

}  // namespace
}  // namespace lamplighter
