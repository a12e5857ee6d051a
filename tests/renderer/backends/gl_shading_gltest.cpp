// G-buffer, light sums and pictures of the gl backend against the cpu backend.
#include <fstream>

#include "renderer/backends/gl/gl_backend.h"
#include "renderer/gl/radiance_texture.h"
#include "renderer/image/metrics.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/images.h"
#include "tests/support/render.h"
#include "tests/support/scenes/gltf_files.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/random_boxes.h"
#include "tests/support/scenes/scenes.h"
#include "tests/support/scenes/skies.h"

namespace lamplighter {
namespace {

using GlShading = test::GlTest;
using test::differingShare;
using test::LitScene;
using test::lookAt;

View viewOfBoxes(int width = 160, int height = 120) {
  return lookAt(vec3(4.5f, 4.2f, 5.5f), vec3(-0.3f, 0.8f, -0.3f), width, height, 0.8f);
}

// Every kind of texture reference: wrapped, rotated, with the second texture coordinates, normal
// maps with and without tangents, emissive, alpha mask, vertex colours.
Scene texturedScene() {
  Scene scene;
  for (const uint32_t seed : {1u, 2u, 3u}) {
    auto image = std::make_shared<Image8>(8, 4);
    for (int i = 0; i < 8 * 4 * 4; ++i) {
      image->pixels[static_cast<size_t>(i)] = static_cast<uint8_t>((i * 73 + 41 * seed) % 256);
    }
    Texture& t = scene.textures.emplace_back();
    t.image = image;
    t.wrapS = seed == 1 ? Wrap::repeat : Wrap::mirror;
    t.wrapT = seed == 2 ? Wrap::clamp : Wrap::repeat;
    t.nearest = seed == 3;
  }
  const auto material = [&](auto&& fill) {
    fill(scene.materials.emplace_back());
    return static_cast<int>(scene.materials.size()) - 1;
  };
  const int plain = material([](Material& m) {
    m.baseColor = vec4(0.9f, 0.8f, 0.7f, 1.0f);
    m.baseColorTexture = {0, 0, vec2(0.1f, 0.3f), 0.5f, vec2(2.5f, 1.5f)};
  });
  const int mapped = material([](Material& m) {
    m.normalTexture = {1, 0, vec2(0.0f), 0.0f, vec2(3.0f)};
    m.normalScale = 0.4f;
  });
  const int masked = material([](Material& m) {
    m.baseColorTexture = {2, 0, vec2(0.0f), 0.0f, vec2(1.0f)};
    m.alphaMode = AlphaMode::mask;
  });
  const int glowing = material([](Material& m) {
    m.emissive = vec3(2.0f, 1.0f, 0.5f);
    m.emissiveTexture = {0, 1, vec2(0.0f), 0.0f, vec2(1.0f)};
    m.doubleSided = true;
  });
  test::addMesh(scene, test::squareMesh(6.0f, plain));
  test::addMesh(scene, test::boxMesh(vec3(1.2f), mapped), vec3(-1, 0.6f, 0));
  test::addMesh(scene, test::squareMesh(2.0f, masked), vec3(1, 0.8f, 0.5f));
  Mesh colored = *test::boxMesh(vec3(0.8f), glowing);
  Primitive& p = colored.primitives[0];
  for (size_t i = 0; i < p.positions.size(); ++i) {
    p.uv1.push_back(vec2(p.uv0[i].y, 1.0f - p.uv0[i].x));
    p.colors.push_back(vec4(0.1f * static_cast<float>(i % 7), 0.5f, 0.9f, 1.0f));
    p.tangents.push_back(vec4(glm::normalize(vec3(0.3f, 0.2f, 0.9f)), i % 2 == 0 ? 1.0f : -1.0f));
  }
  const NodeId id =
      test::addMesh(scene, std::make_shared<const Mesh>(std::move(colored)), vec3(1.4f, 0.4f, -1));
  scene.find(id)->local.rotation = glm::angleAxis(0.6f, glm::normalize(vec3(0.2f, 1, 0.1f)));
  scene.sky = vec3(0.1f, 0.2f, 0.4f);
  return scene;
}

TEST_F(GlShading, GBufferEqualsThatOfRays) {
  for (const Scene& scene : {test::randomBoxes(40, 7), texturedScene()}) {
    const bool textured = !scene.textures.empty();
    LitScene traced(scene), raster(scene, makeGlBackend());
    const View view = viewOfBoxes();
    for (const vec2& jitter : {vec2(0.0f), vec2(0.31f, -0.42f)}) {
      for (LitScene* lit : {&traced, &raster}) lit->backend->renderGBuffer(view, jitter);
      // Textures have 8 bits per channel and the filter weights of the GPU have 8 bits.
      const double normals = differingShare(
          raster.backend->readNormals(), traced.backend->readNormals(), textured ? 0.012f : 2e-3f);
      const double albedo = differingShare(raster.backend->readAlbedo(),
                                           traced.backend->readAlbedo(), textured ? 0.012f : 1e-4f);
      // Silhouettes; measured: at most 0.00016 and 0.00005.
      EXPECT_LT(normals, 0.001);
      EXPECT_LT(albedo, 0.001);
      const Image n = raster.backend->readNormals();
      double length = 0.0;
      for (const vec3& v : n.pixels) length += static_cast<double>(glm::length(v));
      EXPECT_GT(length, 0.3 * static_cast<double>(n.pixels.size()));
    }
  }
}

// The jitter moves the picture by the same offset as the rays of the cpu backend. On flat walls the
// comparison above would hardly detect an error.
TEST_F(GlShading, JitterMovesEdgesAsRaysDo) {
  Scene scene;
  test::addMesh(scene, test::boxMesh(vec3(1.0f), test::addMaterial(scene, vec3(1.0f))));
  LitScene traced(scene), raster(scene, makeGlBackend());
  const View view = lookAt(vec3(2, 1.5f, 3), vec3(0), 100, 80, 0.7f);
  std::vector<Image> pictures;
  for (const vec2& jitter : {vec2(-0.45f, -0.45f), vec2(0.45f, -0.45f), vec2(0.45f, 0.45f)}) {
    for (LitScene* lit : {&traced, &raster}) lit->backend->renderGBuffer(view, jitter);
    pictures.push_back(raster.backend->readNormals());
    EXPECT_LE(differingShare(pictures.back(), traced.backend->readNormals(), 1e-3f), 2.5 / 8000);
  }
  EXPECT_GT(differingShare(pictures[0], pictures[1], 1e-3f), 0.005);
  EXPECT_GT(differingShare(pictures[1], pictures[2], 1e-3f), 0.005);
}

// The background of a gradient and of rotated sky pictures, also with jitter, equals that of rays.
TEST_F(GlShading, TheSkyIsSeenWhereNothingIsHit) {
  Scene scene;
  test::addMesh(scene, test::boxMesh(vec3(0.5f), test::addMaterial(scene, vec3(0.5f))));
  std::vector<shared::Vpl> lamp{test::makeVpl(vec3(0, 3, 0), vec3(0, -1, 0))};
  lamp[0].slot = -1;
  for (Sky sky : {test::gradientSky(), test::cloudySky(), test::sunnySky()}) {
    sky.rotation = sky.kind == SkyKind::image ? 0.8f : 0.0f;
    scene.sky = sky;
    LitScene traced(scene), raster(scene, makeGlBackend());
    for (LitScene* lit : {&traced, &raster}) lit->kernels->reserveShadowMaps(1, 8);
    for (const vec3& target : {vec3(1, 0, 0.2f), vec3(-0.2f, 1, 0), vec3(0, -1, 0.3f)}) {
      const View view = lookAt(vec3(0, 0.1f, 0.7f), vec3(0, 0.1f, 0.7f) + target, 90, 60, 1.4f);
      for (const vec2& jitter : {vec2(0.0f), vec2(0.4f, -0.3f)}) {
        for (LitScene* lit : {&traced, &raster}) {
          lit->backend->renderGBuffer(view, jitter);
          lit->kernels->sumVpls(lamp, {}, nullptr);
        }
        const Image a = traced.kernels->compose()->pixels(),
                    b = raster.kernels->compose()->pixels();
        EXPECT_LE(differingShare(a, b, 2e-3f), 2.0 / 5400);
        const vec3 corner = sky.radianceFrom(view.rayDirection(0.5f + jitter.x, 0.5f + jitter.y));
        EXPECT_LT(glm::length(a.at(0, 0) - corner), 1e-4f);
      }
    }
  }
}

// The shadow maps agree except for a few texels. Due to rounding, a point on a texel border may use
// either texel, and a pixel on a silhouette may show either surface.
void expectSameLight(const Scene& scene, const std::vector<shared::Vpl>& vpls, double bound,
                     bool shadows = true) {
  LitScene traced(scene), raster(scene, makeGlBackend());
  const View view = viewOfBoxes();
  const Image a = raster.sum(vpls, view, 64, shadows, 0.1f);
  const Image b = traced.sum(vpls, view, 64, shadows, 0.1f);
  const float mean = (test::meanOf(b).r + test::meanOf(b).g + test::meanOf(b).b) / 3.0f;
  ASSERT_GT(mean, 0.0f);
  const double share = differingShare(a, b, 0.01f * mean);
  const Metrics m = compareImages(a, b);
  ::testing::Test::RecordProperty("differingPercent", std::to_string(100.0 * share));
  ::testing::Test::RecordProperty("relRmse", std::to_string(m.relRmse));
  EXPECT_LT(share, bound);
  EXPECT_NEAR(m.bias, 1.0, 0.001);
}

TEST_F(GlShading, LightWithoutShadowIsTheSame) {
  expectSameLight(test::randomBoxes(40, 7), test::randomVpls(60, 5), 0.001,
                  false);  // measured: 0.00016
}

TEST_F(GlShading, LightWithShadowsIsTheSame) {
  expectSameLight(test::randomBoxes(40, 7), test::randomVpls(60, 5), 0.006);  // measured: 0.0043
}

// More VPLs than fit into one pass, of every kind.
TEST_F(GlShading, ManyVplsOfEveryKindAreTheSame) {
  const Scene scene = test::randomBoxes(20, 9);
  const RenderScene render = test::renderSceneOf(scene);
  std::vector<shared::Vpl> vpls = test::randomVpls(1500, 13);
  for (size_t i = 0; i < vpls.size(); i += 5) {
    vpls[i].position.w = shared::kVplUniform;
    vpls[i].normal.w = i % 2 == 0 ? 0.0f : 3.0f;
    vpls[i].tangent.w = i % 2 == 0 ? 1.0f : -1.5f;
  }
  for (size_t i = 3; i < vpls.size(); i += 100) {
    vpls[i].position = vec4(render.bounds.centre(), shared::kVplDirectional);
    vpls[i].normal.w = render.bounds.radius();
    vpls[i].tangent.w = (i % 200 == 3 ? 1.0f : 0.3f) * render.bounds.radius();
  }
  expectSameLight(scene, vpls, 0.002);  // measured: 0.0008
}

TEST_F(GlShading, EmissionTexturesAndSkyAreTheSame) {
  LitScene traced(texturedScene()), raster(texturedScene(), makeGlBackend());
  for (const View& view :
       {viewOfBoxes(), lookAt(vec3(3, -2, 2), vec3(0, 0.5f, 0), 160, 120, 0.8f)}) {
    const Image a = raster.sum({}, view, 16), b = traced.sum({}, view, 16);
    const double share = differingShare(a, b, 0.025f);
    EXPECT_LT(share, 0.001);
    int sky = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) sky += a.pixels[i] == traced.render.sky.radiance;
    EXPECT_GT(sky, 500);
  }
}

TEST_F(GlShading, MaterialAndSkyChangesShow) {
  Scene before = texturedScene();
  LitScene lit(before, makeGlBackend());
  Scene after = before;
  after.materials[3].emissive = vec3(0.0f, 5.0f, 0.0f);
  after.materials[0].baseColorTexture = {};
  after.materials[1].alphaMode = AlphaMode::mask;
  after.materials[1].baseColor.a = 0.2f;  // below the cutoff: the whole object is a hole
  after.sky = vec3(3.0f);
  const RenderSceneChanges changes = update(lit.render, after, compare(before, after));
  ASSERT_FALSE(changes.rebuilt);
  lit.rays->update(changes);
  lit.backend->setScene(lit.render, changes, *lit.rays);
  LitScene fresh(after, makeGlBackend()), old(before, makeGlBackend());
  const std::vector vpls{test::makeVpl(vec3(0, 3, 0), vec3(0, -1, 0))};
  const Image now = lit.sum(vpls, viewOfBoxes(), 32);
  EXPECT_TRUE(test::sameBits(now, fresh.sum(vpls, viewOfBoxes(), 32)));
  EXPECT_FALSE(test::sameBits(now, old.sum(vpls, viewOfBoxes(), 32)));
}

TEST_F(GlShading, AHeldPictureDoesNotChangeWithLaterFrames) {
  LitScene lit(test::randomBoxes(10, 3), makeGlBackend());
  const std::vector vpls = test::randomVpls(3, 1);
  lit.sum(vpls, viewOfBoxes(), 16);
  const std::shared_ptr<RadianceImage> held = lit.kernels->compose();
  const std::shared_ptr<RadianceImage> second = lit.kernels->compose();
  ASSERT_NE(textureOf(*held), textureOf(*second));
  lit.sum({}, viewOfBoxes(), 16);
  EXPECT_GT(test::meanOf(held->pixels()).r, 0.0f);  // read back only now
  EXPECT_EQ(test::meanOf(lit.kernels->compose()->pixels()).r, 0.0f);
}

TEST_F(GlShading, APictureTooLargeForTheDeviceIsRefused) {
  LitScene lit(test::randomBoxes(1, 3), makeGlBackend());
  EXPECT_THROW(lit.backend->renderGBuffer(viewOfBoxes(1 << 20, 4), vec2(0.0f)), InputError);
}

TEST_F(GlShading, CountsItsWork) {
  LitScene lit(test::randomBoxes(10, 3), makeGlBackend());
  lit.sum(test::randomVpls(4, 1), viewOfBoxes(20, 10), 16);
  const BackendCounts counts = lit.backend->counts();
  const ManyLightsCounts lights = lit.kernels->lightCounts();
  EXPECT_EQ(lights.shadowMaps, 4u);
  EXPECT_EQ(counts.rays, 0u);
  EXPECT_EQ(lights.lightPixels, 4u * 200u);
  EXPECT_GE(counts.memoryBytes, 4u * 16 * 16 * sizeof(float) + 20u * 10 * 16);
  EXPECT_EQ(lit.backend->info().name, "gl");
  EXPECT_EQ(lit.backend->info().device, context().renderer());
}

TEST_F(GlShading, ABrokenShaderLeavesTheWorkingOneInUse) {
  LitScene lit(test::randomBoxes(10, 3), makeGlBackend());
  const Image before = lit.sum(test::randomVpls(4, 1), viewOfBoxes(), 16);
  const test::TemporaryFolder folder;
  std::filesystem::copy(
      gl::defaultShaderFolder(), folder.path(),
      std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing);
  std::ofstream(folder.path() / "passes/compose.frag.glsl", std::ios::app) << "nonsense\n";
  EXPECT_THROW(reloadShaders(*lit.backend, folder.path()), gl::ShaderError);
  context().debugLog()->clear();
  EXPECT_TRUE(test::sameBits(before, lit.sum(test::randomVpls(4, 1), viewOfBoxes(), 16)));
  reloadShaders(*lit.backend, gl::defaultShaderFolder());
  EXPECT_TRUE(test::sameBits(before, lit.sum(test::randomVpls(4, 1), viewOfBoxes(), 16)));
}

// A complete picture of many_lights with direct and indirect light.
class GlManyLights : public test::GlTest {
 protected:
  static Image render(std::unique_ptr<Backend> backend) {
    Scene scene = test::randomBoxes(12, 7);
    test::addRectangleLight(scene, vec3(0, 3.9f, 0), vec2(1.5f), vec3(12.0f));
    Settings settings;
    settings.set("vpls", 128);
    settings.set("indirect", std::string("samples"));
    settings.set("bounces", 1);
    FrameRenderer renderer(std::move(backend));
    return test::renderSettled(renderer, scene, SceneChanges::all(), viewOfBoxes(), settings)
        .radiance->pixels();
  }
};

TEST_F(GlManyLights, GivesThePictureOfTheCpuBackend) {
  Image gl = render(makeGlBackend());
  const Image cpu = render(makeCpuBackend());
  // A face seen edge-on may be visible on one backend only: these pixels are compared separately.
  int silhouettes = 0;
  for (size_t i = 0; i < gl.pixels.size(); ++i) {
    if (glm::length(gl.pixels[i] - cpu.pixels[i]) < 0.1f) continue;
    gl.pixels[i] = cpu.pixels[i];
    ++silhouettes;
  }
  EXPECT_LE(silhouettes, 4);  // of 19,200; measured: 1
  const Metrics m = compareImages(gl, cpu);
  RecordProperty("relRmse", std::to_string(m.relRmse));
  EXPECT_LT(m.relRmse, 0.004);  // measured: 0.0023
  EXPECT_NEAR(m.bias, 1.0, 0.001);
}

TEST_F(GlManyLights, HasTheSameBitsEachTime) {
  const Image first = render(makeGlBackend());
  EXPECT_TRUE(test::sameBits(first, render(makeGlBackend())));
  // A context of its own, as on the command line.
  EXPECT_TRUE(
      test::sameBits(first, render(makeGlBackend(std::make_unique<gl::HeadlessContext>(true)))));
  context().makeCurrent();
}

}  // namespace
}  // namespace lamplighter
