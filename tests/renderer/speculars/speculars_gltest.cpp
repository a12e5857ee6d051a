// Speculars on the gl backend give the pictures of the cpu backend.
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/images.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/random_boxes.h"
#include "tests/support/scenes/scenes.h"
#include "tests/support/shared_files.h"

namespace lamplighter {
namespace {

class GlSpeculars : public test::GlTest {};

// Every second surface is glossy, one of them by a texture.
Scene glossyBoxes() {
  Scene scene = test::randomBoxes(12, 5);
  auto image = std::make_shared<Image8>(8, 8);
  for (size_t i = 0; i < image->pixels.size(); ++i)
    image->pixels[i] = static_cast<uint8_t>(60 + i * 37 % 190);
  scene.textures.push_back(Texture{"gloss", image});
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    Material& m = scene.materials[i];
    m.metallic = i % 3 == 1 ? 1.0f : 0.0f;
    m.roughness = i % 3 == 2 ? 1.0f : 0.4f;
    if (i % 3 == 1)
      m.metallicRoughnessTexture.texture = static_cast<int>(scene.textures.size()) - 1;
  }
  return scene;
}

TEST_F(GlSpeculars, LookAsOnCpu) {
  const Scene scene = glossyBoxes();
  const View view = test::lookAt(vec3(3, 3.5f, 3), vec3(0, 0.5f, 0), 97, 64, 1.0f);
  std::vector<shared::Vpl> vpls = test::randomVpls(40, 7);
  for (size_t i = 0; i < vpls.size(); ++i) {
    vpls[i].slot = static_cast<int>(i);
    vpls[i].footprint.x = vpls[i].position.w == shared::kVplUniform ? 0.0f : 0.05f;
  }
  const shared::ShadingParams params{vec4(0.3f, 0.002f, 64, 7), vec4(1, 0, 0, 0),
                                     vec4(1.0f, 0.1f, 0, 0)};
  Image images[2], matt[2];
  for (const int i : {0, 1}) {
    test::LitScene lit(scene, i == 0 ? makeGlBackend() : makeCpuBackend());
    matt[i] = lit.sum(vpls, view, 64, true, 0.3f);
    lit.kernels->sumVpls(vpls, params, nullptr);
    images[i] = lit.kernels->compose()->pixels();
  }
  const float mean = test::meanOf(images[1]).g;
  EXPECT_GT(compareImages(images[1], matt[1]).relRmse, 0.05);
  const double mattShare = test::differingShare(matt[0], matt[1], 0.01f * mean, 0.01f);
  EXPECT_LE(test::differingShare(images[0], images[1], 0.01f * mean, 0.01f), mattShare + 0.005);
}

TEST_F(GlSpeculars, OfAHelmetLookAsOnCpu) {
  const auto path = test::sharedScenes() / "flight-helmet/FlightHelmet.gltf";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const Scene scene = loadGltf(path).scene;
  const RenderScene world = test::renderSceneOf(scene);
  const View view = viewOfBounds(world.bounds, 96, 72);
  Settings settings;
  settings.set("indirect", std::string("samples"));
  settings.set("vpls", 40);
  settings.set("bounces", 1);
  settings.set("antialias", 1);
  Image images[2];
  for (const int i : {0, 1}) {
    FrameRenderer renderer(i == 0 ? makeGlBackend() : makeCpuBackend());
    images[i] = test::renderSettled(renderer, scene, SceneChanges::all(), view, settings)
                    .radiance->pixels();
  }
  EXPECT_LT(compareImages(images[0], images[1]).relRmse, 0.05);
}

}  // namespace
}  // namespace lamplighter
