#include "renderer/surface_depths/texel_links.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/surface_depths/link_walk.h"
#include "tests/renderer/surface_depths/lit_texels.h"

namespace lamplighter {
namespace {

bool always(uint32_t, const vec3&) { return true; }

TexelLinks linksOf(const TexelSet& texels, const TexelTree& tree, float error,
                   const Visibility& sees = always) {
  TexelLinks links;
  links.restart(texels, error);
  while (!links.isDone()) links.goOn(texels, tree, sees, 100);
  return links;
}

TEST(TexelTree, NodesCoverTheirTexels) {
  const test::RoomTexels room(true);
  const TexelTree tree(room.texels);
  EXPECT_EQ(tree.size(), 2 * room.texels.size() - 1);
  EXPECT_EQ(tree[0].skip, tree.size());
  for (uint32_t n = 0; n < tree.size(); ++n) {
    const TexelTree::Node& node = tree[n];
    for (uint32_t i = node.firstTexel; i < node.firstTexel + node.texels; ++i) {
      const SurfaceTexel& t = room.texels[tree.order()[i]];
      for (const vec3& corner : t.square())
        ASSERT_LE(glm::distance(corner, node.centre), node.radius * 1.0001f + 1e-5f);
    }
    EXPECT_EQ(node.skip - n, 2 * node.texels - 1);
  }
}

TEST(TexelLinks, TheBoundIsAtLeastTheSumOfTheLeaves) {
  const test::RoomTexels room(false);
  const TexelTree tree(room.texels);
  for (uint32_t t = 3; t < room.texels.size(); t += 97) {
    const SurfaceSpot& spot = room.texels[t].spot;
    for (uint32_t n = 0; n < tree.size(); n += 3) {
      float sum = 0.0f;
      for (uint32_t m = n; m < tree[n].skip; ++m)
        if (tree[m].isLeaf() && tree.texelOf(tree[m]) != t)
          sum += formFactorOf(spot, room.texels, tree, tree[m]);
      // Squares add up to the whole hemisphere within 0.5%.
      ASSERT_LE(sum, 1.005f * largestFormFactor(spot, tree[n]) + 1e-5f);
    }
  }
}

// In an empty closed room each texel sees surfaces everywhere. Links bound their sum; the form
// factors themselves do not.
TEST(TexelLinks, FormFactorsOfTexelsSumToOneInAClosedRoom) {
  const test::RoomTexels room(false);
  const TexelTree tree(room.texels);
  for (size_t t = 0; t < room.texels.size(); ++t) {
    double sum = 0.0;
    for (uint32_t n = 0; n < tree.size(); ++n)
      if (tree[n].isLeaf() && tree.texelOf(tree[n]) != t)
        sum += static_cast<double>(formFactorOf(room.texels[t].spot, room.texels, tree, tree[n]));
    EXPECT_NEAR(sum, 1.0, 0.005);
  }
}

TEST(TexelLinks, FormFactorsSumToOneInAClosedRoom) {
  const test::RoomTexels room(false);
  const TexelTree tree(room.texels);
  const auto worst = [&](float error) {
    const TexelLinks links = linksOf(room.texels, tree, error);
    double mean = 0.0, most = 0.0;
    for (size_t t = 0; t < room.texels.size(); ++t) {
      double sum = 0.0;
      for (const TexelLink& link : links.of(t)) sum += static_cast<double>(links.scaleOf(t) * link.weight);
      mean += sum / static_cast<double>(room.texels.size());
      most = std::max(most, std::abs(sum - 1.0));
    }
    EXPECT_NEAR(mean, 1.0, 0.005);
    return most;
  };
  EXPECT_LT(worst(0.0f), 0.005);
  EXPECT_LT(worst(0.002f), 0.02);
  EXPECT_LT(worst(0.005f), 0.04);
}

TEST(TexelLinks, FurnaceHasTheLightOfAGeometricSeries) {
  const test::RoomTexels room(false);
  const TexelTree tree(room.texels);
  const TexelLinks links = linksOf(room.texels, tree, 0.005f);
  std::vector<vec3> light(room.texels.size(), vec3(0.0f)), radiosity(room.texels.size()), byNode;
  double expected = 0.0;
  for (int bounce = 1; bounce <= 5; ++bounce) {
    expected += std::pow(0.7, bounce);
    for (size_t t = 0; t < light.size(); ++t) radiosity[t] = 0.7f * (vec3(1.0f) + light[t]);
    tree.pull(radiosity, byNode);
    links.gather(byNode, light);
    double mean = 0.0;
    for (const vec3& e : light)
      mean += static_cast<double>(e.g) / static_cast<double>(light.size());
    EXPECT_NEAR(mean, expected, 0.01 * expected);
  }
}

TEST(TexelLinks, RefinedByGeometryUntilTheyAreTexels) {
  const test::RoomTexels room(true);
  const TexelTree tree(room.texels);
  const TexelLinks fine = linksOf(room.texels, tree, 0.0f);
  for (size_t t = 0; t < room.texels.size(); ++t)
    for (const TexelLink& link : fine.of(t)) EXPECT_TRUE(tree[link.node].isLeaf());
  EXPECT_LT(linksOf(room.texels, tree, 0.02f).size(), fine.size() / 2);
}

}  // namespace
}  // namespace lamplighter
