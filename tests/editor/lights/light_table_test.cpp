// The rows of the light table: properties from the document and figures from the method.
#include "editor/lights/light_table.h"

#include <gtest/gtest.h>

#include "editor/lights/colour_temperature.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

class LightTableTest : public test::SessionFixture {
 protected:
  NodeId point_ = 0, glow_ = 0;

  void addMore(Scene& scene) override {
    scene.find(light_)->name = "ceiling";
    point_ = test::addNode(scene, "bulb", kNoNode, vec3(1, 2, 0));
    scene.find(point_)->punctual = PunctualLight{PunctualKind::point, vec3(5.0f)};
    const int glow = test::addMaterial(scene, vec3(0), vec3(1, 0, 0));
    glow_ = test::addMesh(scene, test::boxMesh(vec3(0.2f), glow), vec3(-1, 1, 0));
    scene.find(glow_)->name = "ember";
    scene.sky = vec3(0.1f);
  }
  std::vector<LightRow> rows(LightUnit unit = LightUnit::lumens) {
    return session_.lighting().table.rows(session_, unit);
  }
  static std::vector<std::string> names(const std::vector<LightRow>& rows) {
    std::vector<std::string> out;
    for (const LightRow& r : rows) out.push_back(r.name);
    return out;
  }
  using Names = std::vector<std::string>;
};

TEST_F(LightTableTest, EveryLightIsARow) {
  change([&](Scene& s) { s.find(point_)->visible = false; });
  const auto all = rows();
  ASSERT_EQ(names(all), (Names{"ceiling", "bulb", "ember", "Sky"}));
  EXPECT_EQ(all[0].source.measure.kind, LightKind::rectangle);
  EXPECT_NEAR(all[0].strength, 10.0 * 3.14159265, 1e-3);  // 10 nt on a square metre
  EXPECT_EQ(all[0].unit, LightUnit::lumens);
  EXPECT_FALSE(all[1].visible);
  EXPECT_NEAR(all[1].strength, 20.0 * 3.14159265, 1e-3);
  EXPECT_FALSE(all[2].kelvin);  // red
  EXPECT_EQ(all[3].unit, LightUnit::nits);
  EXPECT_NEAR(all[3].strength, 0.1, 1e-6);
  session_.select({light_, glow_});
  const auto again = rows(LightUnit::nits);
  EXPECT_TRUE(again[0].selected && again[2].selected && !again[1].selected);
  EXPECT_NEAR(again[0].strength, 10.0, 1e-4);
  EXPECT_EQ(again[1].unit, LightUnit::candela);
}

TEST_F(LightTableTest, SortsStably) {
  auto all = rows();
  sortRows(all, LightColumn::name, true);
  EXPECT_EQ(names(all), (Names{"Sky", "bulb", "ceiling", "ember"}));
  sortRows(all, LightColumn::name, false);
  EXPECT_EQ(names(all), (Names{"ember", "ceiling", "bulb", "Sky"}));
  // Lights without a group come last in both directions, in their previous order.
  all = rows();
  all[2].state.group = "a";
  all[1].state.group = "b";
  sortRows(all, LightColumn::group, true);
  EXPECT_EQ(names(all), (Names{"ember", "bulb", "ceiling", "Sky"}));
  sortRows(all, LightColumn::group, false);
  EXPECT_EQ(names(all), (Names{"bulb", "ember", "ceiling", "Sky"}));
  sortRows(all, LightColumn::strength, true);  // first all values in lumens, then those in nits
  EXPECT_EQ(names(all).back(), "Sky");
  EXPECT_EQ(names(all)[1], "ceiling");
}

TEST_F(LightTableTest, RangesEndAtTheClickedRow) {
  const auto all = rows();
  EXPECT_EQ(rowsBetween(all, light_, glow_), (std::vector<NodeId>{light_, point_, glow_}));
  EXPECT_EQ(rowsBetween(all, glow_, point_), (std::vector<NodeId>{glow_, point_}));
  EXPECT_EQ(rowsBetween(all, kNoNode, point_).back(), point_);
  EXPECT_EQ(rowsBetween(all, 999, glow_), (std::vector<NodeId>{glow_}));
}

TEST_F(LightTableTest, FiguresComeFromTheMethod) {
  for (int i = 0; i < 400 && !session_.output().settled; ++i) session_.renderFrame();
  ASSERT_TRUE(session_.output().settled);
  const auto all = rows();
  const Inspection inspection = session_.inspect();
  int samples = 0;
  double share = 0.0;
  for (const LightRow& r : all) {
    samples += r.figures.samples;
    share += r.figures.share;
    EXPECT_EQ(r.figures.mapsPending, 0) << r.name;
  }
  int live = 0;
  for (const LightSample& l : inspection.lights) live += l.isLive;
  EXPECT_EQ(samples, live);
  EXPECT_GT(live, 0);
  EXPECT_NEAR(share, 1.0, 1e-6);
  EXPECT_GT(all[0].figures.patches, 0);
  EXPECT_GE(all[0].figures.work, static_cast<uint64_t>(all[0].figures.patches));
}

TEST_F(LightTableTest, TimeIsDividedByWork) {
  for (int i = 0; i < 400 && !session_.output().settled; ++i) session_.renderFrame();
  const auto figures = lightFigures(session_.inspect(), 0.010);
  double all = 0.0;
  for (const auto& [id, f] : figures) all += f.milliseconds;
  EXPECT_NEAR(all, 10.0, 1e-9);
}

TEST_F(LightTableTest, PendingShadowMapsAreCounted) {
  for (int i = 0; i < 400 && !session_.output().settled; ++i) session_.renderFrame();
  RenderSettings settings = session_.document().render;
  settings.values.set("updates", 1);
  session_.setRender(settings);
  session_.select({light_});
  session_.runAction("object.move 1 4 0");
  for (int i = 0; i < 4; ++i) session_.renderFrame();
  int pending = 0, age = 0;
  for (const auto& [id, f] : lightFigures(session_.inspect(), 0.0)) {
    pending += f.mapsPending;
    age = std::max(age, f.age);
  }
  EXPECT_GT(pending, 0);
  EXPECT_GT(age, 0);
}

}  // namespace
}  // namespace lamplighter
