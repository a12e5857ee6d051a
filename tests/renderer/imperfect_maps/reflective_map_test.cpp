// Potential light samples, and the choice among them.
#include <cmath>
#include <functional>
#include <set>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/base/random.h"
#include "renderer/imperfect_maps/bidirectional_importance.h"
#include "renderer/imperfect_maps/light_choice.h"
#include "tests/support/render.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// A closed room of one albedo with a lamp and a box.
struct LampRoom {
  static constexpr float kAlbedo = 0.5f;
  Scene scene;
  NodeId lamp = kNoNode, box = kNoNode;

  LampRoom() {
    const int grey = test::addMaterial(scene, vec3(kAlbedo));
    test::addMesh(scene, test::roomMesh(vec3(4.0f, 3.0f, 4.0f), grey));
    box = test::addMesh(scene, test::boxMesh(vec3(0.8f), grey), vec3(0.5f, -1.1f, 0.0f));
    lamp = test::addRectangleLight(scene, vec3(0.0f, 1.4f, 0.0f), vec2(0.1f), vec3(300.0f));
  }
};

// A map that follows a scene.
struct FollowedMap {
  explicit FollowedMap(const Scene& s) : scene(s) {
    update(render, scene, SceneChanges::all());
    rays = std::make_unique<RayCaster>(render);
    follow(test::everythingRebuilt());
  }
  void follow(const RenderSceneChanges& changes) {
    map.update(render, *rays, changes, finder.update(render, changes), options);
  }
  void edit(const std::function<void(Scene&)>& change) {
    const Scene before = scene;
    change(scene);
    const RenderSceneChanges changes = update(render, scene, compare(before, scene));
    rays->update(changes);
    follow(changes);
  }
  Scene scene;
  RenderScene render;
  std::unique_ptr<RayCaster> rays;
  MoverFinder finder;
  ReflectiveMapOptions options{4096, 2, 1};
  ReflectiveMap map;
};

void expectSameMap(const ReflectiveMap& a, const ReflectiveMap& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a.texels().position(i), b.texels().position(i)) << i;
    ASSERT_EQ(a.texels().normal(i), b.texels().normal(i)) << i;
    ASSERT_EQ(a.texels().intensity(i), b.texels().intensity(i)) << i;
    ASSERT_EQ(a.pathOf(i), b.pathOf(i)) << i;
  }
}

double fluxOf(const ReflectiveMap& map, uint32_t bounce) {
  double flux = 0.0;
  for (int column = 0; column < map.columns(); ++column)
    for (int row = 0; row < ReflectiveMap::kRows; ++row)
      if (map.blockOf(column).bounce == bounce)
        flux += static_cast<double>(kPi *
                                    map.texels().intensity(ReflectiveMap::indexOf(column, row)).g);
  return flux;
}

TEST(ReflectiveMap, HasEachPathOnceAtEachBounce) {
  const FollowedMap room{LampRoom().scene};
  std::vector<std::set<uint32_t>> paths(3);
  for (int column = 0; column < room.map.columns(); ++column)
    for (int row = 0; row < ReflectiveMap::kRows; ++row)
      paths[room.map.blockOf(column).bounce].insert(
          room.map.pathOf(ReflectiveMap::indexOf(column, row)));
  EXPECT_EQ(paths[1].size(), room.map.size() / 2);
  EXPECT_EQ(paths[2], paths[1]);
  EXPECT_EQ(*paths[1].rbegin(), room.map.size() / 2 - 1);
}

// In a closed room all flux arrives: the reflected flux is ρΦ, then ρ²Φ. The lamp emits π·L·A.
TEST(ReflectiveMap, HasTheReflectedFlux) {
  const FollowedMap room{LampRoom().scene};
  const double flux = static_cast<double>(kPi) * 3.0;
  EXPECT_NEAR(fluxOf(room.map, 1), 0.5 * flux, 1e-3 * flux);
  EXPECT_NEAR(fluxOf(room.map, 2), 0.25 * flux, 2e-3 * flux);
}

TEST(ReflectiveMap, NeighboursLeaveTheLightAsNeighbours) {
  const FollowedMap room{LampRoom().scene};
  double apart = 0.0, any = 0.0;
  int count = 0;
  for (int column = 0; column < room.map.columns() / 2; ++column) {
    for (int row = 0; row + 1 < ReflectiveMap::kRows; ++row, ++count) {
      const size_t i = ReflectiveMap::indexOf(column, row);
      const size_t far = hash4(static_cast<uint32_t>(i), 0, 0, 1) % (room.map.size() / 2);
      apart += static_cast<double>(
          glm::length(room.map.texels().position(i) - room.map.texels().position(i + 1)));
      any += static_cast<double>(
          glm::length(room.map.texels().position(i) - room.map.texels().position(far)));
    }
  }
  EXPECT_LT(apart / count, 0.5 * any / count);
}

TEST(ReflectiveMap, EditsLeaveTheBitsOfANewMap) {
  const LampRoom room;
  FollowedMap followed(room.scene);
  const auto expectNew = [&] { expectSameMap(followed.map, FollowedMap(followed.scene).map); };
  followed.edit([&](Scene& s) { s.find(room.box)->local.translation.z += 0.4f; });
  EXPECT_GT(followed.map.walked(), 0);
  EXPECT_LT(followed.map.walked(), 1024);
  expectNew();
  followed.edit([&](Scene& s) { s.find(room.lamp)->area->radiance *= vec3(0.5f, 1.0f, 2.0f); });
  EXPECT_EQ(followed.map.walked(), 0);
  expectNew();
  followed.edit([&](Scene& s) { s.find(room.lamp)->local.translation.x += 0.3f; });
  expectNew();
  followed.edit([&](Scene& s) { s.find(room.box)->visible = false; });
  expectNew();
  followed.edit([&](Scene& s) { test::addRectangleLight(s, vec3(1.0f), vec2(0.2f), vec3(9.0f)); });
  expectNew();
}

TEST(ReflectiveMap, DoesNotDependOnThreads) {
  const LampRoom room;
  const FollowedMap all(room.scene);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  expectSameMap(all.map, FollowedMap(room.scene).map);
}

// More lights than columns: the brightest ones represent all.
TEST(ReflectiveMap, KeepsTheFluxOfLightsWithoutColumns) {
  LampRoom room;
  for (int i = 0; i < 40; ++i)
    test::addRectangleLight(room.scene, vec3(0.05f * static_cast<float>(i) - 1.0f, 1.2f, 1.0f),
                            vec2(0.04f), vec3(3.0f));
  FollowedMap followed(room.scene);
  const double flux = static_cast<double>(kPi) * (3.0 + 40 * 0.0016 * 3.0);
  EXPECT_LT(followed.map.blocks().size(), 2u * 41u);
  EXPECT_NEAR(fluxOf(followed.map, 1), 0.5 * flux, 5e-3 * flux);
}

ViewSamples samplesOf(const FollowedMap& room) {
  const View view = test::lookAt(vec3(-1.5f, 0.0f, -1.5f), vec3(1.0f, -1.0f, 1.0f), 64, 48);
  return raySamples(room.render, *room.rays, view, 32);
}

TEST(BidirectionalImportance, IsTheMeanOverViewSamples) {
  const FollowedMap room{LampRoom().scene};
  const ViewSamples samples = samplesOf(room);
  ASSERT_GT(samples.size(), 10u);
  const std::vector<float> importance = bidirectionalImportance(room.map, samples, 0.5f);
  const ReflectiveMap::Texels& t = room.map.texels();
  for (size_t i = 0; i < room.map.size(); i += 37) {
    double sum = 0.0;
    for (size_t k = 0; k < samples.size(); ++k) {
      const vec3 way = vec3(samples.x[k], samples.y[k], samples.z[k]) - t.position(i);
      const float z = glm::dot(way, t.normal(i));
      const float s = -glm::dot(way, vec3(samples.nx[k], samples.ny[k], samples.nz[k]));
      const float d2 = glm::dot(way, way);
      if (z > 0.0f && s > 0.0f) sum += static_cast<double>(z * s / (d2 * std::max(d2, 0.25f)));
    }
    const double expected =
        sum / static_cast<double>(samples.size()) * static_cast<double>(luminance(t.intensity(i)));
    EXPECT_NEAR(importance[i], expected, 1e-4 * expected + 1e-9) << i;
  }
}

// Where samples are drawn is no matter in the mean: near the image of a texel or evenly.
TEST(BidirectionalImportance, GuidedSamplesHaveTheSameMean) {
  const FollowedMap room{LampRoom().scene};
  const View view = test::lookAt(vec3(-1.5f, 0.0f, -1.5f), vec3(1.0f, -1.0f, 1.0f), 64, 48);
  const std::unique_ptr<Backend> backend = makeCpuBackend();
  backend->setScene(room.render, test::everythingRebuilt(), *room.rays);
  backend->renderGBuffer(view, vec2(0.0f));
  const auto sum = [&](bool isGuided) {
    double all = 0.0;
    for (uint32_t seed = 1; seed <= 8; ++seed)
      for (const float b : bidirectionalImportance(room.map, backend->hostGBuffer(), view,
                                                   {.count = 16, .guided = isGuided, .seed = seed}))
        all += static_cast<double>(b);
    return all;
  };
  const double even = sum(false);
  EXPECT_GT(even, 0.0);
  EXPECT_NEAR(sum(true), even, 0.03 * even);
}

// The mean over seeds of the light of the chosen samples is that of all.
TEST(LightChoice, IsUnbiased) {
  const FollowedMap room{LampRoom().scene};
  const std::vector<float> importance = bidirectionalImportance(room.map, samplesOf(room), 0.5f);
  const vec3 place(0.3f, -1.4f, 1.0f);
  const auto lightAt = [&](const vec3& from, const vec3& normal, const vec3& intensity) {
    const vec3 way = place - from;
    const float z = glm::dot(way, normal), s = way.y < 0.0f ? -way.y : 0.0f;
    const float d2 = glm::dot(way, way);
    return z > 0.0f ? static_cast<double>(intensity.g * z * s / (d2 * std::max(d2, 0.25f))) : 0.0;
  };
  double all = 0.0;
  for (size_t i = 0; i < room.map.size(); ++i)
    all += lightAt(room.map.texels().position(i), room.map.texels().normal(i),
                   room.map.texels().intensity(i));
  for (const float defence : {0.0f, 0.1f, 1.0f}) {
    constexpr int kSeeds = 64;
    double sum = 0.0, squares = 0.0;
    for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
      double light = 0.0;
      for (const SceneVpl& v :
           chooseLights(room.map, importance, {.count = 64, .defence = defence, .seed = seed})
               .lights)
        light += lightAt(vec3(v.vpl.position), vec3(v.vpl.normal), v.vpl.intensity);
      sum += light;
      squares += light * light;
    }
    const double mean = sum / kSeeds;
    const double error = std::sqrt(std::max(squares / kSeeds - mean * mean, 0.0) / kSeeds);
    EXPECT_NEAR(mean, all, 3.0 * error + 1e-3 * all) << defence;
  }
}

// Samples that move between texels keep their light.
TEST(LightChoice, SamplesBetweenTexelsAreNearThem) {
  const FollowedMap room{LampRoom().scene};
  const std::vector<float> importance = bidirectionalImportance(room.map, samplesOf(room), 0.5f);
  const View view = test::lookAt(vec3(-1.5f, 0.0f, -1.5f), vec3(1.0f, -1.0f, 1.0f), 64, 48);
  LightChoiceOptions options{.count = 128};
  const ChosenLights at = chooseLights(room.map, importance, options);
  options.between = &view;
  const ChosenLights between = chooseLights(room.map, importance, options);
  int moved = 0;
  for (size_t i = 0; i < at.lights.size(); ++i) {
    const shared::Vpl &a = at.lights[i].vpl, &b = between.lights[i].vpl;
    EXPECT_EQ(a.intensity, b.intensity);
    EXPECT_LT(glm::length(vec3(a.position) - vec3(b.position)), 1.5f);
    EXPECT_NEAR(glm::length(vec3(b.normal)), 1.0f, 1e-5f);
    moved += a.position != b.position;
  }
  EXPECT_GT(moved, 20);
}

TEST(LightChoice, BoundsTheLightOfASample) {
  const FollowedMap room{LampRoom().scene};
  const std::vector<float> importance = bidirectionalImportance(room.map, samplesOf(room), 0.5f);
  const auto lights = chooseLights(room.map, importance, {.count = 128}).lights;
  const auto bounded = boundedLights(lights, 0.5f, 0.02f);
  int farther = 0;
  for (size_t i = 0; i < bounded.size(); ++i) {
    const float d = bounded[i].clampDistance;
    EXPECT_GE(d, 0.5f);
    EXPECT_LE(luminance(bounded[i].vpl.intensity) / (d * d), 0.02001f);
    farther += d > 0.5f;
  }
  EXPECT_GT(farther, 0);
  EXPECT_EQ(boundedLights(lights, 0.5f, 0.0f)[3].clampDistance, 0.5f);
}

}  // namespace
}  // namespace lamplighter
