// The gizmo in difficult cases: parents that scale, mirror or collapse, rings seen from the side,
// pointers beyond the horizon.
#include <cmath>

#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

class GizmoTest : public test::SessionFixture {
 protected:
  NodeId doubled_ = 0, mirrored_ = 0, flat_ = 0;  // parents
  NodeId inDoubled_ = 0, inMirrored_ = 0, inFlat_ = 0;

  void addMore(Scene& scene) override {
    const auto child = [&](NodeId& parent, const vec3& scale) {
      parent = test::addNode(scene, "parent");
      scene.find(parent)->local.scale = scale;
      scene.find(parent)->local.rotation = glm::angleAxis(0.6f, vec3(0, 1, 0));
      const NodeId id = test::addNode(scene, "child", parent, vec3(0, 0.25f, 0));
      scene.find(id)->local.scale = vec3(1, 2, 3);
      return id;
    };
    inDoubled_ = child(doubled_, vec3(2.0f));
    inMirrored_ = child(mirrored_, vec3(-1.0f, 1.0f, 1.0f));
    inFlat_ = child(flat_, vec3(1.0f, 0.0f, 1.0f));
  }
  mat3 worldAxes(NodeId id) const { return mat3(worldMatrix(session_.document().scene, id)); }

  // Rotates the selection about the Y axis of the world by dragging along the near half of the
  // ring.
  void turnAboutY(NodeId id, float from, float to) {
    session_.select({id});
    session_.setTool(ToolMode::rotate);
    const vec3 o = placeOf(id);
    const float r = along(o, 92.0f);
    press(pixelOf(o + r * vec3(std::sin(from), 0, std::cos(from))));
    dragTo(pixelOf(o + r * vec3(std::sin(to), 0, std::cos(to))));
    release();
  }
};

void expectNear(const mat3& a, const mat3& b, float tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_LT(glm::length(a[i] - b[i]), tolerance) << "axis " << i;
}

TEST_F(GizmoTest, MovesInWorldSpaceUnderAnyParent) {
  for (const NodeId id : {inDoubled_, inMirrored_}) {
    session_.select({id});
    session_.setTool(ToolMode::move);
    const vec3 was = placeOf(id);
    pressXArrow();
    dragTo(pixelOf(was + vec3(along(was) + 1.0f, 0, 0)));
    release();
    EXPECT_LT(glm::length(placeOf(id) - was - vec3(1, 0, 0)), 0.02f);
  }
}

TEST_F(GizmoTest, RotatesInWorldSpaceUnderAnyParentAndKeepsTheShape) {
  for (const NodeId id : {inDoubled_, inMirrored_}) {
    const mat3 was = worldAxes(id);
    const vec3 place = placeOf(id);
    turnAboutY(id, 0.2f, 0.7f);
    expectNear(worldAxes(id), mat3(glm::mat4_cast(glm::angleAxis(0.5f, vec3(0, 1, 0)))) * was,
               0.15f);  // a pixel of the drag is 0.01 rad, the longest axis 6 m
    EXPECT_LT(glm::length(placeOf(id) - place), 1e-4f);
    EXPECT_EQ(local(id).scale, vec3(1, 2, 3)) << "a rotation does not change the scale";
    EXPECT_EQ(local(id).shear, vec3(0.0f));
  }
}

TEST_F(GizmoTest, DoesNothingUnderAParentWithAScaleOfZero) {
  const uint64_t before = hash();
  for (const ToolMode mode : {ToolMode::move, ToolMode::rotate, ToolMode::scale}) {
    session_.select({inFlat_});  // a press without a handle selects an object
    session_.setTool(mode);
    const vec3 o = placeOf(inFlat_);
    press(pixelOf(o + vec3(along(o, mode == ToolMode::rotate ? 92.0f : 60.0f), 0, 0)));
    dragTo(input_.pointer + vec2(25, 10));
    release();
  }
  EXPECT_EQ(hash(), before);
  EXPECT_TRUE(session_.runAction("object.drop") || !session_.status().empty());
  EXPECT_TRUE(std::isfinite(glm::length(local(inFlat_).translation)));
}

TEST_F(GizmoTest, ARingSeenFromTheSideFollowsThePointer) {
  lookFrom(vec3(0, 0.5f, 6), 0.0f);  // the ring about Y appears as a horizontal line
  session_.select({box_});
  session_.setTool(ToolMode::rotate);
  press(pixelOf(vec3(0, 0.5f, 0)) + vec2(3, 0));
  ASSERT_TRUE(session_.editing().inTransaction()) << "the ring can be dragged";
  float last = 0.0f;
  for (int i = 1; i <= 6; ++i) {
    dragTo(input_.pointer + vec2(12, 0));
    const Transform& t = local(box_);
    const float angle = 2.0f * std::atan2(t.rotation.y, t.rotation.w);
    EXPECT_GT(angle, last + 0.05f) << "step " << i;  // dragging right moves the near side right
    EXPECT_LT(angle, last + 0.5f) << "step " << i;
    last = angle;
  }
  release();
  EXPECT_NEAR(local(box_).rotation.x, 0.0f, 1e-5f);
}

TEST_F(GizmoTest, BeyondTheHorizonTheObjectStays) {
  session_.select({box_});
  session_.setTool(ToolMode::move);
  // The square that moves in the XZ plane lies between both axes.
  const float s = 0.39f * along(vec3(0, 0.5f, 0), 92.0f);
  press(pixelOf(vec3(s, 0.5f, s)));
  ASSERT_TRUE(session_.editing().inTransaction());
  float furthest = 0.0f;
  const float start = input_.pointer.y;
  for (float y = start; y > 1.0f; y -= 4.0f) {
    dragTo(vec2(input_.pointer.x, y));
    const float z = local(box_).translation.z;
    EXPECT_LE(z, furthest + 1e-3f) << "never back towards the eye, at " << y;
    EXPECT_LT(std::abs(z), 1000.0f) << "nor out of sight";
    EXPECT_NEAR(local(box_).translation.y, 0.5f, 1e-5f);
    furthest = std::min(furthest, z);
  }
  release();
  EXPECT_LT(local(box_).translation.z, -1.0f);
}

TEST_F(GizmoTest, PastTheVanishingPointAnAxisDoesNotJumpBehindTheEye) {
  session_.select({box_});
  session_.setTool(ToolMode::move);
  View view = session_.view();  // looks almost along −Z, so that the Z axis runs into the picture
  view.eye = vec3(2, 1.5f, 5);
  view.orientation = glm::angleAxis(0.3f, vec3(0, 1, 0)) * glm::angleAxis(-0.1f, vec3(1, 0, 0));
  session_.setView(view);
  const vec3 o = placeOf(box_);
  press(pixelOf(o + vec3(0, 0, along(o, 60.0f))));
  ASSERT_TRUE(session_.editing().inTransaction());
  const vec2 from = input_.pointer;
  const vec2 vanishing = pixelOf(vec3(0, 0.5f, -1e5f));
  for (int i = 1; i <= 40; ++i) {
    dragTo(glm::mix(
        from, vanishing,
        0.05f * static_cast<float>(i)));  // up to twice the distance to the vanishing point
    EXPECT_LE(local(box_).translation.z, 0.01f) << i;
  }
  release();
}

TEST_F(GizmoTest, TheUniformHandleScalesAllAxesAlike) {
  session_.select({box_});
  session_.setTool(ToolMode::scale);
  press(pixelOf(vec3(0, 0.5f, 0)));
  dragTo(input_.pointer + vec2(92, 0));
  release();
  EXPECT_NEAR(local(box_).scale.x, 2.0f, 0.02f);
  EXPECT_EQ(local(box_).scale.x, local(box_).scale.y);
  EXPECT_EQ(local(box_).scale.x, local(box_).scale.z);
  EXPECT_EQ(session_.history().undoLabel(), "Scale box");
}

TEST_F(GizmoTest, TheRightButtonRevertsADrag) {
  session_.select({box_});
  session_.setTool(ToolMode::move);
  const uint64_t before = hash();
  pressXArrow();
  dragTo(input_.pointer + vec2(30, 0));
  EXPECT_NE(hash(), before);
  input_.pressed[1] = input_.down[1] = true;
  frame();
  EXPECT_EQ(hash(), before);
  EXPECT_FALSE(session_.editing().canUndo());
}

TEST_F(GizmoTest, RotationSnapsToFifteenDegrees) {
  session_.select({box_});
  session_.setTool(ToolMode::rotate);
  session_.setSnapping(true);
  turnAboutY(box_, 0.2f, 0.8f);  // 34°
  EXPECT_NEAR(2.0f * std::atan2(local(box_).rotation.y, local(box_).rotation.w), kPi / 6.0f, 1e-4f);
}

TEST_F(GizmoTest, HandlesKeepTheirSizeOnTheScreen) {
  session_.select({box_});
  session_.setTool(ToolMode::move);
  // The arrow along X is perpendicular to the view: 92 px long at any distance.
  for (const float distance : {4.0f, 6.0f, 40.0f}) {
    lookFrom(vec3(0, 0.5f, distance), 0.0f);
    float furthest = 0.0f;
    for (const OverlayShape& s : session_.overlay().shapes) {
      if (s.filled) continue;
      for (const vec2& p : s.points) {
        if (s.points.size() == 2 && std::abs(p.y - 100.0f) < 0.5f)
          furthest = std::max(furthest, p.x - 160.0f);
      }
    }
    EXPECT_NEAR(furthest, 92.0f, 1.0f) << distance;
  }
}

}  // namespace
}  // namespace lamplighter
