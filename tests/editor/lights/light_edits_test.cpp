// Edits of several lights. Each is one step with undo and redo. Invalid edits change nothing.
#include "editor/lights/light_edits.h"

#include <gtest/gtest.h>

#include "editor/lights/colour_temperature.h"
#include "renderer/scene/ies/ies_profile.h"
#include "tests/editor/session_fixture.h"
#include "tests/support/folders.h"

namespace lamplighter {
namespace {

class LightEdits : public test::SessionFixture {
 protected:
  NodeId point_ = 0, spot_ = 0, glow_ = 0, twin_ = 0;

  void addMore(Scene& scene) override {
    point_ = test::addNode(scene, "bulb", kNoNode, vec3(1, 2, 0));
    scene.find(point_)->punctual = PunctualLight{PunctualKind::point, vec3(5.0f)};
    spot_ = test::addNode(scene, "spot", kNoNode, vec3(1, 2, 0));
    scene.find(spot_)->punctual = PunctualLight{PunctualKind::spot, vec3(5.0f)};
    const int glow = test::addMaterial(scene, vec3(0), vec3(4, 2, 1));
    glow_ = test::addMesh(scene, test::boxMesh(vec3(0.2f), glow), vec3(-1, 1, 0));
    twin_ = test::addMesh(scene, test::boxMesh(vec3(0.2f), glow), vec3(-2, 1, 0));
  }
  const Scene& scene() const { return session_.document().scene; }
  double value(NodeId id, LightProperty property, LightUnit unit = LightUnit::lumens) const {
    for (const LightSource& l : lightsOf(scene()))
      if (l.node == id) return valueOf(scene(), l, property, unit).value_or(-1.0);
    return -2.0;
  }
  CommonValue common(LightProperty property, LightUnit unit = LightUnit::lumens) const {
    return commonValue(scene(), selectedLights(session_.document()), property, unit);
  }
};

TEST_F(LightEdits, SetsSeveralKindsTogether) {
  session_.select({light_, point_, glow_});
  EXPECT_TRUE(common(LightProperty::intensity).isMixed);
  expectOneStep("lights.set intensity 500 lm");
  for (const NodeId id : {light_, point_, glow_})
    EXPECT_NEAR(value(id, LightProperty::intensity), 500.0, 0.01);
  EXPECT_FALSE(common(LightProperty::intensity).isMixed);
  // The colours do not change.
  const vec3 e =
      scene().materials[static_cast<size_t>(emissiveMaterials(scene(), node(glow_))[0])].emissive;
  EXPECT_NEAR(e.r / e.b, 4.0f, 1e-4f);
}

TEST_F(LightEdits, MultipliesAndOffsets) {
  session_.select({light_, point_});
  const double area = value(light_, LightProperty::intensity);
  const double bulb = value(point_, LightProperty::intensity);
  expectOneStep("lights.multiply intensity 2");
  EXPECT_NEAR(value(light_, LightProperty::intensity), 2.0 * area, 1e-3);
  EXPECT_NEAR(value(point_, LightProperty::intensity), 2.0 * bulb, 1e-3);
  expectOneStep("lights.offset intensity -10 lm");
  EXPECT_NEAR(value(point_, LightProperty::intensity), 2.0 * bulb - 10.0, 1e-3);
  // An intensity cannot become negative.
  expectOneStep("lights.offset intensity -1e6 lm");
  EXPECT_EQ(value(point_, LightProperty::intensity), 0.0);
}

TEST_F(LightEdits, ASharedMaterialIsChangedOnce) {
  session_.select({glow_, twin_});
  const double before = value(glow_, LightProperty::intensity);
  expectOneStep("lights.multiply intensity 3");
  EXPECT_NEAR(value(glow_, LightProperty::intensity), 3.0 * before, 1e-3);
}

TEST_F(LightEdits, TemperaturesKeepBrightness) {
  session_.select({light_, point_, spot_});
  const double before = value(light_, LightProperty::intensity);
  expectOneStep("lights.set temperature 2700");
  EXPECT_NEAR(value(spot_, LightProperty::temperature), 2700.0, 5.0);
  EXPECT_NEAR(value(light_, LightProperty::intensity), before, 1e-3);
  expectOneStep("lights.offset temperature 300");
  EXPECT_NEAR(value(point_, LightProperty::temperature), 3000.0, 10.0);
}

TEST_F(LightEdits, TheDefaultUnitIsTheDisplayedUnit) {
  session_.runAction("light.add sun");
  const NodeId sun = session_.document().active();
  expectOneStep("lights.set intensity 7");  // lux, whatever the unit of other lights
  EXPECT_NEAR(value(sun, LightProperty::intensity, LightUnit::lux), 7.0, 1e-3);
  session_.select({point_, spot_});
  session_.runAction("lights.unit cd");
  expectOneStep("lights.set intensity 8");
  EXPECT_NEAR(value(spot_, LightProperty::intensity, LightUnit::candela), 8.0, 1e-3);
  session_.select({point_, sun});  // the unit is cd, which the sun does not have
  expectOneStep("lights.set intensity 9");
  EXPECT_NEAR(value(point_, LightProperty::intensity, LightUnit::candela), 9.0, 1e-3);
  EXPECT_NEAR(value(sun, LightProperty::intensity, LightUnit::lux), 7.0, 1e-3);
}

TEST_F(LightEdits, OtherProperties) {
  session_.select({light_, spot_});
  expectOneStep("lights.set width 0.5");
  EXPECT_EQ(node(light_).area->size.x, 0.5f);
  EXPECT_EQ(node(light_).area->size.y, 1.0f);
  expectOneStep("lights.set outer_cone 30");
  EXPECT_NEAR(glm::degrees(node(spot_).punctual->outerCone), 30.0f, 1e-4f);
  expectOneStep("lights.colour 1 0.2 0.1");
  const vec3 c = node(light_).area->radiance;
  EXPECT_NEAR(c.g / c.r, 0.2f, 1e-4f);
  EXPECT_NEAR(luminance(c), 10.0f, 1e-3f);
}

TEST_F(LightEdits, InvalidEditsChangeNothing) {
  const uint64_t before = hash();
  EXPECT_FALSE(session_.runAction("lights.set intensity 5 lm"));  // nothing is selected
  session_.select({light_, box_});
  for (const char* action :
       {"lights.set", "lights.set intensity", "lights.set intensity -1 lm", "lights.set weight 1",
        "lights.set intensity 1 furlongs", "lights.set intensity 1 lx", "lights.set temperature 10",
        "lights.set temperature 2700 K", "lights.multiply intensity -2", "lights.set inner_cone 10",
        "lights.multiply intensity 2 lm", "lights.colour 0 0 0", "lights.colour 1 1", "lights.on",
        "lights.on yes", "lights.mute_group none true", "lights.select_group none",
        "lights.unit furlongs", "lights.set intensity nan lm"}) {
    EXPECT_FALSE(session_.runAction(action)) << action;
    EXPECT_EQ(session_.status().find('\n'), std::string::npos) << action;
    EXPECT_EQ(hash(), before) << action;
  }
}

TEST_F(LightEdits, StatesAndGroups) {
  session_.select({light_, point_});
  expectOneStep("lights.on false");
  EXPECT_FALSE(node(light_).light.on);
  expectOneStep("lights.on true");
  expectOneStep("lights.solo true");
  EXPECT_FALSE(shiningLights(scene()).nodes[4]);  // the spot
  expectOneStep("lights.group \"the kitchen\"");
  ASSERT_EQ(scene().lightGroups.size(), 1u);
  expectOneStep("lights.mute_group \"the kitchen\" true");
  expectOneStep("lights.solo_group \"the kitchen\" true");
  session_.select({});
  session_.runAction("lights.select_group \"the kitchen\"");
  EXPECT_EQ(session_.document().selection.size(), 2u);
  expectOneStep("lights.all_on");
  EXPECT_FALSE(anyLightDark(scene()));
  session_.select({light_});
  expectOneStep("lights.group hall");
  session_.select({point_});
  expectOneStep("lights.ungroup");  // the group had one light left, so it is removed
  ASSERT_EQ(scene().lightGroups.size(), 1u);
  EXPECT_EQ(scene().lightGroups[0].name, "hall");
  session_.runAction("sky.set 0.5");
  expectOneStep("sky.on false");
  expectOneStep("sky.solo true");
}

TEST_F(LightEdits, NewLightsOfEveryKindAreListed) {
  for (const char* kind : {"rectangle", "disk", "sphere", "tube", "spot", "point", "sun"}) {
    expectOneStep(std::string("light.add ") + kind);
    session_.select({scene().nodes.back().id});
    const auto added = selectedLights(session_.document());
    ASSERT_EQ(added.size(), 1u) << kind;
    std::string label = kindLabel(added[0].measure.kind);
    label[0] = static_cast<char>(std::tolower(label[0]));
    EXPECT_EQ(label, kind);
    session_.undo();
  }
}

// A new light illuminates the floor below it to about mid-grey.
TEST_F(LightEdits, NewLightsHaveASuitableIntensity) {
  lookFrom(vec3(3, 3, 3), -1.2f);
  for (const char* kind : {"rectangle", "disk", "sphere", "tube", "spot", "point"}) {
    session_.runAction(std::string("light.add ") + kind);
    const auto lights = selectedLights(session_.document());
    const double candela =
        valueOf(scene(), lights[0], LightProperty::intensity, LightUnit::candela).value();
    const float height = placeOf(lights[0].node).y;
    const double radiance = candela / static_cast<double>(height * height) / 3.14159 * 0.6;
    EXPECT_GT(radiance, 0.05) << kind;
    EXPECT_LT(radiance, 1.0) << kind;
    session_.undo();
  }
}

TEST_F(LightEdits, ProfilesAreReadFromFiles) {
  const std::string folder = (test::sourceFolder() / "assets/profiles/").string();
  session_.select({point_});
  const double lumens = value(point_, LightProperty::intensity);
  expectOneStep("light.ies " + folder + "downlight.ies");
  ASSERT_TRUE(node(point_).punctual->profile);
  EXPECT_NEAR(value(point_, LightProperty::intensity), lumens, 1e-3 * lumens);
  for (int i = 0; i < 50; ++i) session_.renderFrame();
  EXPECT_EQ(session_.renderError(), "");
  const uint64_t before = hash();
  for (const char* action : {"light.ies", "light.ies gone.ies"}) {
    EXPECT_FALSE(session_.runAction(action)) << action;
    EXPECT_EQ(hash(), before);
  }
  expectOneStep("light.ies none");
  EXPECT_NEAR(value(point_, LightProperty::intensity), lumens, 1e-3 * lumens);
  session_.select({light_});
  EXPECT_FALSE(session_.runAction("light.ies " + folder + "downlight.ies"));  // an area light
}

TEST_F(LightEdits, TheWorkLightIsNotPartOfTheDocument) {
  session_.runAction("select.all");
  session_.runAction("lights.on false");
  for (int i = 0; i < 400; ++i) session_.renderFrame();
  const auto mean = [&] {
    double sum = 0.0;
    for (const vec3& p : session_.output().radiance->pixels().pixels) sum += luminance(p);
    return sum;
  };
  EXPECT_EQ(mean(), 0.0);
  const uint64_t before = hash();
  const size_t steps = session_.history().position();
  ASSERT_TRUE(session_.runAction("view.work_light"));
  for (int i = 0; i < 100; ++i) session_.renderFrame();
  EXPECT_GT(mean(), 0.0);
  EXPECT_EQ(hash(), before);
  EXPECT_EQ(session_.history().position(), steps);
  EXPECT_EQ(session_.document().scene.find(kWorkLight), nullptr);
  // It moves with the camera.
  lookFrom(vec3(0, 2, 5), -0.3f);
  session_.renderFrame();
  EXPECT_EQ(session_.renderScene().punctuals.back().position, vec3(0, 2, 5));
  session_.runAction("view.work_light");
  for (int i = 0; i < 100; ++i) session_.renderFrame();
  EXPECT_EQ(mean(), 0.0);
}

}  // namespace
}  // namespace lamplighter
