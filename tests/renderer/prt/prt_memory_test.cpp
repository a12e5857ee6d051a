// Which objects get transfer if the memory is too small for all, and that the limit holds.
#include "renderer/prt/prt_memory.h"

#include <gtest/gtest.h>

#include "renderer/prt/prt_lights.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

TEST(PrtRoom, GoesToTheSmallestFirst) {
  const std::vector<size_t> bytes{50, 10, 30, 10, 40};
  EXPECT_EQ(fitting(bytes, 140), (std::vector<bool>{true, true, true, true, true}));
  EXPECT_EQ(fitting(bytes, 139), (std::vector<bool>{false, true, true, true, true}));
  EXPECT_EQ(fitting(bytes, 49), (std::vector<bool>{false, true, false, true, false}));
  EXPECT_EQ(fitting(bytes, 10), (std::vector<bool>{false, true, false, false, false}));
  EXPECT_EQ(fitting(bytes, 9), (std::vector<bool>(5, false)));
}

// Three spheres under a dozen lights.
class Spheres : public testing::TestWithParam<float> {
 protected:
  Spheres() {
    for (const int segments : {40, 12, 24}) {
      const vec3 at(static_cast<float>(segments) * 0.1f, 0, 0);
      const NodeId id = test::addMesh(scene_, test::sphereMesh(0.5f, segments, 0.1f), at);
      scene_.find(id)->meshKind = MeshKind::complex;
    }
    RenderSceneChanges all = update(render_, scene_, SceneChanges::all());
    rays_ = std::make_unique<RayCaster>(render_);
    for (int i = 0; i < 12; ++i) {
      shared::Vpl vpl = test::makeVpl(vec3(i, 9, i % 5), vec3(0, -1, 0));
      vpl.intensity = vec3(30.0f);
      vpls_.push_back(vpl);
    }
    visibility_.setScene(render_, all);
    visibility_.setLights(render_, vpls_);
    visibility_.refreshAll(render_);
  }
  void light(PrtLights& lights, size_t room) {
    PrtLights::Options options;
    options.transfer = {64, 0};
    options.mostPoints = 32;
    options.mostError = GetParam();
    options.mostBytes = room;
    lights.update(render_, {}, *rays_, visibility_,
                  {vpls_, std::vector<bool>(vpls_.size(), true), {}}, options, true);
  }

  Scene scene_;
  RenderScene render_;
  std::unique_ptr<RayCaster> rays_;
  VisibilityDatabase visibility_;
  std::vector<shared::Vpl> vpls_;
};

TEST_P(Spheres, KeepWithinTheMemory) {
  PrtLights lights;
  light(lights, SIZE_MAX);
  EXPECT_EQ(lights.left().objects, 3);
  EXPECT_EQ(lights.left().withoutRoom, 0);
  size_t most = 0;
  for (const RenderObject& o : render_.objects)
    most += mostBytesOf({o.vertexCount, 32, vpls_.size(), GetParam() < 1.0f});
  EXPECT_LE(lights.bytes(), most);
  EXPECT_GT(2 * lights.bytes(), most) << "the bound must not be too large";

  std::vector<size_t> held;
  for (const size_t room : {most, most - 1, most / 2, most / 3, most / 20, size_t{0}}) {
    light(lights, room);
    EXPECT_LE(lights.bytes(), room);
    EXPECT_EQ(lights.left().objects + lights.left().withoutRoom, 3);
    held.push_back(static_cast<size_t>(lights.left().objects));
    for (uint32_t i = 0; i < 3; ++i) EXPECT_EQ(lights.hasTransfer(i), lights.wantsTransfer(i));
  }
  EXPECT_EQ(held.front(), 3u);
  EXPECT_EQ(held[1], 2u);
  EXPECT_FALSE(lights.hasTransfer(0));
  EXPECT_EQ(held.back(), 0u);
  EXPECT_EQ(lights.bytes(), 0u);
  light(lights, most);
  EXPECT_EQ(lights.left().objects, 3);
}
INSTANTIATE_TEST_SUITE_P(Errors, Spheres, testing::Values(1.0f, 0.15f));

}  // namespace
}  // namespace lamplighter
