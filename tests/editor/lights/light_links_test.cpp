// Actions for light linking and for pictures on lights. Each is one step with undo and redo.
#include "editor/lights/light_links.h"

#include <fstream>

#include <gmock/gmock.h>

#include "editor/explain/explanation.h"
#include "editor/lights/light_list.h"
#include "renderer/image/image_io.h"
#include "renderer/scene/light_linking.h"
#include "renderer/scene/light_picture.h"
#include "tests/editor/session_fixture.h"
#include "tests/support/scenes/gltf_files.h"

namespace lamplighter {
namespace {

using testing::ElementsAre;

class LightLinks_ : public test::SessionFixture {
 protected:
  NodeId bulb_ = 0;
  void addMore(Scene& scene) override {
    bulb_ = test::addNode(scene, "bulb", kNoNode, vec3(1, 2, 0));
    scene.find(bulb_)->punctual = PunctualLight{PunctualKind::point, vec3(5.0f)};
    scene.find(light_)->name = "lamp";
  }
  const std::vector<NodeId>& leftOut(NodeId id) const { return node(id).light.leftOut; }
};

TEST_F(LightLinks_, ObjectsAreExcludedAndIncludedAgain) {
  session_.select({box_, bulb_, light_});
  expectOneStep("light.exclude");
  EXPECT_THAT(leftOut(light_), ElementsAre(box_));
  EXPECT_THAT(leftOut(bulb_), ElementsAre(box_));
  session_.select({light_});
  expectOneStep("light.exclude floor");
  EXPECT_THAT(leftOut(light_), ElementsAre(floor_, box_));
  EXPECT_THAT(leftOutBySelection(session_.document()), ElementsAre(floor_, box_));
  expectOneStep("light.include box");
  EXPECT_THAT(leftOut(light_), ElementsAre(floor_));
  expectOneStep("light.include");
  EXPECT_TRUE(leftOut(light_).empty());
  session_.select({bulb_});
  EXPECT_TRUE(session_.runAction("light.select_excluded"));
  EXPECT_THAT(session_.document().selection, ElementsAre(box_));
}

TEST_F(LightLinks_, TheSkyExcludesObjectsToo) {
  session_.setSky(Sky(vec3(0.5f)));
  session_.select({box_});
  expectOneStep("sky.exclude");
  EXPECT_THAT(session_.document().scene.skyLight.leftOut, ElementsAre(box_));
  session_.select({});
  expectOneStep("sky.include");
}

TEST_F(LightLinks_, InvalidLinksAreRefusedAndChangeNothing) {
  const uint64_t before = hash();
  session_.select({light_});
  EXPECT_FALSE(session_.runAction("light.exclude"));  // no object in addition to the light
  EXPECT_FALSE(session_.runAction("light.exclude nobody"));
  EXPECT_EQ(hash(), before);
}

TEST_F(LightLinks_, TooManyDifferentListsAreRefused) {
  Scene scene = session_.document().scene;
  std::vector<NodeId> lamps;
  for (uint32_t i = 0; i <= kMostLinks; ++i) {
    lamps.push_back(test::addNode(scene, "lamp " + std::to_string(i)));
    scene.find(lamps.back())->punctual = PunctualLight{};
    const NodeId own = test::addNode(scene, "thing " + std::to_string(i));
    if (i < kMostLinks) scene.find(lamps.back())->light.leftOut = {own};
  }
  open(std::move(scene));
  const uint64_t before = hash();
  session_.select({lamps.back()});
  EXPECT_FALSE(session_.runAction("light.exclude floor"));
  EXPECT_EQ(hash(), before);
  EXPECT_TRUE(session_.runAction("light.exclude \"thing 3\"")) << session_.status();
}

// If a light and an excluded object are copied together, the new light excludes both objects.
TEST_F(LightLinks_, CopiesKeepTheirExcludedObjects) {
  session_.select({box_, light_});
  ASSERT_TRUE(session_.runAction("light.exclude"));
  ASSERT_TRUE(session_.runAction("edit.copy"));
  ASSERT_TRUE(session_.runAction("edit.paste"));
  const Document& d = session_.document();
  NodeId boxCopy = 0, lampCopy = 0;
  for (const NodeId id : d.selection) (d.scene.find(id)->area ? lampCopy : boxCopy) = id;
  EXPECT_THAT(leftOut(lampCopy), ElementsAre(box_, boxCopy));
  EXPECT_THAT(leftOut(light_), ElementsAre(box_));
}

TEST_F(LightLinks_, TheExplanationNamesTheExclusion) {
  session_.select({light_});
  ASSERT_TRUE(session_.runAction("light.exclude floor"));
  session_.renderFrame();
  const auto point = surfaceAt(session_.renderScene(), *session_.renderer().rays(), session_.view(),
                               pixelOf(vec3(1.5f, 0, 1)));
  ASSERT_TRUE(point);
  ASSERT_EQ(point->node, floor_);
  const Explanation e = explain(
      session_.document().scene, session_.renderScene(), *session_.renderer().rays(), *point,
      lightSamples(session_.inspect(), session_.renderScene(), *session_.renderer().rays(),
                   session_.document().render.values));
  bool isTold = false;
  for (const LightShare& l : e.lights) {
    if (l.light != light_) continue;
    isTold = true;
    EXPECT_EQ(l.state, LightArrival::leftOut);
    EXPECT_EQ(l.direct, 0.0f);
  }
  EXPECT_TRUE(isTold);
}

TEST_F(LightLinks_, APictureKeepsTheFlux) {
  const test::TemporaryFolder folder;
  Image8 image(4, 4);
  for (size_t i = 0; i < image.pixels.size(); i += 4) image.pixels[i + 1] = 90;
  writePng(image, folder.path() / "screen.png");
  const auto lumens = [&] {
    const Scene& scene = session_.document().scene;
    const Node& lamp = node(light_);
    return static_cast<double>(luminance(lamp.area->radiance)) *
           unitsPerRadiance(measureOf(scene, lamp, worldMatrix(scene, lamp.id)), LightUnit::lumens);
  };
  const double before = lumens();
  session_.select({light_});
  expectOneStep("light.picture \"" + (folder.path() / "screen.png").string() + "\"");
  ASSERT_NE(node(light_).area->picture, nullptr);
  EXPECT_EQ(node(light_).area->picture->file, "screen.png");
  EXPECT_NEAR(lumens() / before, 1.0, 1e-5);
  EXPECT_GT(luminance(node(light_).area->radiance), 11.0f);
  expectOneStep("light.picture none");
  EXPECT_NEAR(lumens() / before, 1.0, 1e-5);
  EXPECT_FALSE(session_.runAction("light.picture nowhere.png"));
  session_.select({bulb_});
  EXPECT_FALSE(session_.runAction("light.picture none"));
}

}  // namespace
}  // namespace lamplighter
