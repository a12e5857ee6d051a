// The views of a session: switching by name and key, the chosen light sample, light sample marks.
#include "editor/debug_views/view_display.h"

#include <algorithm>

#include "editor/input/recording.h"
#include "renderer/image/tone_map.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

class ViewDisplayTest : public test::SessionFixture {
 protected:
  void SetUp() override {
    SessionFixture::SetUp();
    settle();
  }
  void settle() {
    for (int i = 0; i < 100 && !session_.renderFrame().settled; ++i) {
    }
  }
  void setTechnique(const std::string& technique) {
    ASSERT_TRUE(session_.runAction("render.set technique=" + technique));
    settle();
  }
  // Light samples carry bounced light.
  void useSamples() {
    ASSERT_TRUE(session_.runAction("render.set indirect=samples"));
    settle();
  }
  const ViewPicture* shown() const { return session_.display().picture().get(); }
};

TEST_F(ViewDisplayTest, EveryViewHasAnAction) {
  const uint64_t before = hash();
  setTechnique("light_maps");
  int edits = 1;  // the technique and transfer; views are no undo steps
  for (const DebugViewInfo& info : debugViews()) {
    SCOPED_TRACE(info.name);
    // With transfer, light samples carry bounced light.
    const bool needsElements =
        std::ranges::find(info.needs, Capability::elements) != info.needs.end();
    for (const char* setting :
         {needsElements ? "render.set prt=false" : "render.set prt=true",
          needsElements ? "render.set indirect=meshes" : "render.set indirect=automatic"}) {
      const uint64_t last = hash();
      session_.runAction(setting);
      if (hash() != last) ++edits;
    }
    InputEvent event{EventKind::action};
    event.text = std::string("view.") + info.name;
    EXPECT_NE(lineText({3, event}).find(event.text), std::string::npos);
    ASSERT_TRUE(session_.runAction(event.text)) << session_.status();
    settle();
    EXPECT_EQ(session_.display().view(), info.view);
    EXPECT_EQ(shown() == nullptr, isRadiance(info.view));
    for (const DebugViewInfo& other : debugViews()) {
      const Action* action = session_.actions().find(std::string("view.") + other.name);
      EXPECT_EQ(action->checked(session_), other.view == info.view);
    }
    const Image8 picture = session_.picture();
    EXPECT_EQ(picture.width, 320);
    if (shown() != nullptr) {
      EXPECT_EQ(shown()->problem.empty(), info.method.empty())
          << "views of other methods have a problem";
      EXPECT_EQ(picture.pixels, shown()->image.pixels);
    }
  }
  for (int i = 0; i < edits; ++i) session_.undo();
  EXPECT_EQ(hash(), before);
}

TEST_F(ViewDisplayTest, KeysMatchTheTable) {
  for (const auto& [key, name] : {std::pair{Key::n1, "view.lit"},
                                  {Key::n2, "view.light_only"},
                                  {Key::n3, "view.albedo"},
                                  {Key::n4, "view.normals"},
                                  {Key::n5, "view.flat"}}) {
    const Action* action = session_.actions().forKey(key, {.alt = true});
    ASSERT_NE(action, nullptr) << name;
    EXPECT_EQ(action->name, name);
  }
}

TEST_F(ViewDisplayTest, APictureIsRedrawnOnlyAfterAChange) {
  session_.runAction("view.flat");
  settle();
  const auto first = session_.display().picture();
  session_.renderFrame();
  EXPECT_EQ(session_.display().picture(), first);
  lookFrom(vec3(0, 2, 5), -0.25f);
  settle();
  const auto nearer = session_.display().picture();
  EXPECT_NE(nearer->image.pixels, first->image.pixels);
  Transform up = local(box_);
  up.translation.y += 0.5f;
  session_.setNodeTransform(box_, up);
  settle();
  EXPECT_NE(session_.display().picture()->image.pixels, nearer->image.pixels);
}

TEST_F(ViewDisplayTest, TheStatusShowsWhatAViewNeeds) {
  EXPECT_EQ(session_.display().viewText(), "");
  setTechnique("naive");
  session_.runAction("view.light_maps");
  settle();
  EXPECT_NE(session_.display().viewText().find("with the technique light_maps"), std::string::npos);
  setTechnique("light_maps");
  EXPECT_EQ(session_.display().viewText(), "Light maps");
}

TEST_F(ViewDisplayTest, ALightSampleIsChosenByNumber) {
  useSamples();
  setTechnique("visibility");
  session_.runAction("view.occlusion");
  settle();
  const Scene& scene = session_.document().scene;
  const auto text = [&] { return session_.display().vplText(scene, session_.inspect(), 1.0f); };
  EXPECT_TRUE(text().starts_with("VPL 0 of 16, light, direct")) << text();
  const auto first = session_.picture().pixels;
  int below = 0;  // an indirect sample, which shows another picture
  const auto lights = session_.inspect().lights;
  while (lights[static_cast<size_t>(below)].id.bounce == 0) ++below;
  ASSERT_TRUE(session_.runAction("view.choose_vpl " + std::to_string(below)));
  settle();
  EXPECT_NE(text().find("bounce"), std::string::npos) << text();
  EXPECT_NE(session_.picture().pixels, first);
  for (const std::string bad : {"16", "-1", "1.5", "one", ""}) {
    EXPECT_FALSE(session_.runAction("view.choose_vpl " + bad)) << bad;
    EXPECT_EQ(session_.display().chosen(session_.inspect()), below);
  }
}

TEST_F(ViewDisplayTest, AClickOnAMarkOnlyChoosesItsLightSample) {
  useSamples();
  const auto lights = session_.inspect().lights;
  size_t target = lights.size();  // a sample whose mark is visible
  for (size_t i = 1; i < lights.size(); ++i) {
    const vec3 position(lights[i].vpl.position);
    if (lights[i].id.bounce > 0 && position.y < 0.1f && position.z > 1.0f) target = i;
  }
  ASSERT_LT(target, lights.size());
  const vec2 at = pixelOf(vec3(lights[target].vpl.position));
  press(at);
  release();
  EXPECT_TRUE(session_.document().isSelected(floor_));  // hidden marks cannot be clicked
  EXPECT_EQ(session_.display().chosen(session_.inspect()), 0);
  session_.select({});

  ASSERT_TRUE(session_.runAction("view.vpls"));
  const size_t marks = session_.overlay().shapes.size();
  press(at);
  release();
  EXPECT_EQ(session_.display().chosen(session_.inspect()), static_cast<int>(target));
  EXPECT_TRUE(session_.document().selection.empty());
  ASSERT_TRUE(session_.runAction("view.vpls"));
  EXPECT_GE(marks, session_.overlay().shapes.size() + 3 * lights.size() / 2);
}

TEST_F(ViewDisplayTest, PendingSamplesAreMarked) {
  session_.runAction("view.vpls");
  const size_t settled = session_.overlay().shapes.size();
  session_.runAction("render.set updates=1");
  Transform up = local(box_);
  up.translation.y += 0.1f;
  session_.setNodeTransform(box_, up);
  session_.renderFrame();
  ASSERT_GT(session_.output().stats.of("vpls_pending"), 3);
  EXPECT_GT(session_.overlay().shapes.size(), settled + 2);
}

// Each frame estimates the number of frames until the picture is settled. The estimate is exact if
// all frames do the same work.
TEST_F(ViewDisplayTest, TheEstimateOfFramesUntilSettledIsExact) {
  useSamples();
  for (const int antialias : {1, 4}) {
    session_.runAction("render.set antialias=" + std::to_string(antialias));
    session_.runAction("render.set updates=3");
    settle();
    EXPECT_EQ(session_.output().stats.framesUntilSettled, 0);
    Transform up = local(light_);
    up.translation.y += 0.1f;
    session_.setNodeTransform(light_, up);
    const int told = session_.renderFrame().stats.framesUntilSettled;
    EXPECT_GT(told, 2);
    // Indirect samples are replaced path by path, and the path lengths are not known in advance.
    int came = 0;
    for (int left = told; !session_.output().settled; ++came) {
      ASSERT_LT(came, 1000);
      EXPECT_GT(left, 0);
      left = session_.renderFrame().stats.framesUntilSettled;
    }
    EXPECT_LT(told, 2 * came);
    EXPECT_LT(came, 2 * told);
    EXPECT_EQ(session_.output().stats.framesUntilSettled, 0);
  }
}

TEST_F(ViewDisplayTest, AToneMapperIsASettingOfTheDisplay) {
  const uint64_t before = hash();
  const Image8 filmic = session_.picture();
  ASSERT_TRUE(session_.runAction("view.tone_mapper linear"));
  EXPECT_EQ(session_.picture().pixels,
            toneMap(session_.output().radiance->pixels(), session_.document().render.exposureEv,
                    ToneMapper::linear)
                .pixels);
  EXPECT_NE(session_.picture().pixels, filmic.pixels);
  EXPECT_FALSE(session_.runAction("view.tone_mapper brown"));
  EXPECT_FALSE(session_.runAction("view.tone_mapper"));
  EXPECT_EQ(session_.display().toneMapper(), ToneMapper::linear);
  EXPECT_EQ(hash(), before);
  EXPECT_FALSE(session_.editing().canUndo());
  // The histogram describes the displayed picture.
  ASSERT_TRUE(session_.runAction("view.histogram"));
  EXPECT_TRUE(session_.display().showsHistogram());
  const auto counted = [&] {
    return session_.display().histogram(session_.output().radiance,
                                        session_.document().render.exposureEv);
  };
  const float white = counted().white;
  ASSERT_TRUE(session_.runAction("render.exposure 10"));
  EXPECT_GT(counted().white, white);
}

TEST_F(ViewDisplayTest, FalseColourHasAUnitAndARange) {
  ASSERT_TRUE(session_.runAction("view.false_colour"));
  settle();
  ASSERT_NE(shown(), nullptr);
  EXPECT_EQ(shown()->legend.title, "Illuminance [lx]");
  ASSERT_TRUE(session_.runAction("view.false_colour_unit nits"));
  ASSERT_TRUE(session_.runAction("view.false_colour_range 0.1 100"));
  settle();
  EXPECT_NE(shown()->legend.title.find("Luminance"), std::string::npos);
  EXPECT_EQ(shown()->legend.ticks.front().second, "0.1");
  EXPECT_EQ(shown()->legend.ticks.back().second, "100");
  EXPECT_FALSE(session_.runAction("view.false_colour_range 100 0.1"));
  EXPECT_FALSE(session_.runAction("view.false_colour_range 1"));
  EXPECT_FALSE(session_.runAction("view.false_colour_range 0 1"));
  EXPECT_FALSE(session_.runAction("view.false_colour_unit candles"));
  EXPECT_EQ(session_.display().falseColour(), (FalseColour{false, 0.1f, 100.0f}));
  ASSERT_TRUE(session_.runAction("view.false_colour_range"));
  EXPECT_EQ(session_.display().falseColour().high, 0.0f);
}

TEST_F(ViewDisplayTest, TheChosenLightFollowsTheSelection) {
  setTechnique("light_maps");
  const Inspection inspection = session_.inspect();
  EXPECT_EQ(session_.display().chosenLight(inspection), light_);  // the light of the first sample
  ASSERT_TRUE(session_.runAction("view.choose_light box"));       // not a light: nothing changes
  EXPECT_EQ(session_.display().chosenLight(inspection), light_);
  session_.select({light_});
  session_.renderFrame();
  EXPECT_EQ(session_.display().chosenLight(session_.inspect()), light_);
  EXPECT_FALSE(session_.runAction("view.choose_light nobody"));
}

}  // namespace
}  // namespace lamplighter
