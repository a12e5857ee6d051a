// Where the bounced light of an explained point comes from.
#include "editor/explain/light_senders.h"

#include <algorithm>

#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

class LightSendersTest : public test::SessionFixture {
 protected:
  void SetUp() override {
    SessionFixture::SetUp();
    lookFrom(vec3(0, 3, 6), -0.5f);
    settle();
  }
  // A red wall beside the floor.
  void addMore(Scene& scene) override {
    const int red = test::addMaterial(scene, vec3(0.8f, 0.1f, 0.1f));
    scene.materials[static_cast<size_t>(red)].name = "paint";
    wall_ = test::addMesh(scene, test::boxMesh(vec3(0.2f, 4.0f, 4.0f), red), vec3(2.5f, 2.0f, 0));
    scene.find(wall_)->name = "wall";
  }
  void settle() {
    for (int i = 0; i < 1000 && !session_.renderFrame().settled; ++i) {
    }
  }
  void explainAt(const vec3& at) {
    const vec2 p = pixelOf(at);
    ASSERT_TRUE(session_.runAction("explain.at " + std::to_string(p.x) + " " + std::to_string(p.y)))
        << session_.status();
  }
  const Explainer& explainer() { return session_.points().explainer(); }
  const LightSenders& senders() { return explainer().senders(); }

  NodeId wall_ = 0;
  const vec3 byTheWall_{1.8f, 0.0f, 0.8f};
};

TEST_F(LightSendersTest, RowsAreSurfacesWithTheirShare) {
  explainAt(byTheWall_);
  EXPECT_EQ(senders().problem, "");
  ASSERT_FALSE(senders().rows.empty());
  const LightSender& first = senders().rows.front();
  EXPECT_EQ(first.key.node, wall_);
  EXPECT_EQ(first.name, "wall");
  EXPECT_EQ(first.material, "paint");
  EXPECT_GT(first.colour.r, 0.99f);
  EXPECT_LT(first.colour.g, 0.3f);
  float sum = 0.0f, share = 0.0f, before = first.irradiance;
  EXPECT_EQ(first.places.size(), LightSender::kMostPlaces);
  for (const LightSender& row : senders().rows) {
    EXPECT_LE(row.irradiance, before);
    before = row.irradiance;
    sum += row.irradiance;
    share += senders().shareOf(row);
    EXPECT_LE(row.places.size(), LightSender::kMostPlaces);
    EXPECT_TRUE(std::ranges::is_sorted(row.places, std::ranges::greater(),
                                       &LightSender::Place::irradiance));
    float ofPlaces = 0.0f;
    for (const LightSender::Place& place : row.places) ofPlaces += place.irradiance();
    EXPECT_NEAR(ofPlaces / row.irradiance, 1.0f, 1e-4f);
  }
  EXPECT_NEAR(sum / senders().irradiance, 1.0f, 1e-3f);
  EXPECT_NEAR(share, 1.0f, 1e-3f);
  EXPECT_GE(senders().shareOf(senders().rows.back()), LightSenders::kLeastShare);
}

TEST_F(LightSendersTest, AChosenSurfaceReplacesTheLight) {
  explainAt(byTheWall_);
  ASSERT_NE(explainer().chosen(), nullptr);
  EXPECT_EQ(explainer().chosenSender(), nullptr);
  session_.points().explainer().choose(0);
  const size_t shapes = session_.overlay().shapes.size();
  ASSERT_TRUE(session_.runAction("explain.sender 0")) << session_.status();
  EXPECT_EQ(explainer().chosen(), nullptr);
  ASSERT_NE(explainer().chosenSender(), nullptr);
  EXPECT_EQ(explainer().chosenSender()->key.node, wall_);
  EXPECT_NE(session_.overlay().shapes.size(), shapes);
  ASSERT_TRUE(session_.runAction("explain.senders"));
  EXPECT_EQ(explainer().chosenSender(), &senders().all);
  ASSERT_TRUE(session_.runAction("explain.light 0"));
  EXPECT_NE(explainer().chosen(), nullptr);
  EXPECT_EQ(explainer().chosenSender(), nullptr);
}

TEST_F(LightSendersTest, ASurfaceStaysChosenAndFollowsItsMaterial) {
  explainAt(byTheWall_);
  ASSERT_TRUE(session_.runAction("explain.sender 0"));
  const float before = senders().rows.front().irradiance;
  const uint64_t document = hash();
  ASSERT_TRUE(session_.runAction("explain.sender_object 0"));
  EXPECT_EQ(session_.document().active(), wall_);
  EXPECT_FALSE(session_.editing().canUndo());
  EXPECT_EQ(hash(), document);
  change([](Scene& s) { s.materials[1].baseColor = vec4(0.1f, 0.1f, 0.1f, 1.0f); });
  settle();
  ASSERT_NE(explainer().chosenSender(), nullptr);
  EXPECT_EQ(explainer().chosenSender()->key.node, wall_);
  EXPECT_LT(explainer().chosenSender()->irradiance, 0.6f * before);
}

TEST_F(LightSendersTest, ManySurfacesShareTheLastRow) {
  change([](Scene& s) {
    for (int i = 0; i < 20; ++i)
      test::addMesh(s, test::boxMesh(vec3(0.08f, 0.4f, 0.08f), 0),
                    vec3(2.25f, 0.2f, -0.4f + 0.12f * static_cast<float>(i)));
  });
  settle();
  explainAt(byTheWall_);
  ASSERT_EQ(senders().rows.size(), LightSenders::kMostRows + 1);
  const LightSender& others = senders().rows.back();
  EXPECT_NE(others.name.find("others"), std::string::npos);
  EXPECT_EQ(others.key.node, kNoNode);
  float sum = 0.0f;
  for (const LightSender& row : senders().rows) sum += row.irradiance;
  EXPECT_NEAR(sum / senders().irradiance, 1.0f, 1e-3f);
  const std::string row = std::to_string(LightSenders::kMostRows);
  EXPECT_FALSE(session_.runAction("explain.sender_object " + row));
  EXPECT_NE(session_.status().find("several objects"), std::string::npos);
  EXPECT_TRUE(session_.runAction("explain.sender " + row));
}

TEST_F(LightSendersTest, RowsThatDoNotExistAreRefused) {
  EXPECT_FALSE(session_.runAction("explain.sender 0"));
  EXPECT_NE(session_.status().find("point at a surface first"), std::string::npos);
  explainAt(byTheWall_);
  EXPECT_FALSE(session_.runAction("explain.sender 99"));
  EXPECT_FALSE(session_.runAction("explain.sender -1"));
  EXPECT_FALSE(session_.runAction("explain.sender_object 99"));
}

TEST_F(LightSendersTest, MethodsWithoutLinksSayWhichHaveThem) {
  explainAt(byTheWall_);
  ASSERT_TRUE(session_.runAction("render.method reference"));
  settle();
  EXPECT_NE(senders().remedy.find("many_lights with indirect=links"), std::string::npos);
  EXPECT_TRUE(senders().rows.empty());
  EXPECT_FALSE(session_.runAction("explain.senders"));
  EXPECT_FALSE(session_.runAction("explain.sender 0"));
  EXPECT_NE(session_.status().find("choose"), std::string::npos);
}

}  // namespace
}  // namespace lamplighter
