// Repair on the gl backend.
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/image/metrics.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/scenes/small_room.h"

namespace lamplighter {
namespace {

struct RepairedGl : test::GlTest, test::SmallRoom {
  Image repaired(std::unique_ptr<Backend> backend, double& paths) {
    Settings settings;
    settings.set("vpls", 100);
    settings.set("indirect", std::string("samples"));
    settings.set("repair", 64);
    FrameRenderer renderer(std::move(backend));
    GiOutput out;
    for (int frame = 0; frame < 1000 && !(out.settled && out.refined); ++frame)
      out = renderer.render({scene,
                             frame == 0 ? SceneChanges::all() : SceneChanges(),
                             view,
                             "many_lights",
                             settings,
                             false,
                             {.refineUpdates = 64}});
    EXPECT_TRUE(out.settled && out.refined);
    paths = out.stats.of("paths_repaired");
    return out.radiance->pixels();
  }
};

// The paths are the same; the live pictures differ at borders of shadows.
TEST_F(RepairedGl, EqualsTheCpuBackend) {
  double onGl = 0.0, onCpu = 0.0;
  const Metrics m =
      compareImages(repaired(makeGlBackend(), onGl), repaired(makeCpuBackend(), onCpu));
  RecordProperty("relRmse", std::to_string(m.relRmse));
  EXPECT_EQ(onGl, 64.0);
  EXPECT_EQ(onCpu, 64.0);
  EXPECT_LT(m.relRmse, 0.01);
  EXPECT_NEAR(m.bias, 1.0, 0.001);
}

}  // namespace
}  // namespace lamplighter
