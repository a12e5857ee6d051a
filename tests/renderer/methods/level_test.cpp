// Scenes with many surfaces, for which the visibility database contains only those in view.
#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/metrics.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/random_boxes.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

struct Level {
  Scene scene = test::randomBoxes(150, 4);
  glm::ivec2 size{192, 120};
  View view;
  Settings settings;
  FrameRenderer renderer{makeCpuBackend()};

  Level() {
    test::addRectangleLight(scene, vec3(0.3f, 3.9f, -0.2f), vec2(1.5f, 0.7f), vec3(12, 9, 5));
    settings.set("vpls", 60);
    settings.set("antialias", 2);
    settings.set("settled_map_scale", 2);
    settings.set("share_memory", 0);  // the settled picture is the kept sums
    turn(0.0f);
  }
  void turn(float angle) {
    view = test::lookAt(vec3(7.0f * std::sin(angle), 3.0f, 7.0f * std::cos(angle)),
                        vec3(0.0f, 1.0f, 0.0f), size.x, size.y);
  }
  GiOutput frame(const SceneChanges& changes) {
    return renderer.render({scene, changes, view, "many_lights", settings});
  }
  Image settled(const SceneChanges& changes) {
    return test::renderSettled(renderer, scene, changes, view, settings).radiance->pixels();
  }
  Image fresh() const {
    FrameRenderer other(makeCpuBackend());
    return test::renderSettled(other, scene, SceneChanges::all(), view, settings)
        .radiance->pixels();
  }
};

TEST(Level, AFlightLeavesTheBitsOfAFreshRender) {
  Level level;
  level.settled(SceneChanges::all());
  level.settings.set("updates", 5);
  for (int i = 1; i < 8; ++i) {
    level.turn(0.2f * static_cast<float>(i));
    level.frame({});
    if (i % 3 != 0) continue;
    const Scene before = level.scene;
    level.scene.nodes[10].local.translation.x += 0.1f;
    level.frame(compare(before, level.scene));
  }
  const Image kept = level.settled({});
  EXPECT_TRUE(test::sameBits(kept, level.fresh()));
}

TEST(Level, IsThatOfNaive) {
  Level level;
  const Image lazy = level.settled(SceneChanges::all());
  level.settings.set("technique", std::string("naive"));
  EXPECT_LT(compareImages(lazy, level.fresh()).relRmse, 0.01);
}

}  // namespace
}  // namespace lamplighter
