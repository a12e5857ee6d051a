// The handles for the size and direction of the active light.
#include "editor/tools/light_handles.h"

#include <algorithm>
#include <cmath>

#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

using Kind = LightHandles::Kind;

class LightHandlesTest : public test::SessionFixture {
 protected:
  void addMore(Scene& scene) override {
    Node spot;
    spot.id = spot_ = scene.nextId++;
    spot.name = "spot";
    spot.local.translation = vec3(2, 2, 0);
    spot.local.rotation = glm::angleAxis(-0.5f * kPi, vec3(1, 0, 0));
    PunctualLight light;
    light.kind = PunctualKind::spot;
    light.innerCone = 0.2f;
    light.outerCone = 0.5f;
    spot.punctual = light;
    scene.nodes.push_back(spot);
  }
  vec3 handle(Kind kind) const {
    for (const auto& h : LightHandles::handlesOf(session_.view(), session_.document()))
      if (h.kind == kind) return h.place;
    ADD_FAILURE() << "no such handle";
    return vec3(0.0f);
  }
  void drag(Kind kind, const vec3& to, Modifiers modifiers = {}) {
    press(pixelOf(handle(kind)), 0, modifiers);
    dragTo(pixelOf(to));
    release();
  }
  NodeId spot_ = 0;
};

TEST_F(LightHandlesTest, DraggingAnEdgeKeepsTheOppositeEdge) {
  lookFrom(vec3(0, 1, 6), 0.4f);  // from below, where the light shines
  session_.select({light_});
  const uint64_t before = hash();
  const vec3 right = handle(Kind::right), left = handle(Kind::left);
  drag(Kind::right, right + 0.6f * (right - left));
  EXPECT_NEAR(node(light_).area->size.x, 1.6f, 0.02f);
  EXPECT_FLOAT_EQ(node(light_).area->size.y, 1.0f);
  EXPECT_LT(glm::length(handle(Kind::left) - left), 1e-4f);
  session_.undo();
  EXPECT_EQ(hash(), before);
}

TEST_F(LightHandlesTest, WithShiftBothEdgesMove) {
  lookFrom(vec3(0, 1, 6), 0.4f);
  session_.select({light_});
  const vec3 middle = placeOf(light_), top = handle(Kind::top);
  Modifiers shift;
  shift.shift = true;
  drag(Kind::top, middle + 1.5f * (top - middle), shift);
  EXPECT_NEAR(node(light_).area->size.y, 1.5f, 0.02f);
  EXPECT_EQ(placeOf(light_), middle);
}

TEST_F(LightHandlesTest, SnappedSizesAreMultiplesOfTheStep) {
  lookFrom(vec3(0, 1, 6), 0.4f);
  session_.select({light_});
  Modifiers ctrl;
  ctrl.ctrl = true;
  const vec3 right = handle(Kind::right);
  drag(Kind::right, right + 0.33f * (right - placeOf(light_)), ctrl);
  const float steps = node(light_).area->size.x / 0.05f;
  EXPECT_NEAR(steps, std::round(steps), 1e-3f);
  EXPECT_GT(node(light_).area->size.x, 1.01f);
}

TEST_F(LightHandlesTest, TheRimSetsTheDiameterOfADisk) {
  AreaLight disk = *node(light_).area;
  disk.shape = AreaShape::disk;
  session_.setAreaLight(light_, disk);
  lookFrom(vec3(0, 1, 6), 0.4f);
  session_.select({light_});
  const vec3 rim = handle(Kind::rim);
  drag(Kind::rim, placeOf(light_) + 1.4f * (rim - placeOf(light_)));
  EXPECT_NEAR(node(light_).area->size.x, 1.4f, 0.03f);
}

TEST_F(LightHandlesTest, ATubeHasHandlesForLengthAndDiameter) {
  AreaLight tube;
  tube.shape = AreaShape::tube;
  tube.size = vec2(2.0f, 0.2f);
  session_.setAreaLight(light_, tube);
  lookFrom(vec3(0, 3, 6), 0.0f);
  session_.select({light_});
  const vec3 right = handle(Kind::right), left = handle(Kind::left), rim = handle(Kind::rim);
  EXPECT_NEAR(glm::length(right - left), 2.0f, 1e-4f);
  EXPECT_NEAR(glm::length(rim - placeOf(light_)), 0.1f, 1e-4f);
  drag(Kind::right, right + 0.25f * (right - left));
  EXPECT_NEAR(node(light_).area->size.x, 2.5f, 0.03f);
  EXPECT_LT(glm::length(handle(Kind::left) - left), 1e-4f);
  const vec3 middle = placeOf(light_);
  drag(Kind::rim, middle + 3.0f * (handle(Kind::rim) - middle));
  EXPECT_NEAR(node(light_).area->size.y, 0.6f, 0.03f);
  EXPECT_NEAR(node(light_).area->size.x, 2.5f, 0.03f);
}

TEST_F(LightHandlesTest, ALightIsAimedAtThePointUnderThePointer) {
  session_.select({spot_});
  const uint64_t before = hash();
  const vec3 target(-1.5f, 0.0f, 1.0f);
  drag(Kind::aim, target);
  const vec3 aim = mat3(worldMatrix(session_.document().scene, spot_)) * vec3(0, 0, -1);
  EXPECT_LT(glm::length(glm::normalize(aim) - glm::normalize(target - placeOf(spot_))), 0.02f);
  session_.undo();
  EXPECT_EQ(hash(), before);
}

TEST_F(LightHandlesTest, TheInnerConeStaysWithinTheOuterCone) {
  session_.select({spot_});
  const vec3 origin = placeOf(spot_), aim(0, -1, 0);
  const vec3 outer = handle(Kind::outerCone);
  const vec3 side = glm::normalize(outer - origin - glm::dot(outer - origin, aim) * aim);
  const float reach = glm::length(outer - origin);
  drag(Kind::outerCone, origin + reach * (std::cos(0.9f) * aim + std::sin(0.9f) * side));
  EXPECT_NEAR(node(spot_).punctual->outerCone, 0.9f, 0.02f);
  EXPECT_FLOAT_EQ(node(spot_).punctual->innerCone, 0.2f);
  drag(Kind::outerCone, origin + reach * (std::cos(0.1f) * aim + std::sin(0.1f) * side));
  EXPECT_NEAR(node(spot_).punctual->outerCone, 0.1f, 0.02f);
  EXPECT_EQ(node(spot_).punctual->innerCone, node(spot_).punctual->outerCone);
}

TEST_F(LightHandlesTest, EscapeRevertsADrag) {
  lookFrom(vec3(0, 1, 6), 0.4f);
  session_.select({light_});
  const uint64_t before = hash();
  press(pixelOf(handle(Kind::right)));
  dragTo(pixelOf(handle(Kind::right) + vec3(0.5f, 0, 0)));
  EXPECT_NE(hash(), before);
  EXPECT_TRUE(session_.dragging());
  session_.perform("select.none");
  EXPECT_EQ(hash(), before);
  EXPECT_FALSE(session_.dragging());
}

}  // namespace
}  // namespace lamplighter
