// Refinement of a settled picture on the gl backend.
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/image/metrics.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/scenes/small_room.h"

namespace lamplighter {
namespace {

struct RefinementGl : test::GlTest, test::SmallRoom {
  Settings settings;

  void SetUp() override {
    test::GlTest::SetUp();
    settings.set("vpls", 100);
    settings.set("indirect", std::string("samples"));
    settings.set("refine", 2000);
    settings.set("repair", 0);
  }

  Image refined(FrameRenderer& renderer, const SceneChanges& changes) {
    GiOutput out;
    for (int frame = 0; frame < 1000; ++frame) {
      out = renderer.render({scene,
                             frame == 0 ? changes : SceneChanges(),
                             view,
                             "many_lights",
                             settings,
                             false,
                             {.refineUpdates = 64}});
      if (out.settled && out.refined) break;
    }
    EXPECT_TRUE(out.refined);
    return out.radiance->pixels();
  }
};

// The batches are the same. Rasterised and traced maps differ at silhouettes.
TEST_F(RefinementGl, EqualsTheCpuBackend) {
  FrameRenderer onGl(makeGlBackend()), onCpu(makeCpuBackend());
  const Metrics m =
      compareImages(refined(onGl, SceneChanges::all()), refined(onCpu, SceneChanges::all()));
  RecordProperty("relRmse", std::to_string(m.relRmse));
  EXPECT_LT(m.relRmse, 0.01);
  EXPECT_NEAR(m.bias, 1.0, 0.001);
}

// After an edit during refinement, the live picture and the next refined picture equal those of a
// fresh renderer.
TEST_F(RefinementGl, AfterAnEditThePicturesEqualFreshOnes) {
  FrameRenderer renderer(makeGlBackend());
  refined(renderer, SceneChanges::all());
  for (int frames : {1, 12}) {
    const Scene old = scene;
    scene.find(box)->local.translation.x += 0.1f;
    SceneChanges changes = compare(old, scene);
    GiOutput out;
    do {
      out = renderer.render(
          {scene, changes, view, "many_lights", settings, false, {.refineUpdates = 64}});
      changes = SceneChanges();
    } while (!out.settled);
    FrameRenderer fresh(makeGlBackend());
    const GiOutput live = test::renderSettled(fresh, scene, SceneChanges::all(), view, settings);
    EXPECT_TRUE(test::sameBits(out.radiance->pixels(), live.radiance->pixels()));
    for (int i = 0; i < frames; ++i)
      renderer.render({scene, {}, view, "many_lights", settings, false, {.refineUpdates = 64}});
  }
  FrameRenderer fresh(makeGlBackend());
  EXPECT_TRUE(test::sameBits(refined(renderer, {}), refined(fresh, SceneChanges::all())));
}

}  // namespace
}  // namespace lamplighter
