#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/base/alias_table.h"
#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/sampling/emitters/lights.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

TEST(AliasTable, SamplesInProportionAndNeverWeightZero) {
  const std::vector<float> weights{1.0f, 0.0f, 3.0f, 6.0f};
  const AliasTable table(weights);
  std::vector<int> drawn(4);
  constexpr int kDraws = 100000;
  double rest = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    float remapped;
    ++drawn[table.sample((static_cast<float>(i) + 0.5f) / kDraws, remapped)];
    ASSERT_GE(remapped, 0.0f);
    ASSERT_LT(remapped, 1.0f);
    rest += static_cast<double>(remapped);
  }
  EXPECT_EQ(drawn[1], 0);
  EXPECT_NEAR(drawn[0], 0.1 * kDraws, 5);
  EXPECT_NEAR(drawn[2], 0.3 * kDraws, 5);
  EXPECT_NEAR(drawn[3], 0.6 * kDraws, 5);
  EXPECT_NEAR(rest / kDraws, 0.5, 1e-3);
  EXPECT_TRUE(AliasTable(std::vector<float>{0.0f, 0.0f}).empty());
}

// Every elementary interval of area 2⁻ᵐ contains exactly one of the first 2ᵐ points.
TEST(LowDiscrepancy, IsANetInBase2) {
  constexpr int m = 6, n = 1 << m;
  for (const bool ordered : {false, true}) {
    for (int split = 0; split <= m; ++split) {
      std::vector<int> count(n);
      for (uint32_t i = 0; i < n; ++i) {
        const vec2 p = ordered ? sobol2Ordered(i, 77) : sobol2(i, 77);
        ASSERT_TRUE(p.x >= 0.0f && p.x < 1.0f && p.y >= 0.0f && p.y < 1.0f);
        const int column = static_cast<int>(p.x * static_cast<float>(1 << split));
        const int row = static_cast<int>(p.y * static_cast<float>(1 << (m - split)));
        ++count[(row << split) + column];
      }
      EXPECT_EQ(*std::max_element(count.begin(), count.end()), 1)
          << "split " << split << " ordered " << ordered;
    }
  }
}

TEST(Random, CosineDirectionsHaveTheirMoments) {
  double z = 0.0;
  constexpr uint32_t n = 4096;
  for (uint32_t i = 0; i < n; ++i) {
    const vec3 d = sampleCosineHemisphere(sobol2(i, 5));
    ASSERT_NEAR(glm::length(d), 1.0f, 1e-5f);
    z += static_cast<double>(d.z);
  }
  EXPECT_NEAR(z / n, 2.0 / 3.0, 1e-3);  // E[cos θ] under cos θ/π
}

struct LightsOf {
  RenderScene world;
  LightSet lights;
  explicit LightsOf(const Scene& scene) {
    update(world, scene, SceneChanges::all());
    lights = LightSet(world);
  }
};

TEST(LightSet, FluxEqualsTheSumOfTheLights) {
  Scene scene;
  test::addMesh(scene, test::boxMesh(vec3(2.0f)));
  test::addRectangleLight(scene, vec3(0, 3, 0), vec2(2.0f, 0.5f), vec3(10, 20, 30));
  const NodeId p = test::addNode(scene, "point");
  scene.find(p)->punctual = PunctualLight{PunctualKind::point, vec3(3.0f)};
  const LightsOf s(scene);
  ASSERT_EQ(s.lights.emitters().size(), 2u);
  EXPECT_NEAR(s.lights.emitters()[0].flux.g, kPi * 20.0f, 1e-3f);
  EXPECT_NEAR(s.lights.emitters()[1].flux.r, 4.0f * kPi * 3.0f, 1e-3f);
  EXPECT_EQ(s.lights.emitterOfObject(0), kNone);
  EXPECT_EQ(s.lights.emitterOfObject(1), 0);
}

TEST(LightSet, PointsAreUniformOnTheLight) {
  Scene scene;
  test::addRectangleLight(scene, vec3(1, 3, 2), vec2(2.0f, 1.0f), vec3(5.0f));
  const LightsOf s(scene);
  vec3 sum(0.0f);
  constexpr uint32_t n = 1024;
  for (uint32_t i = 0; i < n; ++i) {
    const EmitterPoint p = s.lights.samplePoint(s.world, 0, sobol2(i, 9));
    EXPECT_NEAR(p.position.y, 3.0f, 1e-5f);
    EXPECT_LE(std::abs(p.position.x - 1.0f), 1.00001f);
    EXPECT_LE(std::abs(p.position.z - 2.0f), 0.50001f);
    EXPECT_NEAR(p.normal.y, -1.0f, 1e-5f);
    EXPECT_EQ(p.radiance, vec3(5.0f));
    EXPECT_NEAR(p.pdfArea, 0.5f, 1e-5f);
    sum += p.position;
  }
  EXPECT_NEAR(sum.x / n, 1.0f, 5e-3f);
  EXPECT_NEAR(sum.z / n, 2.0f, 5e-3f);
}

// A triangle without area is never sampled, and an object of such triangles is not an emitter.
TEST(LightSet, SkipsTrianglesWithoutArea) {
  Scene scene;
  const int glowing = test::addMaterial(scene, vec3(0.0f), vec3(4.0f));
  auto mesh = std::make_shared<Mesh>(*test::squareMesh(1.0f, glowing));
  mesh->primitives[0].indices.insert(mesh->primitives[0].indices.begin(), {0, 0, 1, 2, 1, 2});
  test::addMesh(scene, mesh);
  auto flat = std::make_shared<Mesh>(*mesh);
  flat->primitives[0].indices.resize(6);
  test::addMesh(scene, flat);
  const LightsOf s(scene);
  ASSERT_EQ(s.lights.emitters().size(), 1u);
  EXPECT_FLOAT_EQ(s.lights.emitters()[0].area, 1.0f);
  EXPECT_EQ(s.lights.emitterOfObject(1), kNone);
  for (uint32_t i = 0; i < 256; ++i) {
    const EmitterPoint p = s.lights.samplePoint(s.world, 0, sobol2(i, 3));
    EXPECT_NEAR(p.normal.y, 1.0f, 1e-6f);
    EXPECT_TRUE(std::isfinite(p.position.x + p.position.z + p.pdfArea));
  }
}

// A square with an eighth of each side of the texture emits: 1/64 of the area.
TEST(LightSet, TheFluxOfATextureFollowsItsMean) {
  Scene scene;
  auto image = std::make_shared<Image8>(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      for (int c = 0; c < 3; ++c)
        image->at(x, y)[c] = x >= 40 && x < 48 && y >= 16 && y < 24 ? 255 : 0;
    }
  }
  scene.textures.push_back({"spot", image});
  const int glowing = test::addMaterial(scene, vec3(0.0f), vec3(10.0f));
  scene.materials[glowing].emissiveTexture.texture = 0;
  test::addMesh(scene, test::squareMesh(2.0f, glowing));
  const LightsOf s(scene);
  ASSERT_EQ(s.lights.emitters().size(), 1u);
  const float expected = kPi * 4.0f * 10.0f / 64.0f;
  EXPECT_NEAR(s.lights.emitters()[0].flux.g / expected, 1.0f, 0.05f);
}

TEST(LightSet, HolesOfAnAlphaMaskEmitNothing) {
  Scene scene;
  auto image = std::make_shared<Image8>(2, 1);
  image->at(0, 0)[3] = 0;  // the left half
  scene.textures.push_back({"half", image, Wrap::clamp, Wrap::clamp, true, false});
  const int glowing = test::addMaterial(scene, vec3(1.0f), vec3(3.0f));
  scene.materials[glowing].alphaMode = AlphaMode::mask;
  scene.materials[glowing].baseColorTexture.texture = 0;
  test::addMesh(scene, test::squareMesh(2.0f, glowing));
  const LightsOf s(scene);
  ASSERT_EQ(s.lights.emitters().size(), 1u);
  EXPECT_NEAR(s.lights.emitters()[0].flux.r / (kPi * 2.0f * 3.0f), 1.0f, 0.01f);
  for (uint32_t i = 0; i < 256; ++i) {
    const EmitterPoint p = s.lights.samplePoint(s.world, 0, sobol2(i, 3));
    EXPECT_EQ(p.radiance.r, p.position.x < 0.0f ? 0.0f : 3.0f) << p.position.x;
  }
}

TEST(LightSet, ASceneWithoutLightHasNoEmitters) {
  Scene scene;
  test::addMesh(scene, test::boxMesh(vec3(2.0f)));
  const LightsOf s(scene);
  float p;
  EXPECT_EQ(s.lights.chooseSurface(vec3(0.0f), 0.5f, p), kNone);
}

TEST(PathSampler, NumbersDoNotDependOnWhatIsLeftOut) {
  for (uint32_t sample = 0; sample < 64; ++sample) {
    PathSampler all(5, sample, 9), few(5, sample, 9);
    EXPECT_EQ(few.next1(), all.next2().x);
    all.next2();
    few.skip();
    EXPECT_EQ(few.next2(), all.next2());
  }
}

}  // namespace
}  // namespace lamplighter
