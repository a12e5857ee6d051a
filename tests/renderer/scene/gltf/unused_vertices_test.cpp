#include "renderer/scene/gltf/unused_vertices.h"

#include <gtest/gtest.h>

namespace lamplighter {
namespace {

TEST(UnusedVertices, AreRemovedIfMostAreUnused) {
  Primitive p;
  for (int i = 0; i < 10; ++i) {
    p.positions.emplace_back(static_cast<float>(i));
    p.uv0.emplace_back(static_cast<float>(i), 0.0f);
  }
  p.indices = {9, 4, 7, 4, 9, 9};
  dropUnusedVertices(p);
  ASSERT_EQ(p.positions.size(), 3u);
  EXPECT_EQ(p.uv0.size(), 3u);
  EXPECT_TRUE(p.normals.empty());
  const std::vector<float> expected = {9, 4, 7, 4, 9, 9};
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(p.positions[p.indices[i]].x, expected[i]);
    EXPECT_EQ(p.uv0[p.indices[i]].x, expected[i]);
  }
}

TEST(UnusedVertices, AreKeptIfFewAreUnused) {
  Primitive p;
  p.positions.assign(4, vec3(1.0f));
  p.indices = {0, 1, 3};
  dropUnusedVertices(p);
  EXPECT_EQ(p.positions.size(), 4u);
  EXPECT_EQ(p.indices, (std::vector<uint32_t>{0, 1, 3}));
}

}  // namespace
}  // namespace lamplighter
