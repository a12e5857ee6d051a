#include "renderer/scene/gltf/flat_normals.h"

#include <gtest/gtest.h>

namespace lamplighter {
namespace {

// The corner of a cube: three squares with seven shared vertices and without normals.
Primitive cubeCorner() {
  Primitive p;
  p.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  p.indices = {0, 2, 1, 0, 3, 2, 0, 1, 5, 0, 5, 4, 0, 4, 6, 0, 6, 3};
  for (size_t i = 0; i < p.positions.size(); ++i) {
    p.uv0.emplace_back(static_cast<float>(i), 0.5f);
  }
  return p;
}

TEST(FlatNormals, EveryFaceGetsItsOwn) {
  Primitive p = cubeCorner();
  const Primitive before = p;
  addFlatNormals(p, std::vector<bool>(7, true));
  // Vertex 0 is on three faces, 1, 3 and 4 are on two each: 7 + 2 + 3 vertices. The two triangles
  // of a square share vertices.
  EXPECT_EQ(p.positions.size(), 12u);
  ASSERT_EQ(p.normals.size(), 12u);
  EXPECT_EQ(p.uv0.size(), 12u);
  for (size_t t = 0; t < p.indices.size(); t += 3) {
    const vec3 face(t < 6 ? vec3(0, 0, -1) : t < 12 ? vec3(0, -1, 0) : vec3(-1, 0, 0));
    for (size_t c = t; c < t + 3; ++c) {
      EXPECT_EQ(p.normals[p.indices[c]], face);
      // Split vertices keep their position and attributes.
      EXPECT_EQ(p.positions[p.indices[c]], before.positions[before.indices[c]]);
      EXPECT_EQ(p.uv0[p.indices[c]], before.uv0[before.indices[c]]);
    }
  }
}

TEST(FlatNormals, ExistingOnesAreKept) {
  Primitive p = cubeCorner();
  const vec3 round = glm::normalize(vec3(-1, -1, -1));
  p.normals.assign(7, round);
  std::vector<bool> missing(7, false);
  missing[2] = true;  // on one face
  addFlatNormals(p, missing);
  EXPECT_EQ(p.positions.size(), 7u);
  EXPECT_EQ(p.normals[0], round);
  EXPECT_EQ(p.normals[2], vec3(0, 0, -1));
}

TEST(FlatNormals, FacesWithoutAreaAreHarmless) {
  Primitive p;
  p.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  p.indices = {0, 1, 2};
  addFlatNormals(p, std::vector<bool>(3, true));
  ASSERT_EQ(p.normals.size(), 3u);
  for (const vec3& n : p.normals) EXPECT_EQ(glm::length(n), 1.0f);
}

}  // namespace
}  // namespace lamplighter
