// Light maps against the definition of a light's irradiance, and incremental updates against new
// light maps.
#include "renderer/light_maps/light_maps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "renderer/light_maps/accumulate.h"
#include "shaders/shared/vpl_shading.h"
#include "tests/support/edit_sequence.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/random_boxes.h"
#include "tests/support/scenes/room_lights.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

constexpr float kClamp = 0.5f;
constexpr LightMaps::Options kOptions{0.1f, kClamp};

// A scene with its visibility database and light maps, updated incrementally.
struct Kept {
  RenderScene scene;
  VisibilityDatabase visibility;
  LightMaps maps;
  std::vector<shared::Vpl> lights;

  // Without `refreshes`, columns of lights that did not move stay pending.
  void update(const Scene& from, const SceneChanges& changes, bool refreshes = true) {
    const RenderSceneChanges found = lamplighter::update(scene, from, changes);
    visibility.setScene(scene, found);
    lights = test::lightsOf(scene, {40, 0.5f, 1, 1});
    visibility.setLights(scene, lights);
    if (refreshes) visibility.refreshAll(scene);
    maps.update(scene, visibility, lights, kOptions);
    visibility.clearChanged();
  }
};

Scene litBoxes() {
  Scene scene = test::randomBoxes(14, 5);
  test::addRectangleLight(scene, vec3(0.3f, 3.9f, -0.2f), vec2(1.5f, 0.7f), vec3(12, 9, 5));
  // Curved surfaces have no chart.
  const NodeId ball = test::addRectangleLight(scene, vec3(-1, 2, 1), vec2(0.6f), vec3(3));
  scene.find(ball)->area->shape = AreaShape::sphere;
  return scene;
}

// Points on a line in the plane y = `height`.
struct Line {
  std::vector<float> u, w;
  float height;
  Line(size_t count, float y) : u(count), w(count), height(y) {}
  vec3 at(size_t i) const { return {w[i], height, u[i]}; }
  TexelPlaces places() const {
    const auto ends = [](const std::vector<float>& v) {
      const auto [least, most] = std::minmax_element(v.begin(), v.end());
      return vec2(*least, *most);
    };
    const vec2 ofU = ends(u), ofW = ends(w);
    return {vec3(0, height, 0),
            vec3(0, 0, 1),
            vec3(1, 0, 0),
            vec3(0, 1, 0),
            {ofU.x, ofW.x},
            {ofU.y, ofW.y},
            u,
            w};
  }
};
Line lineOf64() {
  Line line(64, 0.1f);
  for (size_t i = 0; i < 64; ++i) {
    line.u[i] = -0.4f;
    line.w[i] = -3.0f + 0.1f * static_cast<float>(i);
  }
  return line;
}

TEST(Accumulate, EqualsTheSharedDefinitionUpToRounding) {
  std::vector<shared::Vpl> vpls = test::randomVpls(20, 3);
  shared::Vpl sun = test::makeVpl(vec3(0), vec3(0.5f, 1, 0.4f), shared::kVplDirectional, 2.0f);
  sun.normal.w = 5.0f;
  sun.tangent.w = 1.7f;
  vpls.push_back(sun);
  vpls.push_back(test::makeVpl(vec3(1, 3, 1), vec3(0, -1, 0), shared::kVplUniform));
  vpls.back().normal.w = 0.0f;
  vpls.back().tangent.w = 1.0f;
  constexpr size_t kCount = 40;
  Line line(kCount, 0.3f);
  for (size_t i = 0; i < kCount; ++i) {
    line.w[i] = -3.0f + 0.15f * static_cast<float>(i);
    line.u[i] = 1.0f - 0.05f * static_cast<float>(i);
  }
  const vec3 normal(0, 1, 0);
  int lit = 0;
  for (const shared::Vpl& vpl : vpls) {
    std::vector<double> r(kCount), g(kCount), b(kCount);
    const SummedLight light(vpl, 1.0f);
    std::vector lights{&light};
    accumulate(lights, line.places(), kClamp, r.data(), g.data(), b.data());
    for (size_t i = 0; i < kCount; ++i) {
      const float e = shared::vplGeometry(vpl, line.at(i), normal, normal, kClamp);
      EXPECT_NEAR(g[i], e * vpl.intensity.g, 1e-5 * e * vpl.intensity.g + kIrradianceUnit);
      EXPECT_EQ(std::remainder(r[i], kIrradianceUnit), 0.0);
      lit += e > 0.0f;
    }
  }
  EXPECT_GT(lit, 100);
}

// Subtracting lights in any order restores exactly zero.
TEST(Accumulate, SubtractingRestoresExactlyZero) {
  const std::vector<shared::Vpl> vpls = test::randomVpls(50, 9);
  const Line line = lineOf64();
  std::vector<double> r(64), g(64), b(64);
  const TexelPlaces places = line.places();
  std::vector<SummedLight> lights;
  std::vector<const SummedLight*> added, subtracted;
  for (const float sign : {1.0f, -1.0f})
    for (const shared::Vpl& vpl : vpls) lights.emplace_back(vpl, sign);
  for (size_t i = 0; i < vpls.size(); ++i) {
    added.push_back(&lights[i]);
    subtracted.insert(subtracted.begin(), &lights[vpls.size() + i]);
  }
  accumulate(added, places, kClamp, r.data(), g.data(), b.data());
  EXPECT_GT(*std::max_element(r.begin(), r.end()), 0.0);
  accumulate(subtracted, places, kClamp, r.data(), g.data(), b.data());
  for (const auto* sums : {&r, &g, &b})
    EXPECT_TRUE(std::all_of(sums->begin(), sums->end(), [](double s) { return s == 0.0; }));
}

// Faint lights are summed in 32 bits in several runs, bright ones in double precision. The result
// has the same bits as adding the lights one by one.
TEST(Accumulate, TogetherHasTheSameBitsAsOneByOne) {
  std::vector<shared::Vpl> vpls = test::randomVpls(200, 4);
  for (size_t i = 0; i < vpls.size(); ++i) {
    const float scale = i % 7 == 0 ? 5000.0f : i % 3 == 0 ? 40.0f : 0.3f;
    vpls[i].intensity = scale * vpls[i].intensity;
  }
  const Line line = lineOf64();
  const TexelPlaces places = line.places();
  using Sums = std::array<std::vector<double>, 3>;
  const std::vector<double> zero(64);
  Sums together{zero, zero, zero}, alone = together;
  std::vector<SummedLight> lights;
  std::vector<const SummedLight*> all;
  for (const shared::Vpl& vpl : vpls) lights.emplace_back(vpl, 1.0f);
  for (const SummedLight& light : lights) all.push_back(&light);
  const auto add = [&](std::span<const SummedLight* const> some, Sums& to) {
    accumulate(some, places, kClamp, to[0].data(), to[1].data(), to[2].data());
  };
  add(all, together);
  EXPECT_GT(*std::max_element(together[0].begin(), together[0].end()), 32.0);
  for (const SummedLight& light : lights) {
    std::vector one{&light};
    add(one, alone);
  }
  EXPECT_EQ(together, alone);
}

// At each corner of a tile, the map holds the sum of its lights. The irradiance is continuous
// within a tile and between tiles with the same lights.
TEST(LightMaps, StoreTheSumOfTheirLights) {
  Kept kept;
  kept.update(litBoxes(), SceneChanges::all());
  int tiles = 0, heldLights = 0;
  for (uint32_t object = 0; object < kept.scene.objects.size(); ++object) {
    const ObjectPatches& patches = kept.visibility.patches(object);
    for (size_t p = 0; p < patches.patches.size(); ++p) {
      const Patch& patch = patches.patches[p];
      if (!patch.isLeaf()) continue;
      const int leaf = static_cast<int>(p);
      const LightMapTile* tile = kept.maps.tile(object, leaf);
      if (tile == nullptr) continue;
      ++tiles;
      const Chart& chart = patches.charts[static_cast<size_t>(patch.chart)];
      const auto held = kept.maps.held(object, leaf);
      for (const vec2& share : {vec2(0, 0), vec2(1, 0), vec2(1, 1)}) {
        const vec3 at = chart.at(glm::mix(patch.min, patch.max, share));
        vec3 e(0.0f);
        for (size_t slot = 0; slot < kept.lights.size(); ++slot) {
          if (!held[slot]) continue;
          EXPECT_NE(kept.visibility.state(object, leaf, static_cast<int>(slot)), Occlusion::full);
          ++heldLights;
          e += shared::vplGeometry(kept.lights[slot], at, chart.normal, chart.normal, kClamp) *
               kept.lights[slot].intensity;
        }
        const vec3 found = kept.maps.irradiance(patches, object, leaf, at);
        EXPECT_LT(glm::length(found - e), 1e-4f * glm::length(e) + 1e-5f);
      }
    }
  }
  EXPECT_GT(tiles, 60);
  EXPECT_GT(heldLights, 20 * tiles);
}

// Also outside the borders of a tile, where look-ups are clamped.
TEST(LightMaps, EightPointsAreReadAsOneByOne) {
  Kept kept;
  kept.update(litBoxes(), SceneChanges::all());
  constexpr size_t kPoints = LightMaps::Sampler::kPoints;
  int lit = 0;
  for (uint32_t object = 0; object < kept.scene.objects.size(); ++object) {
    const ObjectPatches& patches = kept.visibility.patches(object);
    for (size_t p = 0; p < patches.patches.size(); ++p) {
      const Patch& patch = patches.patches[p];
      const int leaf = static_cast<int>(p);
      if (!patch.isLeaf() || kept.maps.tile(object, leaf) == nullptr) continue;
      const Chart& chart = patches.charts[static_cast<size_t>(patch.chart)];
      std::array<float, kPoints> x, y, z;
      for (size_t i = 0; i < kPoints; ++i) {
        const float share = 0.2f * static_cast<float>(i) - 0.2f;
        const vec3 at = chart.at(glm::mix(patch.min, patch.max, vec2(share, 0.9f - share)));
        x[i] = at.x, y[i] = at.y, z[i] = at.z;
      }
      std::array<vec4, kPoints> e;
      const LightMaps::Sampler map(kept.maps, patches, object, leaf);
      map.irradiance(x.data(), y.data(), z.data(), e);
      for (size_t i = 0; i < kPoints; ++i) {
        EXPECT_EQ(vec3(e[i]), map.irradiance(vec3(x[i], y[i], z[i])));
        lit += e[i].g > 0.0f;
      }
    }
  }
  EXPECT_GT(lit, 300);
}

TEST(LightMaps, TheSameBitsAtAnyNumberOfThreads) {
  std::vector<uint64_t> hashes;
  for (const size_t threads : {1u, 2u, 5u}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Kept kept;
    kept.update(litBoxes(), SceneChanges::all());
    hashes.push_back(kept.maps.hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

std::vector<uint32_t> objectsWithPatches(const VisibilityDatabase& visibility) {
  std::vector<uint32_t> objects;
  for (uint32_t i = 0; i < visibility.objects(); ++i)
    if (!visibility.patches(i).patches.empty()) objects.push_back(i);
  return objects;
}

// Deleted objects have no patches.
bool sameStates(const VisibilityDatabase& a, const VisibilityDatabase& b) {
  const std::vector<uint32_t> ofA = objectsWithPatches(a), ofB = objectsWithPatches(b);
  if (ofA.size() != ofB.size()) return false;
  for (size_t i = 0; i < ofA.size(); ++i) {
    const uint32_t x = ofA[i], y = ofB[i];
    if (a.patches(x).patches.size() != b.patches(y).patches.size()) return false;
    for (size_t p = 0; p < a.patches(x).patches.size(); ++p) {
      const auto ra = a.row(x, static_cast<int>(p)), rb = b.row(y, static_cast<int>(p));
      if (!std::equal(ra.begin(), ra.end(), rb.begin(), rb.end())) return false;
    }
  }
  return true;
}

// After any edits, visibility and light maps equal new ones bit for bit. After all edits are
// undone, they equal the initial ones.
bool equalsFreshAfterEdits(const test::EditSequence& edits) {
  Scene scene = litBoxes();
  Kept kept;
  kept.update(scene, SceneChanges::all());
  const uint64_t begin = kept.maps.hash();
  std::vector<Scene> past{scene};
  for (size_t i = 0; i < edits.size(); ++i) {
    apply(scene, edits[i]);
    if (i + 1 < edits.size() && edits[i + 1].together) continue;
    const bool waits = edits[i].node % 3 == 0 && i + 1 < edits.size();
    kept.update(scene, compare(past.back(), scene), !waits);
    past.push_back(scene);
    if (waits) continue;
    Kept fresh;
    fresh.update(scene, SceneChanges::all());
    if (!sameStates(kept.visibility, fresh.visibility)) return false;
    if (kept.maps.hash() != fresh.maps.hash()) return false;
  }
  for (; past.size() > 1; past.pop_back())
    kept.update(past[past.size() - 2], compare(past.back(), past[past.size() - 2]));
  return kept.maps.hash() == begin;
}

class AnyEdits : public testing::TestWithParam<uint32_t> {};

TEST_P(AnyEdits, GiveTheVisibilityAndLightMapsOfAFreshStart) {
  EXPECT_EQ(test::shortestFailing(test::randomEdits(14, GetParam()), equalsFreshAfterEdits),
            test::EditSequence());
  EXPECT_EQ(
      test::shortestFailing(test::randomStructureEdits(10, GetParam()), equalsFreshAfterEdits),
      test::EditSequence());
}
INSTANTIATE_TEST_SUITE_P(Seeds, AnyEdits, testing::Range(1u, 13u));

// The search finds the single edit that causes the failure.
TEST(EditSequence, IsShortenedToTheFailingEdit) {
  test::EditSequence edits = test::randomEdits(20, 4);
  edits[13].kind = test::Edit::Kind::mirror;
  edits[13].node = 77;
  const auto failing = test::shortestFailing(edits, [](const test::EditSequence& s) {
    return std::none_of(s.begin(), s.end(), [](const test::Edit& e) { return e.node == 77; });
  });
  ASSERT_EQ(failing.size(), 1u);
  EXPECT_EQ(failing[0].node, 77u);
}

}  // namespace
}  // namespace lamplighter
