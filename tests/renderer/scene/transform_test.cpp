#include "renderer/scene/transform.h"

#include <random>

#include <gtest/gtest.h>

namespace lamplighter {
namespace {

float difference(const mat4& a, const mat4& b) {
  float d = 0.0f;
  for (int i = 0; i < 4; ++i) d = std::max(d, glm::length(a[i] - b[i]));
  return d;
}

TEST(Transform, DecomposeThenComposeGivesTheMatrixBack) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> u(-2.0f, 2.0f);
  for (int i = 0; i < 200; ++i) {
    mat4 m(1.0f);
    for (int c = 0; c < 4; ++c) {
      for (int r = 0; r < 3; ++r) m[c][r] = u(random);
    }
    if (std::abs(glm::determinant(mat3(m))) < 0.05f) continue;
    EXPECT_LT(difference(toMatrix(decompose(m)), m), 2e-5f) << "matrix " << i;
  }
}

TEST(Transform, ATrsMatrixHasNoShear) {
  Transform t;
  t.translation = vec3(1, 2, 3);
  t.rotation = glm::angleAxis(0.7f, glm::normalize(vec3(1, 2, -1)));
  t.scale = vec3(0.5f, 2.0f, 3.0f);
  const Transform back = decompose(toMatrix(t));
  EXPECT_EQ(back.shear, vec3(0.0f));
  EXPECT_LT(glm::length(back.scale - t.scale), 1e-5f);
  EXPECT_GT(std::abs(glm::dot(back.rotation, t.rotation)), 1.0f - 1e-6f);
}

TEST(Transform, AMirrorKeepsItsDeterminantsSign) {
  Transform t;
  t.scale = vec3(1.0f, -1.0f, 1.0f);
  const mat4 m = toMatrix(t);
  EXPECT_LT(difference(toMatrix(decompose(m)), m), 1e-6f);
}

TEST(Transform, AFlattenedMatrixStaysFinite) {
  mat4 m(1.0f);
  m[1] = vec4(0.0f);  // flattened onto XZ
  const mat4 back = toMatrix(decompose(m));
  EXPECT_LT(difference(back, m), 1e-6f);
}

}  // namespace
}  // namespace lamplighter
