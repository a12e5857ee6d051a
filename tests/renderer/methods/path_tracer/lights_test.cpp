// The path tracer against closed forms for every kind of light and receiver: shapes, textures,
// alpha masks, sides, normal maps, and all kinds of light at once.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

#include <gtest/gtest.h>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/folders.h"
#include "tests/support/render.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"
#include "tests/support/scenes/skies.h"

namespace lamplighter {
namespace {

using test::lookAt;
using test::meanOf;
using test::polygonFormFactor;
using test::renderReference;

constexpr float kRho = 0.6f;

Scene floorScene() {
  Scene scene;
  const int material = test::addMaterial(scene, vec3(kRho));
  test::addMesh(scene, test::squareMesh(40.0f, material));
  return scene;
}

// The radiance of the floor at x, with direct light only.
float floorRadiance(const Scene& scene, const vec3& x, int samples = 256, uint32_t seed = 1) {
  const View view = lookAt(x + vec3(0.3f, 1.0f, 0.4f), x, 4, 4, 0.005f);
  return meanOf(renderReference(scene, view, samples, 0, seed)).r;
}

// A square emitter of side 2, two metres above the floor, facing down.
Scene underEmissiveSquare(Material glow) {
  Scene scene = floorScene();
  const int material = test::addMaterial(scene, vec3(0.0f));
  scene.materials[material] = std::move(glow);
  const NodeId id = test::addMesh(scene, test::squareMesh(2.0f, material), vec3(0, 2, 0));
  scene.find(id)->local.rotation = glm::angleAxis(kPi, vec3(0, 0, 1));  // local +x is world −x
  return scene;
}

Material glowing(float radiance) {
  Material m;
  m.baseColor = vec4(0, 0, 0, 1);
  m.emissive = vec3(radiance);
  return m;
}

// A texture of two texels, left and right, without filtering.
Texture halves(const std::array<uint8_t, 4>& left, const std::array<uint8_t, 4>& right) {
  auto image = std::make_shared<Image8>(2, 1);
  std::copy(left.begin(), left.end(), image->at(0, 0));
  std::copy(right.begin(), right.end(), image->at(1, 0));
  return {"halves", image, Wrap::clamp, Wrap::clamp, true, false};
}

// The right half of the texture is where the square's local x > 0: world x in [−1, 0].
const std::vector<vec3> kRightHalf{{-1, 2, -1}, {0, 2, -1}, {0, 2, 1}, {-1, 2, 1}};

TEST(ReferenceLights, ADiskOnItsAxis) {
  Scene scene = floorScene();
  const NodeId id = test::addRectangleLight(scene, vec3(0, 1.5f, 0), vec2(1.0f), vec3(5.0f));
  scene.find(id)->area->shape = AreaShape::disk;
  scene.find(id)->area->size = vec2(1.6f);
  // F = r²/(r² + h²)
  const float expected = kRho * 5.0f * 0.64f / (0.64f + 2.25f);
  EXPECT_NEAR(floorRadiance(scene, vec3(0)) / expected, 1.0f, 3e-3f);
}

// Uniform over all rotations (Shoemake, "Uniform Random Rotations", Graphics Gems III, 1992).
quat uniformRotation(vec2 u, float v) {
  const float a = std::sqrt(1.0f - v), b = std::sqrt(v);
  const vec2 angle = 2.0f * kPi * u;
  return {a * std::sin(angle.x), a * std::cos(angle.x), b * std::sin(angle.y),
          b * std::cos(angle.y)};
}

// F = r² cos θ / d² for a sphere completely above the horizon. The sphere is a polyhedron with the
// same area. Its light is the same only on average over all rotations (Cauchy: the mean projected
// area of a convex body is a quarter of its surface).
TEST(ReferenceLights, ASphereAboveAndToTheSide) {
  Scene scene = floorScene();
  const NodeId id = test::addRectangleLight(scene, vec3(0, 2, 0), vec2(1.0f), vec3(5.0f));
  scene.find(id)->area->shape = AreaShape::sphere;
  scene.find(id)->area->size = vec2(1.0f);
  constexpr uint32_t kRotations = 64;
  for (const float x : {0.0f, 0.5f, 1.0f, 2.0f, 4.0f}) {
    const float d2 = 4.0f + x * x;
    const float expected = kRho * 5.0f * 0.25f * (2.0f / std::sqrt(d2)) / d2;
    float sum = 0.0f;
    for (uint32_t i = 0; i < kRotations; ++i) {
      scene.find(id)->local.rotation = uniformRotation(sobol2(i, 1), sobol2(i, 2).x);
      sum += floorRadiance(scene, vec3(x, 0, 0), 256, i + 1) / expected;
    }
    EXPECT_NEAR(sum / kRotations, 1.0f, 4e-3f) << x;
  }
}

TEST(ReferenceLights, OnlyTheBrightHalfOfAnEmissiveTextureEmits) {
  Material m = glowing(6.0f);
  m.emissiveTexture.texture = 0;
  Scene scene = underEmissiveSquare(m);
  scene.textures.push_back(halves({0, 0, 0, 255}, {255, 255, 255, 255}));
  for (const vec3& x : {vec3(0), vec3(-1, 0, 0.5f), vec3(1.5f, 0, 0)}) {
    const double expected = 6.0 * kRho * polygonFormFactor(x, vec3(0, 1, 0), kRightHalf);
    EXPECT_NEAR(floorRadiance(scene, x, 1024) / expected, 1.0, 6e-3) << x.x;
  }
}

TEST(ReferenceLights, HolesOfAnAlphaMaskEmitNoLight) {
  Material m = glowing(6.0f);
  m.alphaMode = AlphaMode::mask;
  m.baseColorTexture.texture = 0;
  Scene scene = underEmissiveSquare(m);
  scene.textures.push_back(halves({255, 255, 255, 0}, {255, 255, 255, 255}));
  const double expected = 6.0 * kRho * polygonFormFactor(vec3(0), vec3(0, 1, 0), kRightHalf);
  EXPECT_NEAR(floorRadiance(scene, vec3(0), 1024) / expected, 1.0, 6e-3);
}

TEST(ReferenceLights, TheBackIsDarkUnlessTheMaterialIsDoubleSided) {
  for (const bool doubleSided : {false, true}) {
    Material m = glowing(6.0f);
    m.doubleSided = doubleSided;
    Scene scene = underEmissiveSquare(m);
    scene.nodes.back().local.rotation = quat(1, 0, 0, 0);  // its back faces the floor
    const double form =
        polygonFormFactor(vec3(0), vec3(0, 1, 0), {{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}});
    const double expected = doubleSided ? 6.0 * kRho * form : 0.0;
    EXPECT_NEAR(floorRadiance(scene, vec3(0)), expected, 5e-3 * expected) << doubleSided;
    const View below = lookAt(vec3(0.2f, 0.5f, 0), vec3(0, 2, 0), 4, 4, 0.1f);
    EXPECT_FLOAT_EQ(meanOf(renderReference(scene, below, 4, 0)).r, doubleSided ? 6.0f : 0.0f);
  }
}

// E = π L_sky (1 − F) + π L F + I cos θ/d² + E_sun cos θ: the area light hides its part of the sky.
TEST(ReferenceLights, AllKindsTogetherAddUp) {
  Scene scene = floorScene();
  scene.sky = vec3(0.7f);
  test::addRectangleLight(scene, vec3(0.5f, 2.0f, -0.3f), vec2(1.5f, 0.8f), vec3(7.0f));
  const NodeId lamp = test::addNode(scene, "lamp", kNoNode, vec3(-1, 1, 0));
  scene.find(lamp)->punctual = PunctualLight{PunctualKind::point, vec3(2.0f)};
  const NodeId sun = test::addNode(scene, "sun");
  scene.find(sun)->local.rotation = glm::angleAxis(-0.25f * kPi, vec3(1, 0, 0));
  scene.find(sun)->punctual = PunctualLight{PunctualKind::directional, vec3(1.5f)};
  const double form = polygonFormFactor(
      vec3(0), vec3(0, 1, 0),
      {{-0.25f, 2, -0.7f}, {1.25f, 2, -0.7f}, {1.25f, 2, 0.1f}, {-0.25f, 2, 0.1f}});
  const double pi = static_cast<double>(kPi);
  const double irradiance = pi * 0.7 * (1.0 - form) + pi * 7.0 * form +
                            2.0 / (2.0 * std::sqrt(2.0)) + 1.5 / std::sqrt(2.0);
  EXPECT_NEAR(floorRadiance(scene, vec3(0), 1024) / (kRho / pi * irradiance), 1.0, 6e-3);
}

// E = π (horizon + 2/3 (zenith − horizon)). The ground colour is below the horizon and does not
// count.
TEST(ReferenceLights, AGradientSkyAboveTheFloor) {
  Scene scene = floorScene();
  scene.sky = Sky::gradient(vec3(3.0f), vec3(1.2f), vec3(100.0f));
  const float expected = kRho * (1.2f + 2.0f / 3.0f * 1.8f);
  EXPECT_NEAR(floorRadiance(scene, vec3(0)) / expected, 1.0f, 4e-3f);
}

// A rotated and scaled sky picture with a sun, against quadrature over its interpolated pixels.
TEST(ReferenceLights, ASkyPictureAboveTheFloor) {
  for (const Sky& picture : {test::cloudySky(), test::sunnySky()}) {
    Scene scene = floorScene();
    scene.sky = picture;
    scene.sky.rotation = 1.3f;
    scene.sky.scale = 0.4f;
    const vec3 expected = kRho / kPi * test::irradianceOn(scene.sky, vec3(0, 1, 0));
    const View view = lookAt(vec3(0.3f, 1.0f, 0.4f), vec3(0), 4, 4, 0.005f);
    const vec3 actual = meanOf(renderReference(scene, view, 1024, 0));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c] / expected[c], 1.0f, 6e-3f) << c;
  }
}

// A sky picture of one colour equals the constant sky: the same light, the same background.
TEST(ReferenceLights, AConstantPictureIsTheConstantSky) {
  const View view = lookAt(vec3(1.5f, 0.8f, 2.5f), vec3(0, 0.4f, 0), 32, 24);
  Scene scene;
  test::addMesh(scene, test::squareMesh(4.0f, test::addMaterial(scene, vec3(kRho))));
  test::addMesh(scene, test::boxMesh(vec3(0.8f), 0), vec3(0, 0.4f, 0));
  scene.sky = vec3(0.5f, 0.7f, 0.9f);
  const Image constant = renderReference(scene, view, 256, 2);
  scene.sky = Sky::picture(makeSkyImage(Image(64, 32, vec3(0.5f, 0.7f, 0.9f)), "even"));
  const Metrics m = compareImages(renderReference(scene, view, 256, 2), constant);
  EXPECT_LT(m.relRmse, 0.02);
  EXPECT_NEAR(m.bias, 1.0, 1e-3);
}

// A floor whose normal map tilts all normals by the same angle towards +x.
struct TiltedFloor {
  Scene scene = floorScene();
  float cosine = 0.0f;

  TiltedFloor() {
    auto image = std::make_shared<Image8>(1, 1);
    const std::array<uint8_t, 4> texel{230, 128, 179, 255};
    std::copy(texel.begin(), texel.end(), image->at(0, 0));
    scene.textures.push_back({"tilt", image});
    scene.materials[0].normalTexture.texture = 0;
    auto mesh = std::make_shared<Mesh>(*scene.meshes[0]);
    mesh->primitives[0].tangents.assign(4, vec4(1, 0, 0, 1));
    scene.meshes[0] = mesh;
    const vec3 n = glm::normalize(
        vec3(230.0f / 127.5f - 1.0f, 128.0f / 127.5f - 1.0f, 179.0f / 127.5f - 1.0f));
    cosine = n.z;
  }
};

TEST(ReferenceLights, SunlightFollowsTheCosineToTheMappedNormal) {
  TiltedFloor tilted;
  const NodeId sun = test::addNode(tilted.scene, "sun");
  tilted.scene.find(sun)->local.rotation = glm::angleAxis(-0.5f * kPi, vec3(1, 0, 0));
  tilted.scene.find(sun)->punctual = PunctualLight{PunctualKind::directional, vec3(3.0f)};
  EXPECT_NEAR(floorRadiance(tilted.scene, vec3(0), 4), kRho / kPi * 3.0f * tilted.cosine, 1e-4f);
}

// Light from below the geometric surface does not count, for any tilt of the shading normal. Of a
// constant sky, (1 + cos α)/2 is left.
TEST(ReferenceLights, AMappedNormalLeaksNoLightFromBelow) {
  TiltedFloor tilted;
  tilted.scene.sky = vec3(2.0f);
  const float expected = kRho * 2.0f * 0.5f * (1.0f + tilted.cosine);
  EXPECT_NEAR(floorRadiance(tilted.scene, vec3(0), 1024) / expected, 1.0f, 5e-3f);

  // A lamp below the plane of the floor, but above the horizon of the tilted normal.
  tilted.scene.sky = vec3(0.0f);
  const NodeId lamp = test::addNode(tilted.scene, "lamp", kNoNode, vec3(22, -0.5f, 0));
  tilted.scene.find(lamp)->punctual = PunctualLight{PunctualKind::point, vec3(1000.0f)};
  EXPECT_EQ(floorRadiance(tilted.scene, vec3(19.9f, 0, 0), 4), 0.0f);
}

// The rendered picture of references/scenes/patch.gltf against that of the closed form.
TEST(ReferenceLights, ThePatchEqualsTheClosedFormInAllPixels) {
  const auto folder = test::sharedFolder() / "references";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  const Scene scene = loadGltf(folder / "scenes" / "patch.gltf").scene;
  const Image expected = readImage(folder / "refs" / "patch_analytic.exr");
  const View view = test::viewOf(scene, expected.width, expected.height);
  const Image image = renderReference(scene, view, 16, 3);
  // The closed form has 4×4 points per pixel at edges. A pixel counts as floor if no pixel in its
  // neighbourhood is black or shows the light.
  const auto isFloor = [&](int x, int y) {
    for (int i = 0; i < 9; ++i) {
      const float r = expected.at(x - 1 + i % 3, y - 1 + i / 3).r;
      if (r < 0.01f || r > 0.5f) return false;
    }
    return true;
  };
  Image floor(image.width, image.height);
  int count = 0;
  for (int y = 1; y + 1 < image.height; ++y) {
    for (int x = 1; x + 1 < image.width; ++x) {
      if (!isFloor(x, y)) continue;
      floor.at(x, y) = vec3(1.0f);
      ++count;
    }
  }
  EXPECT_GT(count, 50000);
  const Metrics m = compareImages(image, expected, &floor);
  RecordProperty("relRmse", std::to_string(m.relRmse));
  RecordProperty("bias", std::to_string(m.bias));
  EXPECT_NEAR(m.bias, 1.0, 5e-4);
  // In blocks that contain only floor, the noise of 16 paths per pixel is small.
  constexpr int kSide = 16;
  Image ours(image.width / kSide, image.height / kSide), theirs = ours, whole = ours;
  for (int by = 0; by < ours.height; ++by) {
    for (int bx = 0; bx < ours.width; ++bx) {
      bool all = true;
      for (int i = 0; i < kSide * kSide; ++i) {
        const int x = kSide * bx + i % kSide, y = kSide * by + i / kSide;
        ours.at(bx, by) += image.at(x, y) / static_cast<float>(kSide * kSide);
        theirs.at(bx, by) += expected.at(x, y) / static_cast<float>(kSide * kSide);
        all = all && floor.at(x, y).r > 0.0f;
      }
      whole.at(bx, by) = vec3(all ? 1.0f : 0.0f);
    }
  }
  const double blocks = compareImages(ours, theirs, &whole).relRmse;
  RecordProperty("relRmseOfBlocks", std::to_string(blocks));
  EXPECT_LT(blocks, 0.005);
}

}  // namespace
}  // namespace lamplighter
