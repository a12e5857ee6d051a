// shaders/shared/brdf.h alone: general properties of a BRDF, and its limits.
#include "shaders/shared/brdf.h"

#include <cmath>

#include <gtest/gtest.h>

#include "renderer/base/math.h"

namespace lamplighter {
namespace {

using shared::Lobe;

vec3 direction(float theta, float phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

vec3 lobe(const vec3& base, float metallic, float roughness, const vec3& eye, const vec3& light,
          float solidAngle = 0.0f) {
  const Lobe l = shared::makeLobe(base, metallic, roughness, 0.05f, eye.z);
  return shared::lobeTowards(l, light.z, glm::dot(light, eye), solidAngle);
}

// ∫ f cos dω over the directions of light, for the whole BRDF or its specular lobe. The half
// vectors are sampled by the microfacet distribution, so that narrow lobes are sampled well.
double albedo(const vec3& base, float metallic, float roughness, float cosine, bool diffuse) {
  const vec3 eye(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
  const float a2 = roughness * roughness * roughness * roughness;
  const int n = 200;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / n;
    const float nh = std::sqrt((1.0f - u) / (1.0f + (a2 - 1.0f) * u));
    for (int j = 0; j < n; ++j) {
      const vec3 h = direction(std::acos(nh), (static_cast<float>(j) + 0.5f) * 2.0f * kPi / n);
      const float vh = glm::dot(eye, h);
      const vec3 light = 2.0f * vh * h - eye;
      if (vh <= 0.0f || light.z <= 0.0f) continue;
      const float d = nh * nh * (a2 - 1.0f) + 1.0f;
      const float pdf = a2 / (kPi * d * d) * nh / (4.0f * vh);
      sum += static_cast<double>(lobe(base, metallic, roughness, eye, light).g * light.z / pdf);
    }
  }
  sum /= n * n;
  if (diffuse)
    sum += static_cast<double>(base.g * shared::diffuseShare(metallic, roughness, 0.05f, eye.z));
  return sum;
}

TEST(Brdf, TheLobeIsReciprocal) {
  for (const float metallic : {0.0f, 0.4f, 1.0f})
    for (const float roughness : {0.15f, 0.4f, 0.85f, 0.95f})
      for (const float solidAngle : {0.0f, 0.2f}) {
        const vec3 a = direction(0.3f, 0.1f), b = direction(1.2f, 2.0f);
        const vec3 base(0.9f, 0.5f, 0.1f);
        const vec3 ab = lobe(base, metallic, roughness, a, b, solidAngle);
        const vec3 ba = lobe(base, metallic, roughness, b, a, solidAngle);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(ab[c], ba[c], 1e-5f * ab[c]);
      }
}

// Energy may exceed 1 only by the error of the fit of the dielectric's albedo.
TEST(Brdf, ConservesEnergy) {
  for (const float roughness : {0.2f, 0.35f, 0.5f, 0.7f, 0.85f, 1.0f})
    for (const float cosine : {1.0f, 0.8f, 0.45f, 0.2f, 0.1f, 0.05f}) {
      EXPECT_LT(albedo(vec3(1.0f), 1.0f, roughness, cosine, true), 1.002)
          << roughness << ' ' << cosine;
      EXPECT_LT(albedo(vec3(1.0f), 0.0f, roughness, cosine, true), 1.03)
          << roughness << ' ' << cosine;
      EXPECT_LT(albedo(vec3(1.0f), 0.5f, roughness, cosine, true), 1.02)
          << roughness << ' ' << cosine;
    }
}

TEST(Brdf, TheFitOfTheDielectricAlbedoIsClose) {
  for (const float roughness : {0.2f, 0.3f, 0.45f, 0.6f, 0.75f, 0.9f})
    for (const float cosine : {1.0f, 0.9f, 0.7f, 0.45f, 0.25f, 0.1f, 0.05f}) {
      const double integral = albedo(vec3(0.0f), 0.0f, roughness, cosine, false);
      EXPECT_NEAR(shared::dielectricAlbedo(roughness, 0.05f, cosine), integral, 0.031)
          << roughness << ' ' << cosine;
    }
}

TEST(Brdf, ASmoothMetalReflectsItsColourAtNormalIncidence) {
  const double reflected = albedo(vec3(0.3f, 0.6f, 0.9f), 1.0f, 0.2f, 1.0f, false);
  EXPECT_NEAR(reflected, 0.6, 0.006);
}

TEST(Brdf, ASmoothDielectricReflectsFourPercentAtNormalIncidenceAndMoreAtGrazing) {
  EXPECT_NEAR(albedo(vec3(0.0f), 0.0f, 0.2f, 1.0f, false), 0.04, 0.001);
  EXPECT_GT(albedo(vec3(0.0f), 0.0f, 0.2f, 0.17f, false), 0.25);
}

TEST(Brdf, ARoughDielectricIsLambertian) {
  EXPECT_FALSE(shared::isGlossy(0.0f, 1.0f));
  EXPECT_EQ(shared::diffuseShare(0.0f, 1.0f, 0.1f, 0.3f), 1.0f);
  EXPECT_EQ(lobe(vec3(0.7f), 0.0f, 1.0f, direction(0.4f, 0), direction(0.5f, 1)), vec3(0.0f));
  // The limit is continuous.
  const float nearly = shared::diffuseShare(0.0f, 0.999f, 0.1f, 0.3f);
  EXPECT_NEAR(nearly, 1.0f, 1e-3f);
  EXPECT_TRUE(shared::isGlossy(0.01f, 1.0f));
  EXPECT_TRUE(shared::isGlossy(0.0f, 0.9f));
}

TEST(Brdf, AMetalHasNoDiffusePart) {
  EXPECT_EQ(shared::diffuseShare(1.0f, 0.3f, 0.1f, 0.8f), 0.0f);
}

// The bound that keeps single VPLs from being visible as highlights. Light of radiance 1 from a
// small solid angle is not reflected brighter than by a mirror where the half vector is close to
// the normal, and not much brighter elsewhere.
TEST(Brdf, NoHighlightOfALightSampleIsBrighterThanItsSource) {
  float most = 0.0f, mostStraight = 0.0f;
  for (const float roughness : {0.05f, 0.1f, 0.3f, 0.6f})
    for (const float solidAngle : {1e-4f, 1e-3f, 1e-2f, 0.1f, 1.0f})
      for (int i = 0; i < 60; ++i)
        for (int j = 0; j < 60; ++j)
          for (const float phi : {0.0f, 1.5f, 2.6f, kPi}) {
            const vec3 eye = direction(0.025f * static_cast<float>(i), 0.0f);
            const vec3 light = direction(0.025f * static_cast<float>(j) + 0.001f, phi);
            const float seen =
                lobe(vec3(1.0f), 1.0f, roughness, eye, light, solidAngle).g * light.z * solidAngle;
            most = std::max(most, seen);
            if (i == j && phi == kPi) mostStraight = std::max(mostStraight, seen);
          }
  EXPECT_LT(mostStraight, 1.01f / shared::kSpread);
  EXPECT_LT(most, 2.0f / shared::kSpread);
}

// The widened lobe carries nearly as much light as the narrow one.
TEST(Brdf, WideningKeepsTheEnergy) {
  const vec3 eye = direction(0.5f, 0.0f);
  const auto total = [&](float solidAngle) {
    double sum = 0.0;
    for (int i = 0; i < 400; ++i)
      for (int j = 0; j < 400; ++j) {
        const float theta = (static_cast<float>(i) + 0.5f) * 0.5f * kPi / 400.0f;
        const vec3 light = direction(theta, (static_cast<float>(j) + 0.5f) * 2.0f * kPi / 400.0f);
        sum += static_cast<double>(lobe(vec3(1.0f), 1.0f, 0.25f, eye, light, solidAngle).g *
                                   light.z * std::sin(theta));
      }
    return sum * 0.5 * kPi * 2.0 * kPi / 160000.0;
  };
  for (const float solidAngle : {0.01f, 0.03f, 0.08f})
    EXPECT_NEAR(total(solidAngle) / total(0.0f), 1.0, 0.05);
}

TEST(Brdf, ACosineAboveOneByRoundingIsOne) {
  const float above = std::nextafter(1.0f, 2.0f);
  for (const float roughness : {0.1f, 0.3f, 0.6f, 1.0f})
    EXPECT_EQ(shared::dielectricAlbedo(roughness, 0.05f, above),
              shared::dielectricAlbedo(roughness, 0.05f, 1.0f))
        << roughness;
}

}  // namespace
}  // namespace lamplighter
