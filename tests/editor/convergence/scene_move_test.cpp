#include "editor/convergence/scene_move.h"

#include <algorithm>

#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

class SceneMoveTest : public test::SessionFixture {
 protected:
  const Scene& scene() const { return session_.document().scene; }
  NodeId spot_ = 0;

  void addMore(Scene& scene) override {
    scene.find(light_)->name = "lamp";
    spot_ = test::addNode(scene, "spot", kNoNode, vec3(2, 3, 0));
    scene.find(spot_)->punctual = PunctualLight{};
    scene.materials.front().name = "grey";
  }
  // The state after the move, for the changes of f.
  void expectTakenOver(const std::function<void(Scene&)>& f) {
    Scene to = scene();
    f(to);
    EXPECT_FALSE(compare(scene(), to).none());
    const size_t steps = session_.history().position();
    const SceneMove move = moveTo(scene(), to);
    EXPECT_EQ(move.common, scene().nodes.size());
    applyMove(session_.editing(), move);
    EXPECT_TRUE(compare(scene(), to).none());
    EXPECT_TRUE(moveTo(scene(), to).none());
    EXPECT_EQ(session_.history().position(), steps + 1);
    session_.undo();
  }
};

TEST_F(SceneMoveTest, TakesOverTransformsAndTheValuesOfLights) {
  expectTakenOver([&](Scene& to) { to.find(box_)->local.translation.x = 3.0f; });
  expectTakenOver([&](Scene& to) { to.find(light_)->area->radiance = vec3(1, 2, 3); });
  expectTakenOver([&](Scene& to) { to.find(spot_)->punctual->intensity = vec3(5.0f); });
  expectTakenOver([&](Scene& to) { to.find(light_)->light.on = false; });
  expectTakenOver([&](Scene& to) { to.materials.front().emissive = vec3(4.0f); });
  expectTakenOver([&](Scene& to) { to.sky = Sky(vec3(0.5f)); });
  expectTakenOver([&](Scene& to) {
    to.find(light_)->local.scale = vec3(2.0f);
    to.find(spot_)->local.translation = vec3(0, 2, 1);
  });
}

TEST_F(SceneMoveTest, LeavesEverythingElse) {
  Scene to = scene();
  to.materials.front().baseColor = vec4(0.1f);
  to.find(box_)->visible = false;
  to.find(spot_)->punctual.reset();
  test::addNode(to, "new");
  EXPECT_TRUE(moveTo(scene(), to).none());
}

TEST_F(SceneMoveTest, MatchesByNameWhateverTheOrder) {
  Scene to = scene();
  to.find(box_)->local.translation.y = 2.0f;
  std::reverse(to.nodes.begin(), to.nodes.end());
  for (Node& node : to.nodes) node.id += 100;
  const SceneMove move = moveTo(scene(), to);
  ASSERT_EQ(move.nodes.size(), 1u);
  EXPECT_EQ(move.nodes.front().id, box_);
  EXPECT_EQ(move.nodes.front().local.translation.y, 2.0f);

  for (Node& node : to.nodes) node.name += " of another level";
  EXPECT_EQ(moveTo(scene(), to).common, 0u);
}

TEST_F(SceneMoveTest, OfSeveralWithOneNameTheFirstIsTheFirst) {
  change([&](Scene& s) {
    for (const NodeId id : {floor_, box_, spot_}) s.find(id)->name = "part";
  });
  Scene to = scene();
  to.find(box_)->local.translation.z = 1.0f;
  const SceneMove move = moveTo(scene(), to);
  ASSERT_EQ(move.nodes.size(), 1u);
  EXPECT_EQ(move.nodes.front().id, box_);
}

}  // namespace
}  // namespace lamplighter
