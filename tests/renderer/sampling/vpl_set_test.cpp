#include "renderer/sampling/vpl_set.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

#include "renderer/sampling/sun_shadow_tiles.h"
#include "renderer/sampling/vpl_counts.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"
#include "tests/support/scenes/skies.h"

namespace lamplighter {
namespace {

constexpr NodeId kSky = kNoNode;

std::vector<SceneVpl> vplsOf(const Scene& scene, const VplCounts& counts) {
  const test::LitScene lit(scene);
  return generateVpls(lit.render, *lit.rays, LightSet(lit.render), counts).vpls;
}

// Sum of intensities by light and bounce.
std::map<std::pair<NodeId, uint32_t>, vec3> sums(const std::vector<SceneVpl>& vpls) {
  std::map<std::pair<NodeId, uint32_t>, vec3> result;
  for (const SceneVpl& v : vpls) result[{v.id.light, v.id.bounce}] += v.vpl.intensity;
  return result;
}

void expectNear(const vec3& actual, const vec3& expected, float relative = 1e-4f) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], relative * expected[i]) << i;
}

Scene room(const vec3& albedo) {  // closed: no path escapes
  Scene scene;
  const int material = test::addMaterial(scene, albedo);
  test::addMesh(scene, test::roomMesh(vec3(6, 4, 5), material));
  return scene;
}

TEST(ShareSamples, GivesEachLightItsMinimumThenUsesLargestRemainders) {
  const std::vector<SampleShare> shares{{6, 1, false}, {3, 1, false}, {1, 1, false}, {0, 1, false}};
  EXPECT_EQ(shareSamples(shares, 13).counts, (std::vector<int>{7, 4, 2, 0}));
  EXPECT_EQ(shareSamples(shares, 3).counts, (std::vector<int>{1, 1, 1, 0}));
  const std::vector<SampleShare> fixed{{6, 2, true}, {3, 1, false}};
  EXPECT_EQ(shareSamples(fixed, 10).counts, (std::vector<int>{2, 8}));
  EXPECT_FLOAT_EQ(shareSamples(fixed, 10).scale, 1.0f);
}

TEST(ShareSamples, PrefersTheBrightestIfThereAreTooFew) {
  const std::vector<SampleShare> shares{{2, 1, false}, {5, 1, false}, {3, 1, false}};
  const SampleCounts two = shareSamples(shares, 2);
  EXPECT_EQ(two.counts, (std::vector<int>{0, 1, 1}));
  EXPECT_FLOAT_EQ(two.scale, 10.0f / 8.0f);
  EXPECT_EQ(shareSamples(std::vector<SampleShare>{{1, 2, true}}, 1).counts, std::vector<int>{2});
  EXPECT_EQ(shareSamples(shares, 0).counts, (std::vector<int>{0, 0, 0}));
}

// Σ I = Le·A (Φ/π) for any number of samples, and the number of samples is as requested.
TEST(VplSet, DirectIntensitiesAddUpToTheFlux) {
  Scene scene = room(vec3(0.5f));
  const NodeId a = test::addRectangleLight(scene, vec3(0, 1.9f, 0), vec2(2, 0.5f), vec3(4, 2, 1));
  const NodeId b = test::addRectangleLight(scene, vec3(1, 1, 0), vec2(0.3f, 0.3f), vec3(9));
  for (const int total : {2, 7, 150, 1000}) {
    const auto vpls = vplsOf(scene, {total, 0.5f, 0, 1});
    EXPECT_EQ(vpls.size(), static_cast<size_t>(total));
    const auto sum = sums(vpls);
    expectNear(sum.at({a, 0}), vec3(4, 2, 1));
    expectNear(sum.at({b, 0}), vec3(0.81f));
    for (const SceneVpl& v : vpls) EXPECT_LT(v.vpl.normal.y, -0.999f);
  }
}

// If there are fewer samples than lights, the sum is still the whole flux.
TEST(VplSet, TooFewSamplesKeepTheFlux) {
  Scene scene = room(vec3(0.5f));
  for (int i = 1; i <= 5; ++i) {
    test::addRectangleLight(scene, vec3(0, 1.9f, 0), vec2(0.1f * static_cast<float>(i)), vec3(3));
  }
  const auto vpls = vplsOf(scene, {2, 0.5f, 0, 1});
  ASSERT_EQ(vpls.size(), 2u);
  vec3 sum(0.0f);
  for (const SceneVpl& v : vpls) sum += v.vpl.intensity;
  expectNear(sum, vec3(3 * (0.01f + 0.04f + 0.09f + 0.16f + 0.25f)));
}

TEST(VplSet, ADoubleSidedEmitterEmitsFromBothSides) {
  Scene scene;
  const int glowing = test::addMaterial(scene, vec3(0.0f), vec3(2.0f));
  scene.materials[glowing].doubleSided = true;
  test::addMesh(scene, test::squareMesh(2.0f, glowing));
  vec3 up(0.0f), down(0.0f);
  for (const SceneVpl& v : vplsOf(scene, {64, 0.5f, 0, 1})) {
    (v.vpl.normal.y > 0.0f ? up : down) += v.vpl.intensity;
    EXPECT_GT(v.vpl.position.y * v.vpl.normal.y,
              0.0f);  // slightly off the surface, on its own side
  }
  expectNear(up, vec3(2 * 4));
  expectNear(down, vec3(2 * 4));
}

// In a closed room of one albedo, bounce k carries the flux ρᵏ Φ: Σ I = ρᵏ Φ/π.
TEST(VplSet, BouncesCarryTheFluxTimesAlbedo) {
  const vec3 albedo(0.8f, 0.5f, 0.2f);
  Scene scene = room(albedo);
  const int glowing = test::addMaterial(scene, albedo, vec3(4, 2, 1));
  const NodeId light = test::addMesh(scene, test::boxMesh(vec3(0.5f), glowing));
  const auto vpls = vplsOf(scene, {400, 0.25f, 3, 1});
  EXPECT_EQ(vpls.size(), 400u);
  const auto sum = sums(vpls);
  const vec3 whole = 6 * 0.25f * vec3(4, 2, 1);
  expectNear(sum.at({light, 0}), whole);
  expectNear(sum.at({light, 1}), whole * albedo);
  expectNear(sum.at({light, 2}), whole * albedo * albedo);
  expectNear(sum.at({light, 3}), whole * albedo * albedo * albedo);
  int direct = 0;
  for (const SceneVpl& v : vpls) direct += v.id.bounce == 0;
  EXPECT_EQ(direct, 100);
}

// Escaped paths count as paths. The light's lower side faces a large floor and its upper side
// nothing, so half of the flux escapes.
TEST(VplSet, EscapedPathsCarryTheirShareAway) {
  Scene scene;
  const int white = test::addMaterial(scene, vec3(1.0f));
  const int glowing = test::addMaterial(scene, vec3(0.0f), vec3(1.0f));
  scene.materials[glowing].doubleSided = true;
  test::addMesh(scene, test::squareMesh(1000.0f, white));
  const NodeId light = test::addMesh(scene, test::squareMesh(1.0f, glowing), vec3(0, 0.5f, 0));
  const auto vpls = vplsOf(scene, {256, 0.0f, 1, 1});
  ASSERT_FALSE(vpls.empty());
  expectNear(sums(vpls).at({light, 1}), vec3(1.0f), 0.03f);
  // Without any surface there are no VPLs, and the search ends.
  Scene empty;
  test::addRectangleLight(empty, vec3(0), vec2(1), vec3(1));
  EXPECT_TRUE(vplsOf(empty, {64, 0.0f, 2, 1}).empty());
}

TEST(VplSet, PunctualLightsAndSky) {
  Scene scene = room(vec3(0.5f));
  const auto add = [&](PunctualKind kind, const vec3& intensity) {
    const NodeId id = test::addNode(scene, "light", kNoNode, vec3(0, 1, 0));
    scene.find(id)->punctual = PunctualLight{kind, intensity, 0.0f, 0.3f, 0.6f};
    return id;
  };
  const NodeId point = add(PunctualKind::point, vec3(1, 2, 3));
  const NodeId spot = add(PunctualKind::spot, vec3(5));
  const NodeId sun = add(PunctualKind::directional, vec3(7));
  scene.sky = vec3(0.5f);
  const auto vpls = vplsOf(scene, {104, 0.5f, 0, 1});
  EXPECT_LE(sampleCount(vpls), 104);
  EXPECT_GT(sampleCount(vpls), 90);
  EXPECT_LE(vpls.size(), 104u + VplCounts().sunMaps);
  int ofSky = 0, ofSun = 0;
  vec3 skySum(0.0f);
  for (const SceneVpl& v : vpls) {
    if (v.id.light == point) {
      EXPECT_EQ(v.vpl.position.w, shared::kVplUniform);
      expectNear(v.vpl.intensity, vec3(1, 2, 3));
    } else if (v.id.light == spot) {
      // The falloff is 1 at the inner cone and 0 at the outer cone.
      EXPECT_NEAR(std::cos(0.3f) * v.vpl.normal.w + v.vpl.tangent.w, 1.0f, 1e-4f);
      EXPECT_NEAR(std::cos(0.6f) * v.vpl.normal.w + v.vpl.tangent.w, 0.0f, 1e-4f);
      EXPECT_NEAR(v.vpl.normal.z, -1.0f, 1e-6f);
    } else if (v.id.light == sun) {
      EXPECT_EQ(v.vpl.position.w, shared::kVplDirectional);
      EXPECT_NEAR(v.vpl.normal.z, 1.0f, 1e-6f);  // towards the light
      expectNear(v.vpl.intensity, vec3(7));      // each tile has the whole irradiance
      ++ofSun;
    } else {
      ASSERT_EQ(v.id.light, kSky);
      ++ofSky;
      skySum += v.vpl.intensity;
    }
  }
  EXPECT_GT(ofSky, 3);
  EXPECT_GT(ofSun, 3);
  expectNear(skySum, vec3(0.5f * 4.0f * kPi));
}

// If a light moves, its VPLs move with it and keep their ids. Indirect VPLs move as their paths
// change.
TEST(VplSet, AMovedLightMovesItsVpls) {
  Scene scene = room(vec3(0.5f));
  const NodeId light = test::addRectangleLight(scene, vec3(0, 1.5f, 0), vec2(1, 1), vec3(4));
  const VplCounts counts{200, 0.5f, 2, 1};
  const auto before = vplsOf(scene, counts);
  const vec3 step(0.05f, 0.01f, -0.02f);
  scene.find(light)->local.translation += step;
  const auto after = vplsOf(scene, counts);
  ASSERT_EQ(before.size(), after.size());
  int far = 0, bounced = 0;
  for (size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].id, after[i].id);
    const float distance = glm::length(vec3(after[i].vpl.position - before[i].vpl.position) - step);
    if (before[i].id.bounce == 0) {
      EXPECT_LT(distance, 1e-4f);
    } else if (before[i].id.bounce == 1) {
      ++bounced;
      far += distance > 0.5f;
    }
  }
  EXPECT_EQ(bounced, 50);
  EXPECT_LE(far, 2);  // paths that now hit another wall
}

// More samples do not move the existing ones.
TEST(VplSet, IsStableInTheNumberOfSamples) {
  Scene scene = room(vec3(0.5f));
  test::addRectangleLight(scene, vec3(0, 1.5f, 0), vec2(1, 1), vec3(4));
  std::map<VplId, vec3> few;
  for (const SceneVpl& v : vplsOf(scene, {100, 0.5f, 2, 1})) few[v.id] = vec3(v.vpl.position);
  size_t found = 0;
  std::set<VplId> ids;
  for (const SceneVpl& v : vplsOf(scene, {300, 0.5f, 2, 1})) {
    EXPECT_TRUE(ids.insert(v.id).second);  // each id once
    const auto it = few.find(v.id);
    if (it == few.end()) continue;
    ++found;
    EXPECT_EQ(it->second, vec3(v.vpl.position));
  }
  EXPECT_EQ(found, few.size());
}

TEST(VplSet, AnotherSeedGivesOtherPlaces) {
  Scene scene = room(vec3(0.5f));
  test::addRectangleLight(scene, vec3(0, 1.5f, 0), vec2(1, 1), vec3(4));
  const auto a = vplsOf(scene, {50, 0.5f, 1, 1}), b = vplsOf(scene, {50, 0.5f, 1, 2});
  ASSERT_EQ(a.size(), b.size());
  int same = 0;
  for (size_t i = 0; i < a.size(); ++i) same += a[i].vpl.position == b[i].vpl.position;
  EXPECT_EQ(same, 0);
}

// The tiles cover every object once, and are small where there is much detail.
TEST(SunShadowTiles, CoverTheSceneOnceAndFollowItsDetail) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(100.0f));
  for (int i = 0; i < 30; ++i) {
    test::addMesh(scene, test::boxMesh(vec3(0.5f)), vec3(20 + i % 6, 0.3f, 10 + i / 6));
  }
  const test::LitScene lit(scene);
  const vec3 towards = glm::normalize(vec3(0.3f, 1.0f, 0.2f));
  const Frame frame(towards);
  const mat3 axes(frame.tangent, frame.bitangent, frame.normal);
  const vec3 middle = lit.render.bounds.centre();
  const float whole = lit.render.bounds.radius();
  const auto across = [&](const vec3& p) {
    return vec2(glm::dot(p - middle, axes[0]), glm::dot(p - middle, axes[1]));
  };
  const auto covering = [&](const std::vector<SunShadowTile>& tiles, const vec2& p) {
    std::vector<SunShadowTile> found;
    for (const SunShadowTile& s : tiles) {
      const vec2 d = p - s.centre;
      if (d.x >= -s.side && d.x < s.side && d.y >= -s.side && d.y < s.side) found.push_back(s);
    }
    return found;
  };
  EXPECT_EQ(sunShadowTiles(lit.render, axes, middle, whole, 1).size(), 1u);
  const auto tiles = sunShadowTiles(lit.render, axes, middle, whole, 40);
  EXPECT_LE(tiles.size(), 40u);
  EXPECT_GT(tiles.size(), 25u);
  std::set<uint32_t> codes;
  for (const SunShadowTile& s : tiles) EXPECT_TRUE(codes.insert(s.code).second);
  for (int i = -49; i < 50; i += 7) {
    for (int k = -49; k < 50; k += 7) {
      EXPECT_EQ(covering(tiles, across(vec3(i, 0, k))).size(), 1u) << i << " " << k;
    }
  }
  const auto atBoxes = covering(tiles, across(vec3(22, 0.3f, 12)));
  const auto elsewhere = covering(tiles, across(vec3(-30, 0, -30)));
  ASSERT_EQ(atBoxes.size(), 1u);
  ASSERT_EQ(elsewhere.size(), 1u);
  EXPECT_LE(atBoxes[0].side, 0.25f * elsewhere[0].side);
}

// Every sample of a sky has the same luminance, and their sum is all light of the sky.
TEST(VplSet, SkiesOfAllKindsGiveAllTheirLight) {
  for (const Sky& sky : {test::gradientSky(), test::cloudySky(), test::sunnySky()}) {
    Scene scene = room(vec3(0.5f));
    scene.sky = sky;
    vec3 sum(0.0f);
    std::set<NodeId> suns;
    for (const SceneVpl& v : vplsOf(scene, {256, 0.5f, 0, 1})) {
      EXPECT_EQ(v.vpl.position.w, shared::kVplDirectional);
      ASSERT_EQ(v.id.light, kSky);
      // Every tile of a sun has the whole irradiance, so only one of them counts.
      if (v.id.emitter == 0 || suns.insert(v.id.emitter).second) sum += v.vpl.intensity;
      EXPECT_EQ(v.isSample, v.id.emitter == 0);
    }
    EXPECT_EQ(suns.size(), SkySampler(sky).sunCount());
    expectNear(sum, test::irradianceOfAll(sky), 0.02f);
  }
}

// A small rotation of the sky rotates its samples; ids and intensities stay.
TEST(VplSet, ARotatedSkyKeepsItsSamples) {
  Scene scene = room(vec3(0.5f));
  scene.sky = test::sunnySky();
  const VplCounts counts{128, 0.5f, 0, 1};
  const auto before = vplsOf(scene, counts);
  scene.sky.rotation += 0.01f;
  const auto after = vplsOf(scene, counts);
  int same = 0;
  for (size_t i = 0; i < before.size(); ++i) {
    if (before[i].id.emitter != 0) continue;  // the sun's tiles follow the room
    ASSERT_EQ(after[i].id, before[i].id);
    EXPECT_EQ(after[i].vpl.intensity, before[i].vpl.intensity);
    EXPECT_LT(glm::length(vec3(after[i].vpl.normal - before[i].vpl.normal)), 0.011f);
    ++same;
  }
  EXPECT_GT(same, 20);
}

// Refinement batches sample the whole disc of a sun, so that shadows have the correct penumbra.
TEST(VplSet, BatchesSpreadOverASun) {
  Scene scene = room(vec3(0.5f));
  scene.sky = test::sunnySky();
  const vec3 middle = SkySampler(scene.sky).sun(0).towards;
  vec3 mean(0.0f);
  float spread = 0.0f;
  constexpr uint32_t kBatches = 64;
  for (uint32_t batch = 1; batch <= kBatches; ++batch) {
    for (const SceneVpl& v : vplsOf(scene, {8, 1.0f, 0, 1, batch, 1})) {
      if (v.id.emitter == 0) continue;
      const vec3 towards(v.vpl.normal);
      mean += towards / static_cast<float>(kBatches);
      spread = std::max(spread, glm::length(towards - middle));
      break;
    }
  }
  EXPECT_LT(glm::length(mean - middle), 0.001f);
  EXPECT_GT(spread, 0.004f);
  EXPECT_LT(spread, 0.016f);
}

}  // namespace
}  // namespace lamplighter
