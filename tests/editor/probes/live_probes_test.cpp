// Light probes in the editor: computed over many frames, and again after an edit.
#include "editor/probes/live_probes.h"

#include "editor/probes/probe_overlay.h"
#include "renderer/base/threads.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

class LiveProbesTest : public test::SessionFixture {
 protected:
  // Returns how many frames it took; fails the test if they do not end.
  int settle() {
    for (int frames = 1; frames < 2000; ++frames) {
      session_.renderFrame();
      if (session_.probes().settled()) return frames;
    }
    ADD_FAILURE() << "the probes are not settled";
    return 0;
  }
  void expectReference() {
    const RenderScene& scene = session_.renderScene();
    const RayCaster& rays = *session_.renderer().rays();
    const LiveProbes& probes = session_.probes();
    const ProbeGrid grid = placeProbes(scene, rays, probes.options());
    const ProbeReference reference(scene, rays, {.bounces = 3});
    ASSERT_EQ(grid.probes.size(), probes.grid().probes.size());
    EXPECT_GT(grid.count(ProbeState::valid), 100u);
    for (size_t i = 0; i < grid.probes.size(); ++i) {
      const Probe& p = grid.probes[i];
      EXPECT_EQ(probes.grid().probes[i].state, p.state);
      EXPECT_EQ(probes.grid().probes[i].position, p.position);
      ASSERT_EQ(probes.hasLight(i), p.isValid());
      if (!p.isValid()) continue;
      const ProbeSh expected = reference.light(p.position, LiveProbes::kSamples);
      for (size_t c = 0; c < kProbeCoefficients; ++c)
        EXPECT_LT(glm::length(probes.light()[i][c] - expected[c]),
                  1e-4f * glm::length(expected[0]) + 1e-7f);
    }
  }
  ProbeState stateAt(const glm::ivec3& place) const {
    const ProbeGrid& grid = session_.probes().grid();
    return grid.probes[grid.indexOf(place - grid.first)].state;
  }
  // The brightness of the lit balls and marks of others in the overlay.
  struct Shown {
    size_t balls = 0, marks = 0;
    float brightest = 0.0f;
  };
  Shown shown() const {
    Shown out;
    for (const OverlayMesh& mesh : session_.overlay().meshes) {
      EXPECT_EQ(mesh.points.size(), mesh.colours.size());
      for (const uint32_t i : mesh.triangles) EXPECT_LT(i, mesh.points.size());
      if (mesh.points.size() == 4) {
        ++out.marks;
        continue;
      }
      ++out.balls;
      for (const vec4& c : mesh.colours) out.brightest = std::max(out.brightest, c.g);
    }
    return out;
  }
};

TEST_F(LiveProbesTest, AreThoseOfTheReferenceAfterManyFrames) {
  EXPECT_TRUE(session_.probes().settled());
  EXPECT_EQ(session_.probes().text(1.0f), "");
  ASSERT_TRUE(session_.runAction("view.probes"));
  session_.renderFrame();
  EXPECT_FALSE(session_.probes().settled()) << "a frame does a part of the work";
  EXPECT_NE(session_.probes().text(1.0f).find('%'), std::string::npos);
  EXPECT_GT(settle(), 10);
  expectReference();
  EXPECT_EQ(session_.probes().text(1.0f).find('%'), std::string::npos);
}

TEST_F(LiveProbesTest, FollowEdits) {
  session_.runAction("view.probes");
  settle();
  EXPECT_EQ(stateAt({2, 1, 1}), ProbeState::valid);
  const std::vector<ProbeSh> before = session_.probes().light();
  AreaLight light = *node(light_).area;
  light.radiance = vec3(2, 5, 20);
  session_.setAreaLight(light_, light);
  session_.renderFrame();
  EXPECT_FALSE(session_.probes().settled());
  EXPECT_NE(session_.probes().light(), before);
  settle();
  expectReference();

  // A moved box takes the room of some probes and leaves room for others.
  Transform moved = local(box_);
  moved.translation = vec3(2, 1, 1);
  moved.scale = vec3(2);
  session_.setNodeTransform(box_, moved);
  settle();
  expectReference();
  EXPECT_EQ(stateAt({2, 1, 1}), ProbeState::inside);

  // The grid grows with the level.
  const ProbeGrid small = session_.probes().grid();
  moved.translation = vec3(9, 1, 1);
  session_.setNodeTransform(box_, moved);
  settle();
  EXPECT_GT(session_.probes().grid().size.x, small.size.x);
  expectReference();
  session_.undo();
  settle();
  EXPECT_EQ(session_.probes().grid().size, small.size);
  expectReference();
}

TEST_F(LiveProbesTest, AreFoundInAGridOfAnyDistance) {
  session_.runAction("view.probes");
  settle();
  const size_t before = session_.probes().grid().probes.size();
  ASSERT_TRUE(session_.runAction("view.probe_grid 0.8 0.1"));
  settle();
  EXPECT_GT(session_.probes().grid().probes.size(), before);
  EXPECT_EQ(session_.probes().options().padding, 0.1f);
  expectReference();
  ASSERT_TRUE(session_.runAction("view.probe_grid 0.8 0.4"));
  settle();
  expectReference();
  ASSERT_TRUE(session_.runAction("view.probe_grid 0.05"));
  session_.renderFrame();
  EXPECT_LE(session_.probes().grid().probes.size(), size_t{LiveProbes::kMostNodes});
  for (const char* bad : {"view.probe_grid 0", "view.probe_grid nan", "view.probe_grid 1 -1"})
    EXPECT_FALSE(session_.runAction(bad)) << bad;
}

TEST_F(LiveProbesTest, AreTheSameWithAnyNumberOfThreads) {
  std::vector<ProbeSh> light;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    session_.runAction("view.probes");
    for (int i = 0; i < 12; ++i) session_.renderFrame();
    if (threads == 1)
      light = session_.probes().light();
    else
      EXPECT_EQ(session_.probes().light(), light);
    session_.runAction("view.probes");
  }
}

TEST_F(LiveProbesTest, WorkFollowsTheTimeOfFrames) {
  LiveProbes& probes = session_.probes();
  session_.runAction("view.probes");
  const auto known = [&] {
    size_t count = 0;
    for (size_t i = 0; i < probes.light().size(); ++i) count += probes.hasLight(i);
    return count;
  };
  session_.renderFrame();
  const size_t first = known();
  EXPECT_GT(first, 0u);
  EXPECT_LE(first, 128u);
  probes.took(1.0);  // a slow machine: half as much
  session_.renderFrame();
  EXPECT_LE(known() - first, 64u);
  for (int i = 0; i < 3; ++i) probes.took(1e-5);
  const size_t second = known();
  session_.renderFrame();
  EXPECT_GT(known() - second, 128u);
}

TEST_F(LiveProbesTest, AreShownAsBallsWhereNothingHidesThem) {
  EXPECT_EQ(shown().balls, 0u);
  session_.runAction("view.probes");
  settle();
  const Shown lit = shown();
  EXPECT_GT(lit.balls, 30u);
  EXPECT_LT(lit.balls, session_.probes().grid().count(ProbeState::valid));
  EXPECT_GT(lit.brightest, 0.3f);
  RenderSettings render = session_.document().render;
  render.exposureEv -= 8.0f;
  session_.setRender(render);
  EXPECT_LT(shown().brightest, 0.7f * lit.brightest) << "as the picture";
  session_.undo();

  // From below, the floor with its one side hides nothing; a wall before the eye hides all.
  Node wall = node(box_);
  wall.local.translation = vec3(0, 2, 5.2f);
  wall.local.scale = vec3(20, 20, 0.2f);
  session_.setNodeTransform(box_, wall.local);
  settle();
  EXPECT_LT(shown().balls, 6u);
  session_.runAction("view.probes");
  EXPECT_EQ(shown().balls + shown().marks, 0u);
}

// The ball at the pointer has the light between the probes.
TEST_F(LiveProbesTest, ABallAtThePointerIsLit) {
  session_.runAction("view.probes");
  settle();
  const size_t without = shown().balls;
  input_.pointer = pixelOf(vec3(1.7f, 0, 2.4f));
  session_.viewport(input_);
  EXPECT_EQ(shown().balls, without + 1);
  input_.pointer = vec2(3, 3);  // above the floor: nothing is there
  session_.viewport(input_);
  EXPECT_EQ(shown().balls, without);
}

}  // namespace
}  // namespace lamplighter
