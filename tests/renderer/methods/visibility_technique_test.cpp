// The techniques `visibility` and `light_maps` give the picture of `naive` with fewer look-ups, and
// the result does not depend on earlier edits.
#include <filesystem>
#include <ostream>

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/traced_shadows.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 192, kHeight = 128;

Settings settingsOf(const std::string& technique, int vpls) {
  Settings s;
  s.set("share_memory", 0);  // the settled picture is that of the live sums
  s.set("technique", technique);
  s.set("indirect", std::string("samples"));
  s.set("block", std::string("1"));
  s.set("vpls", vpls);
  s.set("updates", 150);
  s.set("antialias", 1);
  s.set("bias_compensation", false);  // uses random rays
  return s;
}

struct Rendered {
  std::unique_ptr<FrameRenderer> renderer;
  Image image;
  uint64_t lookUps() const { return test::lightCounts(renderer->backend()).lookUps; }
};

Rendered rendered(const Scene& scene, const View& view, const std::string& technique, int vpls) {
  auto renderer = std::make_unique<FrameRenderer>(makeCpuBackend());
  const GiOutput out =
      test::renderSettled(*renderer, scene, SceneChanges::all(), view, settingsOf(technique, vpls));
  return {std::move(renderer), out.radiance->pixels()};
}

// The same light samples, with shadow rays instead of shadow maps.
Image withShadowRays(const FrameRenderer& of, const View& view, const PatchView* known) {
  return test::withTracedShadows(of.scene(), *of.rays(), test::shownLights(of.inspect()), view,
                                 Settings(), known);
}

struct Case {
  const char* scene;
  int vpls;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene; }

class VisibilityTechnique : public testing::TestWithParam<Case> {};

// Within 1%. Where shadow maps leak by more than that, both techniques are farther from `naive` but
// closer to the picture with shadow rays, because entries of the database are exact.
TEST_P(VisibilityTechnique, GivesThePictureOfNaive) {
  const fs::path path = test::sceneFile(GetParam().scene);
  if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
  const Scene scene = loadGltf(path).scene;
  const View view = test::viewOf(scene, kWidth, kHeight);
  const Rendered naive = rendered(scene, view, "naive", GetParam().vpls);
  for (const std::string technique : {"visibility", "light_maps"}) {
    SCOPED_TRACE(technique);
    const Rendered fast = rendered(scene, view, technique, GetParam().vpls);
    const Metrics m = compareImages(fast.image, naive.image);
    RecordProperty(technique + "RelRmse", std::to_string(m.relRmse));
    RecordProperty(technique + "LookUpsPercent",
                   std::to_string(100 * fast.lookUps() / naive.lookUps()));
    EXPECT_LT(fast.lookUps(), naive.lookUps());
    EXPECT_NEAR(m.bias, 1.0, 0.005);
    if (m.relRmse < 0.01) continue;
    const Image truth = withShadowRays(*naive.renderer, view, nullptr);
    EXPECT_LT(compareImages(fast.image, truth).relRmse, compareImages(naive.image, truth).relRmse)
        << "and " << m.relRmse << " from naive";
  }
}
INSTANTIATE_TEST_SUITE_P(
    Scenes, VisibilityTechnique,
    testing::Values(Case{"default.gltf", 300}, Case{"close_light.gltf", 300},
                    Case{"area_light_room.gltf", 300}, Case{"table_room.gltf", 300},
                    Case{"pillar_room.gltf", 300}, Case{"cornell_style.gltf", 300},
                    Case{"modern-hall/modern-hall.glb", 100}, Case{"bathroom/bathroom.glb", 100},
                    Case{"zdm2-map/zdm2.glb", 20}, Case{"classroom/classroom.gltf", 300},
                    Case{"kenney-fps-level/kenney-fps-level.gltf", 100},
                    Case{"flight-helmet/FlightHelmet.gltf", 100}));

// Independent of leaks of shadow maps: where the database says `visible` or `hidden`, shadow rays
// agree at every pixel.
class VisibilityKnowledge : public testing::TestWithParam<Case> {};

TEST_P(VisibilityKnowledge, AgreesWithShadowRays) {
  const fs::path path = test::sceneFile(GetParam().scene);
  if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
  const Scene scene = loadGltf(path).scene;
  const View view = test::viewOf(scene, kWidth / 2, kHeight / 2);
  const Rendered shown = rendered(scene, view, "visibility", GetParam().vpls);
  const auto known = shown.renderer->inspect().patches;
  ASSERT_NE(known, nullptr);
  const Image rays = withShadowRays(*shown.renderer, view, nullptr);
  EXPECT_LT(compareImages(withShadowRays(*shown.renderer, view, known.get()), rays).relRmse,
            0.0005);
}
INSTANTIATE_TEST_SUITE_P(Scenes, VisibilityKnowledge,
                         testing::Values(Case{"narrow_gap.gltf", 300}, Case{"default.gltf", 300},
                                         Case{"living-room/living-room.gltf", 50},
                                         Case{"classroom/classroom.gltf", 50}));

TEST(VisibilityTechnique, AfterEditsThePictureEqualsAFreshRender) {
  Scene scene = test::loadAsset("pillar_room");
  const View view = test::viewOf(scene, kWidth, kHeight);
  FrameRenderer renderer(makeCpuBackend());
  const Settings settings = settingsOf("visibility", 120);
  test::renderSettled(renderer, scene, SceneChanges::all(), view, settings);
  for (Node& node : scene.nodes) {
    if (node.name != "mover" && node.name != "ceiling light") continue;
    const Scene before = scene;
    node.local.translation += vec3(0.7f, 0.0f, 0.3f);
    test::renderSettled(renderer, scene, compare(before, scene), view, settings);
  }
  const Image edited = test::renderSettled(renderer, scene, {}, view, settings).radiance->pixels();
  EXPECT_TRUE(test::sameBits(edited, rendered(scene, view, "visibility", 120).image));
}

}  // namespace
}  // namespace lamplighter
