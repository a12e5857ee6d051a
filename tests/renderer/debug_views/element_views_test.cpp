// Debug views of light on surfaces: a floor under a lamp, with a box on it.
#include <gtest/gtest.h>

#include "renderer/debug_views/view_colours.h"
#include "renderer/debug_views/view_picture.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

namespace colours = view_colours;

constexpr vec3 kFree{-1.5f, 0.0f, 1.2f}, kContact{0.0f, 0.0f, 0.43f};

class ElementViews : public testing::Test {
 protected:
  ElementViews() {
    const int grey = test::addMaterial(scene_, vec3(0.6f));
    test::addMesh(scene_, test::squareMesh(6.0f, grey));
    box_ = test::addMesh(scene_, test::boxMesh(vec3(0.8f), grey), vec3(0.0f, 0.41f, 0.0f));
    test::addRectangleLight(scene_, vec3(1.0f, 3.0f, 1.0f), vec2(0.5f), vec3(20.0f));
    settings_.set("indirect", std::string("meshes"));
    settings_.set("bounces", 2);
    settings_.set("antialias", 1);
  }
  void settle(const SceneChanges& changes = SceneChanges::all()) {
    test::renderSettled(renderer_, scene_, changes, view_, settings_);
  }
  ViewPicture draw(DebugView view) {
    const Inspection inspection = renderer_.inspect();
    return drawView(view, {renderer_.scene(), *renderer_.rays(), view_, inspection, 0, 0.0f});
  }
  vec3 colourAt(const ViewPicture& picture, const vec3& world) const {
    const vec3 p = view_.project(world);
    const uint8_t* c = picture.image.at(static_cast<int>(p.x), static_cast<int>(p.y));
    return vec3(c[0], c[1], c[2]) / 255.0f;
  }
  // How like a colour it is, but for shading; 1: the same hue.
  float likeness(DebugView view, const vec3& world, const vec3& colour) {
    return glm::dot(glm::normalize(colourAt(draw(view), world)), glm::normalize(colour));
  }

  Scene scene_;
  NodeId box_ = kNoNode;
  Settings settings_;
  View view_ = test::lookAt(vec3(0.0f, 4.0f, 4.0f), vec3(0.0f), 320, 240);
  FrameRenderer renderer_{makeCpuBackend()};
};

TEST_F(ElementViews, TellHowOldTheLightIs) {
  settings_.set("gather_rays", 1024);  // more than a frame traces
  renderer_.render({scene_, SceneChanges::all(), view_, "many_lights", settings_});
  EXPECT_LT(likeness(DebugView::meshAge, kFree, colours::kSettled), 0.95f);
  settle({});
  EXPECT_GT(likeness(DebugView::meshAge, kFree, colours::kSettled), 0.999f);
}

TEST_F(ElementViews, TellElementsFromRecords) {
  settle();
  EXPECT_GT(likeness(DebugView::meshSamples, kFree, colours::kNone), 0.999f);
  EXPECT_GT(likeness(DebugView::meshSamples, kContact, colours::kPartial), 0.99f);
}

TEST_F(ElementViews, ContrastIsThatOfTheCorners) {
  scene_.sky = vec3(1.0f);
  settle();
  // Open ground has even light; the box hides half of the sky.
  EXPECT_GT(likeness(DebugView::meshContrast, vec3(-2.6f, 0.0f, -2.0f), colours::ramp(0.0f)),
            0.99f);
  EXPECT_LT(likeness(DebugView::meshContrast, kContact, colours::ramp(0.0f)), 0.98f);
}

TEST_F(ElementViews, EdgesAreBetweenElements) {
  settle();
  const ViewPicture picture = draw(DebugView::meshEdges);
  EXPECT_EQ(picture.problem, "");
  // Along a line over the floor, elements are as long as coarse_edge at most.
  int changes = 0;
  vec3 last = colourAt(picture, vec3(-2.5f, 0.0f, 1.5f));
  for (float x = -2.5f; x < 2.5f; x += 0.02f) {
    const vec3 now = colourAt(picture, vec3(x, 0.0f, 1.5f));
    changes += glm::distance(now, last) > 0.05f ? 1 : 0;
    last = now;
  }
  EXPECT_GE(changes, 20);
}

TEST_F(ElementViews, NeedLightOnSurfaces) {
  settings_.set("indirect", std::string("samples"));
  settle();
  for (const DebugView view :
       {DebugView::meshEdges, DebugView::meshSamples, DebugView::meshContrast, DebugView::meshAge})
    EXPECT_NE(draw(view).problem.find("indirect=meshes"), std::string::npos);
}

}  // namespace
}  // namespace lamplighter
