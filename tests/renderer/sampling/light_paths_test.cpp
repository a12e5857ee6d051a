// Light paths that are kept between edits. When settled they equal new paths. During edits as many
// as possible are kept, with the correct distribution.
#include "renderer/sampling/light_paths.h"

#include <functional>
#include <map>
#include <memory>

#include <gtest/gtest.h>

#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// A room with a box and a light below the ceiling. Edits are applied as in a frame.
class Stage {
 public:
  Stage() {
    const int grey = test::addMaterial(scene, vec3(0.6f)), red = test::addMaterial(scene, kRed);
    test::addMesh(scene, test::roomMesh(vec3(6, 4, 5), grey), vec3(0, 2, 0));
    box = test::addMesh(scene, test::boxMesh(vec3(0.8f), red), vec3(1.0f, 0.4f, 0.3f));
    light = test::addRectangleLight(scene, vec3(-0.5f, 3.5f, 0), vec2(1, 0.8f), vec3(8, 7, 5));
  }

  // Updates the paths to the current scene.
  void frame(LightPaths& paths, const VplCounts& counts, int mostPaths = 0) {
    SceneChanges changes = isNew_ ? SceneChanges::all() : compare(before_, scene);
    isNew_ = false;
    const RenderSceneChanges done = lamplighter::update(render, scene, changes);
    if (!rays) rays = std::make_unique<RayCaster>(render);
    rays->update(done);
    std::vector<MoverFinder::Mover> movers;
    if (!done.none()) movers = movers_.update(render, done);
    paths.update(render, *rays, done, movers, counts, mostPaths);
    before_ = scene;
  }
  std::vector<SceneVpl> fresh(const VplCounts& counts) const {
    return LightPaths::generate(render, *rays, LightSet(render), counts).vpls;
  }

  static constexpr vec3 kRed{0.8f, 0.1f, 0.1f};
  Scene scene;
  NodeId box, light;
  RenderScene render;
  std::unique_ptr<RayCaster> rays;

 private:
  bool isNew_ = true;
  Scene before_;
  MoverFinder movers_;
};

void expectSame(const std::vector<SceneVpl>& a, const std::vector<SceneVpl>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].id, b[i].id);
    EXPECT_EQ(a[i].vpl.position, b[i].vpl.position);
    EXPECT_EQ(a[i].vpl.normal, b[i].vpl.normal);
    EXPECT_EQ(a[i].vpl.intensity, b[i].vpl.intensity);
  }
}

vec3 indirectSum(const std::vector<SceneVpl>& vpls) {
  vec3 sum(0.0f);
  for (const SceneVpl& v : vpls)
    if (v.id.bounce > 0) sum += v.vpl.intensity;
  return sum;
}

// For any edits, and for any number of paths per frame.
TEST(LightPaths, SettledOnesEqualNewOnes) {
  for (const int mostPaths : {0, 3}) {
    SCOPED_TRACE(mostPaths);
    Stage stage;
    const NodeId spot = test::addNode(stage.scene, "spot", kNoNode, vec3(2, 3, 1));
    stage.scene.find(spot)->punctual = PunctualLight{PunctualKind::spot, vec3(9), 0.0f, 0.2f, 0.7f};
    stage.scene.find(spot)->local.rotation = glm::angleAxis(-1.2f, vec3(1, 0, 0));
    stage.scene.sky = vec3(0.1f);
    LightPaths paths;
    const VplCounts counts{200, 0.3f, 3, 1};
    stage.frame(paths, counts, mostPaths);
    EXPECT_TRUE(paths.isAtRest());
    expectSame(paths.set(stage.render).vpls, stage.fresh(counts));
    const std::vector<std::function<void(Scene&)>> edits{
        [&](Scene& s) { s.find(stage.light)->local.translation += vec3(0.1f, -0.2f, 0.05f); },
        [&](Scene& s) { s.find(stage.box)->local.translation.x -= 0.4f; },
        [&](Scene& s) { s.materials[0].baseColor = vec4(0.3f, 0.6f, 0.0f, 1.0f); },
        [&](Scene& s) { s.find(stage.light)->area->radiance = vec3(1, 2, 0); },
        [&](Scene& s) {
          s.find(stage.light)->local.rotation = glm::angleAxis(0.3f, vec3(0, 0, 1));
        },
        [&](Scene& s) { s.find(spot)->local.translation += vec3(-0.3f, 0, 0); },
        [&](Scene& s) { s.find(spot)->punctual->outerCone = 0.5f; },
        [&](Scene& s) { s.materials[0].baseColor = vec4(0.0f, 0.0f, 0.0f, 1.0f); },
        [&](Scene& s) { s.materials[0].baseColor = vec4(0.6f, 0.6f, 0.6f, 1.0f); },
        [&](Scene& s) { s.find(stage.box)->visible = false; },
        [&](Scene& s) { s.find(stage.light)->local.translation.x -= 0.1f; },
        [&](Scene& s) { s.find(stage.box)->local.translation.y += 9.0f; },
        [&](Scene& s) { s.find(stage.box)->visible = true; },
        [&](Scene& s) { s.find(stage.box)->local.translation.y -= 8.7f; },
    };
    for (size_t i = 0; i < edits.size(); ++i) {
      edits[i](stage.scene);
      stage.frame(paths, counts, mostPaths);
      if (i % 3 == 0) continue;  // the next edit follows before the paths are settled
      int frames = 0;
      for (; !paths.isAtRest() && frames < 1000; ++frames) {
        stage.frame(paths, counts, mostPaths);
      }
      ASSERT_TRUE(paths.isAtRest());
      SCOPED_TRACE(i);
      expectSame(paths.set(stage.render).vpls, stage.fresh(counts));
    }
  }
}

TEST(LightPaths, ASmallMoveKeepsMostPaths) {
  Stage stage;
  LightPaths paths;
  const VplCounts counts{300, 0.5f, 2, 1};
  stage.frame(paths, counts);
  const int count = paths.set(stage.render).paths;
  vec3 last = indirectSum(paths.set(stage.render).vpls);
  uint64_t traced = 0;
  for (int step = 0; step < 40; ++step) {
    stage.scene.find(stage.light)->local.translation += vec3(step < 20 ? 0.05f : -0.05f, 0, 0.02f);
    stage.frame(paths, counts);
    EXPECT_GT(paths.work().kept, 9 * count / 10);
    const VplSet set = paths.set(stage.render);
    EXPECT_EQ(set.paths, count);
    const vec3 sum = indirectSum(set.vpls);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum[i] / last[i], 1.0f, 0.03f) << step;
    last = sum;
    traced += paths.work().rays;
  }
  // Not many more rays than for tracing all paths again.
  EXPECT_LT(traced, static_cast<uint64_t>(40 * 5 * count));
  // After the drag, the paths become those of a new start, some of them in each frame.
  int frames = 0;
  for (; !paths.isAtRest() && frames < 100; ++frames) {
    stage.frame(paths, counts);
    EXPECT_LE(paths.work().replaced, (count + 8) / 8);
  }
  EXPECT_LE(frames, 9);
  expectSame(paths.set(stage.render).vpls, stage.fresh(counts));
}

// If a light is turned around, no path is kept, and all paths are replaced at once.
TEST(LightPaths, ALargeMoveReplacesAllPaths) {
  Stage stage;
  LightPaths paths;
  const VplCounts counts{300, 0.5f, 2, 1};
  stage.frame(paths, counts);
  Transform& place = stage.scene.find(stage.light)->local;
  place.translation.y = 0.3f;
  place.rotation = place.rotation * glm::angleAxis(kPi, vec3(1, 0, 0));
  stage.frame(paths, counts);
  EXPECT_EQ(paths.work().kept, 0);
  while (!paths.isAtRest()) {
    stage.frame(paths, counts);
    EXPECT_EQ(paths.work().replaced, 0);
  }
  expectSame(paths.set(stage.render).vpls, stage.fresh(counts));
}

// Unshadowed irradiance-like sums of the indirect VPLs at some points, and two sums over all of
// them.
std::vector<double> lightAt(const std::vector<SceneVpl>& vpls) {
  const vec3 places[] = {
      {-2.5f, 0.5f, -2}, {2.5f, 1, 2}, {0, 2, 0}, {1.0f, 3.5f, 0.3f}, {2, 0.2f, 0}};
  std::vector<double> sums(std::size(places) + 2, 0.0);
  for (const SceneVpl& v : vpls) {
    if (v.id.bounce == 0) continue;
    for (size_t i = 0; i < std::size(places); ++i) {
      const vec3 to = places[i] - vec3(v.vpl.position);
      const float d2 = std::max(glm::dot(to, to), 1.0f);
      sums[i] += v.vpl.intensity.g * std::max(0.0f, glm::dot(to, vec3(v.vpl.normal))) / d2;
    }
    sums[std::size(places)] += v.vpl.intensity.r;
    sums[std::size(places) + 1] += v.vpl.position.x > 0.0f ? v.vpl.intensity.g : 0.0f;
  }
  return sums;
}

// The mean over many seeds. Paths that followed a light over a long distance, in small and large
// steps, past a box and with rotations, have the same mean as new paths.
TEST(LightPaths, MovedPathsHaveTheDistributionOfNewOnes) {
  for (const bool isPunctual : {false, true}) {
    SCOPED_TRACE(isPunctual);
    std::vector<double> followed(7, 0.0), fresh(7, 0.0), squares(7, 0.0);
    Stage stage;
    if (isPunctual) {
      Node& node = *stage.scene.find(stage.light);
      node.area.reset();
      node.punctual = PunctualLight{PunctualKind::spot, vec3(9), 0.0f, 0.3f, 1.2f};
    }
    stage.scene.find(stage.box)->local.translation.y = 1.6f;  // between the light and the floor
    const Scene start = stage.scene;
    constexpr int kSeeds = 700;
    for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
      const VplCounts counts{120, 0.0f, 2, seed};
      LightPaths paths;
      stage.scene = start;
      stage.frame(paths, counts);
      for (int step = 0; step < 12; ++step) {
        Transform& place = stage.scene.find(stage.light)->local;
        place.translation += step % 3 == 0 ? vec3(0.4f, -0.15f, 0.1f) : vec3(0.06f, -0.02f, 0.01f);
        if (step % 4 == 1)
          place.rotation = place.rotation * glm::angleAxis(0.08f, vec3(0, 0.6f, 0.8f));
        stage.frame(paths, counts);
      }
      const std::vector<double> a = lightAt(paths.set(stage.render).vpls);
      const std::vector<double> b = lightAt(stage.fresh(counts));
      for (size_t i = 0; i < a.size(); ++i) {
        followed[i] += a[i];
        fresh[i] += b[i];
        squares[i] += (a[i] - b[i]) * (a[i] - b[i]);
      }
    }
    for (size_t i = 0; i < followed.size(); ++i) {
      const double difference = followed[i] / fresh[i] - 1.0;
      const double standardError = std::sqrt(squares[i]) / fresh[i];  // one standard error
      EXPECT_LT(standardError, 0.008) << i;
      EXPECT_LT(std::abs(difference), 3.0 * standardError) << i;
      EXPECT_LT(std::abs(difference), 0.015) << i;
    }
  }
}

// A red box moves near a wall: only the paths that it affects change.
TEST(LightPaths, AColouredMoverChangesOnlyThePathsThatItAffects) {
  Stage stage;
  LightPaths paths;
  const VplCounts counts{400, 0.2f, 3, 1};
  stage.frame(paths, counts);
  const VplSet before = paths.set(stage.render);
  const auto redness = [](const std::vector<SceneVpl>& vpls) {
    const vec3 sum = indirectSum(vpls);
    return sum.r / sum.b;
  };
  stage.scene.find(stage.box)->local.translation = vec3(-0.5f, 2.0f, 0.0f);  // below the light
  stage.frame(paths, counts);
  const LightPaths::Work work = paths.work();
  const VplSet after = paths.set(stage.render);
  EXPECT_GT(work.replaced, 10);
  EXPECT_GT(work.kept, before.paths / 4);
  EXPECT_EQ(work.pending, 0);
  EXPECT_GT(redness(after.vpls), 1.1f * redness(before.vpls));
  // All paths equal new ones.
  std::map<VplId, vec3> fresh;
  for (const SceneVpl& v : stage.fresh(counts)) fresh[v.id] = vec3(v.vpl.position);
  size_t found = 0;
  for (const SceneVpl& v : after.vpls) {
    const auto it = fresh.find(v.id);
    if (it == fresh.end()) continue;
    ++found;
    EXPECT_EQ(it->second, vec3(v.vpl.position));
  }
  EXPECT_GT(found, 300u);

  // In a corner the box affects few paths.
  stage.scene.find(stage.box)->local.translation = vec3(1.0f, 0.4f, 0.3f);
  stage.frame(paths, counts);
  while (!paths.isAtRest()) stage.frame(paths, counts);
  expectSame(paths.set(stage.render).vpls, before.vpls);
  stage.scene.find(stage.box)->local.translation.x += 0.02f;
  stage.frame(paths, counts);
  EXPECT_LT(paths.work().replaced, before.paths / 3);
  EXPECT_LT(paths.work().walked, before.paths / 2);
}

// Changes of colour need no ray, and no VPL moves.
TEST(LightPaths, ChangedColoursKeepTheVertices) {
  Stage stage;
  LightPaths paths;
  const VplCounts counts{200, 0.5f, 2, 1};
  stage.frame(paths, counts);
  const auto before = paths.set(stage.render).vpls;
  stage.scene.materials[0].baseColor = vec4(0.3f, 0.5f, 0.6f, 1.0f);
  stage.scene.find(stage.light)->area->radiance = vec3(4, 4, 9);
  stage.frame(paths, counts);
  EXPECT_EQ(paths.work().rays, 0u);
  EXPECT_TRUE(paths.isAtRest());
  const auto after = paths.set(stage.render).vpls;
  expectSame(after, stage.fresh(counts));
  ASSERT_EQ(after.size(), before.size());
  for (size_t i = 0; i < after.size(); ++i)
    EXPECT_EQ(after[i].vpl.position, before[i].vpl.position);
}

// With a few paths per frame, all paths are updated in turn during a drag, and all are checked
// before the result is settled.
TEST(LightPaths, LimitedUpdatesReachAllPathsAndKeepTheFlux) {
  Stage stage;
  LightPaths paths;
  const VplCounts counts{300, 0.0f, 2, 1};
  stage.frame(paths, counts, 10);
  vec3 last = indirectSum(paths.set(stage.render).vpls);
  for (int step = 0; step < 30; ++step) {
    stage.scene.find(stage.light)->local.translation.x += 0.05f;
    stage.frame(paths, counts, 10);
    EXPECT_EQ(paths.work().walked, 10);
    EXPECT_GT(paths.work().pending, 0);
    const vec3 sum = indirectSum(paths.set(stage.render).vpls);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum[i] / last[i], 1.0f, 0.02f) << step;
    last = sum;
  }
  int frames = 0;
  for (; !paths.isAtRest() && frames < 100; ++frames) stage.frame(paths, counts, 10);
  EXPECT_GT(frames, 10);
  EXPECT_LT(frames, 30);
  expectSame(paths.set(stage.render).vpls, stage.fresh(counts));
}

}  // namespace
}  // namespace lamplighter
