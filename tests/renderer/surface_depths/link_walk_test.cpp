#include "renderer/surface_depths/link_walk.h"

#include <gtest/gtest.h>

#include "tests/renderer/surface_depths/lit_texels.h"

namespace lamplighter {
namespace {

// A walk of its own at the spot of a texel finds its links.
TEST(LinkWalk, FindsTheLinksOfATexel) {
  const test::RoomTexels room(true);
  const TexelTree tree(room.texels);
  const SurfaceDepths depths = room.depths({DepthMapKind::cube, 16});
  const auto sees = [&](uint32_t t, const vec3& p) { return depths.sees(room.texels[t], t, p); };
  TexelLinks links;
  links.restart(room.texels, 0.01f);
  links.goOn(room.texels, tree, sees, room.texels.size());
  for (uint32_t t = 0; t < room.texels.size(); t += 29) {
    std::vector<TexelLink> found;
    float sum = 0.0f;
    walkLinks(room.texels[t].spot, t, room.texels, tree, 0.01f, [&](uint32_t node, float factor) {
      float tested = 0.0f, seen = 0.0f;
      forEachTested(tree, tree[node], [&](uint32_t s) {
        tested += 1.0f;
        seen += sees(t, room.texels[s].spot.position) ? 1.0f : 0.0f;
      });
      if (seen == 0.0f) return;
      found.push_back({node, 0, factor * seen / tested});
      sum += found.back().weight;
    });
    const auto expected = links.of(t);
    EXPECT_FLOAT_EQ(links.scaleOf(t), 1.0f / std::max(sum, 1.0f));
    ASSERT_EQ(found.size(), expected.size());
    for (size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].node, expected[i].node);
      EXPECT_FLOAT_EQ(found[i].weight, expected[i].weight);
    }
  }
}

}  // namespace
}  // namespace lamplighter
