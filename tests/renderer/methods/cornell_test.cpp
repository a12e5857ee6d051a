// many_lights against pictures of the Cornell box from an independent renderer.
#include <filesystem>

#include <gtest/gtest.h>

#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/folders.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scene_files.h"

namespace lamplighter {
namespace {

const std::filesystem::path kReferences = test::sharedFolder() / "references";

Metrics compareCornell(const std::string& name, int vpls, int bounces) {
  const Scene scene = loadGltf(kReferences / "scenes" / (name + ".gltf")).scene;
  Settings settings;
  settings.set("vpls", vpls);
  settings.set("bounces", bounces);
  settings.set("updates", vpls);
  const View view = test::viewOf(scene, 512, 384);
  FrameRenderer renderer(makeCpuBackend());
  const GiOutput out = test::renderSettled(renderer, scene, SceneChanges::all(), view, settings);
  const auto file = name + "_b" + std::to_string(bounces) + ".exr";
  const Image reference = readImage(kReferences / "refs" / file);
  const Image mask = readImage(kReferences / "refs" / (name + "_mask.exr"));
  return compareImages(out.radiance->pixels(), reference, &mask);
}

TEST(ManyLightsCornell, DirectLightOf1024VplsIsWithinFivePercent) {
  if (!std::filesystem::exists(kReferences)) GTEST_SKIP() << "no " << kReferences;
  for (const char* name : {"cornell", "cornell_lightmoved"}) {
    const Metrics m = compareCornell(name, 1024, 0);
    RecordProperty(name, std::to_string(m.relRmse));
    EXPECT_LT(m.relRmse, 0.05) << name;
    EXPECT_LT(std::abs(m.bias - 1.0), 0.005) << name;
  }
}

// With one more bounce, the remaining errors are the noise of 512 indirect VPLs, the clamp and the
// resolution of shadow maps.
TEST(ManyLightsCornell, OneBounceKeepsTheBrightness) {
  if (!std::filesystem::exists(kReferences)) GTEST_SKIP() << "no " << kReferences;
  const Metrics m = compareCornell("cornell", 1024, 1);
  RecordProperty("relRmse", std::to_string(m.relRmse));
  EXPECT_LT(m.relRmse, 0.10);
  EXPECT_LT(std::abs(m.bias - 1.0), 0.02);
}

}  // namespace
}  // namespace lamplighter
