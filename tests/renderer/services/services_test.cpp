// Services between frames: movers of each frame, and data that follow changes of the scene.
#include "renderer/services/services.h"

#include <gtest/gtest.h>

#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

class ServicesTest : public testing::Test {
 protected:
  ServicesTest() {
    box_ = test::addMesh(scene_, test::boxMesh(vec3(1.0f)));
    test::addMesh(scene_, test::squareMesh(4.0f), vec3(0, -1, 0));
    frame(SceneChanges::all());
  }
  void frame(const SceneChanges& changes, bool isOtherScene = false) {
    const RenderSceneChanges found = update(render_, scene_, changes);
    if (!rays_)
      rays_ = std::make_unique<RayCaster>(render_);
    else
      rays_->update(found);
    services_.beginFrame(render_, found, *rays_, {true, 7}, isOtherScene);
  }
  void move(const vec3& by) {
    const Scene before = scene_;
    scene_.find(box_)->local.translation += by;
    frame(compare(before, scene_));
  }

  Scene scene_;
  NodeId box_ = kNoNode;
  RenderScene render_;
  std::unique_ptr<RayCaster> rays_;
  Services services_;
};

TEST_F(ServicesTest, NothingIsComputedBeforeItIsUsed) {
  for (const Service service : kServices) EXPECT_FALSE(services_.hasAsked(service));
  EXPECT_EQ(services_.budget().refineUpdates, 7);
  EXPECT_TRUE(services_.budget().inBackground);
  EXPECT_TRUE(services_.rays().intersect({vec3(0, 5, 0), 0.0f, vec3(0, -1, 0)}));
  EXPECT_TRUE(services_.hasAsked(Service::rays));
  EXPECT_FALSE(services_.hasAsked(Service::movers));
}

TEST_F(ServicesTest, MoversAreTheSameForAllCallersOfAFrame) {
  EXPECT_EQ(services_.movers().size(), 2u) << "in the first frame all objects are movers";
  move(vec3(1, 0, 0));
  ASSERT_EQ(services_.movers().size(), 1u);
  EXPECT_EQ(services_.movers()[0].node, box_);
  EXPECT_EQ(services_.movers()[0].before.max.x, 0.5f);
  frame({});
  EXPECT_TRUE(services_.movers().empty());
  frame(SceneChanges::all(), true);
  EXPECT_EQ(services_.movers().size(), 2u) << "in another scene all objects are movers again";
}

TEST_F(ServicesTest, MoversOfFramesWithoutCallersAreKept) {
  services_.movers();
  move(vec3(1, 0, 0));
  move(vec3(1, 0, 0));
  ASSERT_EQ(services_.movers().size(), 1u);
  EXPECT_EQ(services_.movers()[0].before.max.x, 0.5f);
  EXPECT_EQ(services_.movers()[0].after.max.x, 2.5f);
}

TEST_F(ServicesTest, SurfacesFollowTheScene) {
  EXPECT_NEAR(services_.surfaces().area(), 6.0 + 16.0, 1e-5);
  const Scene before = scene_;
  scene_.find(box_)->local.scale = vec3(2.0f);
  frame(compare(before, scene_));
  frame({});
  EXPECT_NEAR(services_.surfaces().area(), 24.0 + 16.0, 1e-5);
}

TEST_F(ServicesTest, ChartsFollowTheScene) {
  ASSERT_EQ(services_.charts(8.0f).size(), 2u);
  EXPECT_EQ(services_.charts(8.0f)[0].atlas->charts.size(), 6u);
  move(vec3(3, 0, 0));
  EXPECT_EQ(services_.charts(8.0f)[0].space.translation.x, 3.0f);
}

}  // namespace
}  // namespace lamplighter
