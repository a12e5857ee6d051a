// The gl scene after nodes were added, removed, hidden or shown.
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/backends/gl/gl_scene.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/edit_sequence.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/random_boxes.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

using GlStructure = test::GlTest;
using test::LitScene;

TEST_F(GlStructure, OnlyObjectsThatComeAreUploaded) {
  Scene scene = test::randomBoxes(10, 3);
  RenderScene render = test::renderSceneOf(scene);
  gl::GlScene uploaded;
  uploaded.update(render, test::everythingRebuilt());
  EXPECT_EQ(uploaded.uploadedObjects(), render.objects.size());
  const auto uploadsOf = [&](auto&& edit) {
    const Scene before = scene;
    const size_t known = uploaded.uploadedObjects();
    edit(scene);
    const RenderSceneChanges changes = update(render, scene, compare(before, scene));
    EXPECT_FALSE(changes.rebuilt);
    uploaded.update(render, changes);
    EXPECT_EQ(uploaded.drawn().size(),
              static_cast<size_t>(std::ranges::count_if(
                  render.objects, [](const RenderObject& o) { return !o.isEmpty(); })));
    return uploaded.uploadedObjects() - known;
  };
  const uint64_t bytes = uploaded.bytes();
  const Node last = scene.nodes.back();
  EXPECT_EQ(uploadsOf([](Scene& s) { s.nodes[4].visible = false; }), 0u);
  EXPECT_EQ(uploadsOf([](Scene& s) { s.nodes.pop_back(); }), 0u);
  EXPECT_EQ(uploadsOf([](Scene& s) { s.nodes[4].visible = true; }), 1u);
  EXPECT_EQ(uploadsOf([&](Scene& s) { s.nodes.push_back(last); }), 1u);
  EXPECT_EQ(uploadsOf([](Scene& s) {
              test::addRectangleLight(s, vec3(0, 3, 0), vec2(1.0f), vec3(5.0f));
            }),
            1u);
  EXPECT_EQ(uploaded.bytes(), bytes);
}

class GlStructureEdits : public test::GlTest, public testing::WithParamInterface<uint32_t> {};

TEST_P(GlStructureEdits, GiveTheMapsAndNormalsOfANewScene) {
  const View view = test::lookAt(vec3(0.5f, 2.2f, 7.5f), vec3(0.0f, 1.4f, 0.0f), 96, 64);
  Scene scene = test::randomBoxes(10, 3);
  LitScene kept(scene, makeGlBackend());
  const shared::Vpl vpl = test::randomVpls(1, 2)[0];
  const auto mapOf = [&](LitScene& lit) {
    lit.kernels->reserveShadowMaps(vpl.slot + 1, 64);
    lit.kernels->renderShadowMaps(std::span(&vpl, 1));
    return lit.kernels->readShadowMap(vpl.slot);
  };
  const auto normalsOf = [&](LitScene& lit) {
    lit.backend->renderGBuffer(view, vec2(0.0f));
    return lit.backend->readNormals();
  };
  for (const test::Edit& edit : test::randomStructureEdits(12, GetParam())) {
    const Scene before = scene;
    apply(scene, edit);
    const RenderSceneChanges changes = update(kept.render, scene, compare(before, scene));
    kept.rays->update(changes);
    kept.backend->setScene(kept.render, changes, *kept.rays);
    LitScene fresh(scene, makeGlBackend());
    EXPECT_EQ(mapOf(kept), mapOf(fresh));
    EXPECT_TRUE(test::sameBits(normalsOf(kept), normalsOf(fresh)));
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, GlStructureEdits, testing::Range(1u, 4u));

}  // namespace
}  // namespace lamplighter
