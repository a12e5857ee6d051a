// Emitters with textures: light samples are placed where the light is.
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/base/low_discrepancy.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/sampling/vpl_footprints.h"
#include "renderer/sampling/vpl_set.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

constexpr int kPixels = 32;

// Value `dim`, except for 255 in the upper left corner, which has an eighth of each side.
std::shared_ptr<Image8> brightCorner(uint8_t dim) {
  auto image = std::make_shared<Image8>(kPixels, kPixels);
  for (int y = 0; y < kPixels; ++y) {
    for (int x = 0; x < kPixels; ++x) {
      for (int c = 0; c < 3; ++c) image->at(x, y)[c] = x < 4 && y < 4 ? 255 : dim;
    }
  }
  return image;
}

struct Lit {
  Scene scene;
  RenderScene world;
  LightSet lights;

  // A square of 2 m that faces up.
  explicit Lit(std::shared_ptr<const Image8> image, bool nearest = false, bool twoSided = false) {
    scene.textures.push_back({"pattern", image, Wrap::clamp, Wrap::clamp, nearest, false});
    const int glowing = test::addMaterial(scene, vec3(0.0f), vec3(10.0f, 5.0f, 2.0f));
    scene.materials[0].emissiveTexture.texture = 0;
    scene.materials[0].doubleSided = twoSided;
    test::addMesh(scene, test::squareMesh(2.0f, glowing));
    see();
  }
  void see() {
    update(world, scene, SceneChanges::all());
    lights = LightSet(world, lights);
  }
};

TEST(TexturedEmitters, TheMeanOfManySamplesIsTheClosedFormFlux) {
  const Lit lit(brightCorner(0));
  const vec3 expected = kPi * 4.0f / 64.0f * vec3(10, 5, 2);
  EXPECT_NEAR(lit.lights.emitters()[0].flux.g / expected.g, 1.0f, 2e-3f);
  glm::dvec3 sum(0.0);
  constexpr uint32_t n = 1 << 14;
  for (uint32_t i = 0; i < n; ++i) {
    const EmitterPoint p = lit.lights.samplePoint(lit.world, 0, sobol2(i, 5));
    sum += glm::dvec3(kPi * p.area * p.radiance);
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / n, expected[c], 5e-3 * expected[c]) << c;
}

// ∫ pdf dA over the surface is 1, and the pdf that weighs hits equals that of the samples.
TEST(TexturedEmitters, SamplingAndWeighingUseTheSamePdf) {
  const Lit lit(brightCorner(40), true);
  double whole = 0.0;
  constexpr int kGrid = 256;
  for (uint32_t triangle = 0; triangle < 2; ++triangle) {
    for (int y = 0; y < kGrid; ++y) {
      for (int x = 0; x + y < kGrid; ++x) {
        const vec2 at((static_cast<float>(x) + 0.3f) / kGrid,
                      (static_cast<float>(y) + 0.3f) / kGrid);
        // A grid cell contains two such triangles, except for the last one of a row.
        const double cells = x + y + 1 < kGrid ? 2.0 : 1.0;
        whole +=
            cells * 2.0 / (kGrid * kGrid) / static_cast<double>(lit.lights.areaAt(0, triangle, at));
      }
    }
  }
  EXPECT_NEAR(whole, 1.0, 2e-2);
  const RayCaster rays(lit.world);
  for (uint32_t i = 0; i < 1024; ++i) {
    const EmitterPoint p = lit.lights.samplePoint(lit.world, 0, sobol2(i, 7));
    const Hit hit = rays.intersect({p.position + vec3(0, 1, 0), 0.0f, vec3(0, -1, 0)});
    ASSERT_TRUE(static_cast<bool>(hit));
    const float area = lit.lights.areaAt(0, hit.triangle, vec2(hit.u, hit.v));
    EXPECT_NEAR(area * p.pdfArea, 1.0f, 1e-4f) << i;
  }
}

TEST(TexturedEmitters, LightSamplesAreWhereItIsBright) {
  for (const bool twoSided : {false, true}) {
    const Lit lit(brightCorner(0), false, twoSided);
    const RayCaster rays(lit.world);
    VplSet set = generateVpls(lit.world, rays, lit.lights, {256, 1.0f, 0, 1});
    findFootprints(lit.lights, set.vpls);
    ASSERT_GT(set.vpls.size(), 240u);
    float flux = 0.0f;
    for (const SceneVpl& v : set.vpls) {
      // The bright corner plus half a texel of interpolation.
      EXPECT_LT(v.vpl.position.x, -0.71f);
      EXPECT_GT(v.vpl.position.z, 0.71f);  // v = 0
      flux += kPi * v.vpl.intensity.r;
      // The footprint is a part of the bright corner, not of the whole square.
      EXPECT_LT(v.vpl.footprint.x, 0.05f);
    }
    const float expected = kPi * 4.0f / 64.0f * 10.0f * (twoSided ? 2.0f : 1.0f);
    EXPECT_NEAR(flux / expected, 1.0f, 0.05f);
  }
}

// The data for a mesh and its texture is kept through edits, and equals newly computed data.
TEST(TexturedEmitters, MovingReusesTheData) {
  Lit lit(brightCorner(20));
  const auto before = lit.lights.emitters()[0].cells.brightness();
  lit.scene.nodes[0].local.translation = vec3(1, 2, 3);
  lit.scene.materials[0].emissive = vec3(0.0f, 9.0f, 0.0f);
  lit.see();
  EXPECT_EQ(lit.lights.emitters()[0].cells.brightness(), before);
  const LightSet fresh(lit.world);
  EXPECT_EQ(fresh.emitters()[0].flux, lit.lights.emitters()[0].flux);
  for (uint32_t i = 0; i < 64; ++i) {
    const vec2 u = sobol2(i, 1);
    EXPECT_EQ(fresh.samplePoint(lit.world, 0, u).position,
              lit.lights.samplePoint(lit.world, 0, u).position);
  }
  lit.scene.textures[0].image = brightCorner(90);
  lit.see();
  EXPECT_NE(lit.lights.emitters()[0].cells.brightness(), before);
}

TEST(TexturedEmitters, ABlackTextureMakesNoEmitter) {
  const Lit lit(std::make_shared<Image8>([] {
    Image8 image(2, 2);
    for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = i % 4 == 3 ? 255 : 0;
    return image;
  }()));
  EXPECT_TRUE(lit.lights.emitters().empty());
}

}  // namespace
}  // namespace lamplighter
