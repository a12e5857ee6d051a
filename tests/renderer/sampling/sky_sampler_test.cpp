// Skies: orientation of pictures, and whether samples represent all light of the sky.
#include "renderer/sampling/emitters/sky_sampler.h"

#include <limits>
#include <map>

#include <gtest/gtest.h>

#include "renderer/base/error.h"
#include "renderer/base/low_discrepancy.h"
#include "tests/support/scenes/skies.h"

namespace lamplighter {
namespace {

void expectNear(const vec3& actual, const vec3& expected, float relative) {
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(actual[i], expected[i], relative * std::abs(expected[i])) << i;
}

void expectDirection(const vec3& actual, const vec3& expected, float within) {
  EXPECT_LT(glm::length(actual - expected), within)
      << actual.x << " " << actual.y << " " << actual.z;
}

// A sky picture with one bright pixel.
Sky spot(int x, int y, float rotation = 0.0f) {
  Image image(64, 32, vec3(0.01f));
  image.at(x, y) = vec3(5.0f);
  return Sky::picture(makeSkyImage(std::move(image), "spot"), rotation);
}

TEST(Sky, TheCentreOfAPictureIsTowardsMinusZAndItsTopIsUp) {
  const float height = std::cos(kPi * 15.5f / 32.0f), flat = std::sqrt(1.0f - height * height);
  const auto at = [&](float azimuth) {
    return vec3(flat * std::sin(azimuth), height, -flat * std::cos(azimuth));
  };
  const float half = kPi / 64.0f;  // half a pixel
  EXPECT_NEAR(spot(32, 15).radianceFrom(at(half)).r, 5.0f, 1e-3f);
  EXPECT_NEAR(spot(48, 15).radianceFrom(at(0.5f * kPi + half)).r, 5.0f, 1e-3f);   // +X
  EXPECT_NEAR(spot(16, 15).radianceFrom(at(-0.5f * kPi + half)).r, 5.0f, 1e-3f);  // −X
  EXPECT_NEAR(spot(0, 15).radianceFrom(at(kPi + half)).r, 5.0f, 1e-3f);           // +Z
  // A rotation by 90° to the left, as of a node about Y.
  const quat turn = glm::angleAxis(0.5f * kPi, vec3(0, 1, 0));
  EXPECT_NEAR(spot(32, 15, 0.5f * kPi).radianceFrom(turn * at(half)).r, 5.0f, 1e-3f);
  Image top(64, 32, vec3(0.0f));
  for (int x = 0; x < 64; ++x) top.at(x, 0) = vec3(1.0f);
  EXPECT_GT(Sky::picture(makeSkyImage(top, "")).radianceFrom(vec3(0, 1, 0)).r, 0.9f);
  EXPECT_EQ(Sky::picture(makeSkyImage(top, "")).radianceFrom(vec3(0, -1, 0)).r, 0.0f);
}

TEST(Sky, InvalidPixelsAreReplacedAndLargePicturesReduced) {
  Image image(2, 1);
  image.at(0, 0) =
      vec3(std::numeric_limits<float>::quiet_NaN(), -3.0f, std::numeric_limits<float>::infinity());
  const auto made = makeSkyImage(image, "odd");
  EXPECT_EQ(made->pixels.at(0, 0).r, 0.0f);
  EXPECT_EQ(made->pixels.at(0, 0).g, 0.0f);
  EXPECT_TRUE(std::isfinite(made->pixels.at(0, 0).b));
  EXPECT_EQ(makeSkyImage(Image(5000, 2, vec3(2.0f)), "wide")->pixels.width, 2500);
  EXPECT_THROW(makeSkyImage(Image(), "none"), InputError);
  EXPECT_TRUE(Sky::picture(makeSkyImage(Image(8, 4), "black")).isBlack());
}

TEST(Sky, SkiesWithEqualPixelsAreEqual) {
  EXPECT_EQ(test::cloudySky(), test::cloudySky());  // two pictures with the same pixels
  EXPECT_NE(test::cloudySky(), test::sunnySky());
  EXPECT_NE(test::gradientSky(), Sky(vec3(1.0f)));
  Sky turned = test::cloudySky();
  turned.rotation = 0.1f;
  EXPECT_NE(turned, test::cloudySky());
}

// For all kinds of skies: all samples have the same luminance, their sum is all light of the sky,
// and their irradiance on planes equals quadrature.
class SkyLight : public testing::TestWithParam<int> {
 protected:
  Sky sky() const {
    Sky s = GetParam() == 0   ? Sky(vec3(0.4f, 0.5f, 0.7f))
            : GetParam() == 1 ? test::gradientSky()
            : GetParam() == 2 ? test::cloudySky()
                              : test::sunnySky();
    if (s.kind == SkyKind::image) s.rotation = 0.7f, s.scale = 1.5f;
    return s;
  }
};

TEST_P(SkyLight, SamplesAddUpToTheSkysLight) {
  const SkySampler sampler(sky());
  constexpr uint32_t kCount = 4096;
  const vec3 normals[] = {{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0.6f, -0.8f}};
  vec3 all(0.0f), onPlane[4]{};
  for (uint32_t i = 0; i < kCount; ++i) {
    const SkyMap::Light light = sampler.sample(sobol2(i, 7));
    EXPECT_NEAR(glm::length(light.towards), 1.0f, 1e-5f);
    EXPECT_NEAR(luminance(light.irradiance) / luminance(sampler.irradiance()), 1.0f, 1e-4f);
    all += light.irradiance / static_cast<float>(kCount);
    for (int n = 0; n < 4; ++n)
      onPlane[n] += std::max(0.0f, glm::dot(light.towards, normals[n])) * light.irradiance /
                    static_cast<float>(kCount);
  }
  expectNear(all, sampler.irradiance(), 2e-3f);
  for (size_t s = 0; s < sampler.sunCount(); ++s) {
    const SkyMap::Light sun = sampler.sun(s);
    all += sun.irradiance;
    for (int n = 0; n < 4; ++n)
      onPlane[n] += std::max(0.0f, glm::dot(sun.towards, normals[n])) * sun.irradiance;
  }
  expectNear(all, test::irradianceOfAll(sky()), 4e-3f);
  for (int n = 0; n < 4; ++n) expectNear(onPlane[n], test::irradianceOn(sky(), normals[n]), 1e-2f);
}

// The sampling density: estimates equal quadrature, density() agrees with the samples, and its
// integral is 1.
TEST_P(SkyLight, ThePdfMatchesTheSamplesAndCoversAllLight) {
  const SkySampler sampler(sky());
  constexpr uint32_t kCount = 1 << 16;
  glm::dvec3 up(0.0);
  for (uint32_t i = 0; i < kCount; ++i) {
    const SkyMap::Direction d = sampler.sampleDensity(sobol2(i, 3));
    ASSERT_GT(d.pdf, 0.0f);
    EXPECT_NEAR(sampler.density(d.towards) / d.pdf, 1.0f, 1e-3f);
    up += glm::dvec3(sampler.radiance(d.towards) * (std::max(0.0f, d.towards.y) / d.pdf));
  }
  expectNear(vec3(up / static_cast<double>(kCount)), test::irradianceOn(sky(), vec3(0, 1, 0)),
             6e-3f);
  double total = 0.0;
  for (uint32_t i = 0; i < kCount; ++i) {
    const vec2 u = sobol2(i, 5);
    const float y = 2.0f * u.x - 1.0f, r = std::sqrt(1.0f - y * y);
    const vec3 d(r * std::cos(2.0f * kPi * u.y), y, r * std::sin(2.0f * kPi * u.y));
    const float density = sampler.density(d);
    total += static_cast<double>(4.0f * kPi * density / kCount);
    if (luminance(sampler.radiance(d)) > 0.0f) {
      EXPECT_GT(density, 0.0f);
    }
  }
  EXPECT_NEAR(total, 1.0, GetParam() == 3 ? 0.2 : 5e-3);  // few uniform directions hit the sun
}

INSTANTIATE_TEST_SUITE_P(Kinds, SkyLight, testing::Range(0, 4));

TEST(SkyMap, ASunIsFoundCompletelyAndOnlyOnce) {
  const SkySampler sampler(test::sunnySky());
  ASSERT_EQ(sampler.sunCount(), 1u);
  const float elevation = 40.0f / 180.0f * kPi;
  const vec3 expected(std::cos(elevation), std::sin(elevation), 0.0f);
  const SkyMap::Light sun = sampler.sun(0);
  expectDirection(sun.towards, expected, 0.002f);
  // A disc of radius 0.5° with pixels of 0.5°.
  const float solid = 2.0f * kPi * (1.0f - std::cos(0.5f / 180.0f * kPi));
  expectNear(sun.irradiance, solid * vec3(30000.0f, 25000.0f, 18000.0f), 0.2f);
  // The remaining sky without the sun consists of two uniform halves.
  expectNear(sampler.irradiance(), 2.0f * kPi * vec3(0.4f, 0.58f, 0.95f), 0.02f);
  for (uint32_t i = 0; i < 256; ++i)
    expectDirection(sampler.sun(0, sobol2(i, 1)).towards, expected, 0.016f);
  EXPECT_EQ(SkySampler(test::cloudySky()).sunCount(), 0u);
}

TEST(SkyMap, AConstantPictureIsAConstantSky) {
  const Sky picture = Sky::picture(makeSkyImage(Image(100, 50, vec3(0.25f, 0.5f, 1.0f)), "even"));
  const SkySampler a(picture), b(Sky(vec3(0.25f, 0.5f, 1.0f)));
  EXPECT_EQ(a.sunCount(), 0u);
  expectNear(a.irradiance(), b.irradiance(), 1e-5f);
  for (uint32_t i = 0; i < 64; ++i) {
    const vec3 d = a.sampleDensity(sobol2(i, 1)).towards;
    EXPECT_NEAR(a.density(d), b.density(d), 1e-4f);
    expectNear(a.radiance(d), b.radiance(d), 1e-6f);
  }
}

TEST(SkyMap, NeighbouringSamplesGiveNeighbouringDirections) {
  const SkySampler sampler(test::cloudySky());
  for (uint32_t i = 0; i < 64; ++i) {
    const vec2 u = 0.98f * sobol2(i, 1);
    EXPECT_LT(glm::length(sampler.sample(u).towards - sampler.sample(u + 1e-4f).towards), 0.01f);
  }
}

}  // namespace
}  // namespace lamplighter
