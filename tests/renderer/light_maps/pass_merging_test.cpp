#include "renderer/light_maps/pass_merging.h"

#include <map>
#include <numeric>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

std::vector<uint32_t> range(uint32_t first, uint32_t end) {
  std::vector<uint32_t> out(end - first);
  std::iota(out.begin(), out.end(), first);
  return out;
}

// The lights of each object. Each light must occur once.
std::map<uint32_t, std::set<uint32_t>> lightsOfObjects(std::span<const PassElement> elements) {
  std::map<uint32_t, std::set<uint32_t>> out;
  for (const PassElement& e : elements)
    for (const uint32_t object : e.objects)
      for (const uint32_t light : e.lights)
        EXPECT_TRUE(out[object].insert(light).second) << object << " has twice the light " << light;
  return out;
}

TEST(PassMerging, ObjectsWithTheSameLightsAreDrawnTogether) {
  // The paper's example: 20 objects under 300 lights with 6 lights per pass need 1000 passes.
  std::vector<PassElement> elements;
  for (uint32_t i = 0; i < 20; ++i) elements.push_back({{i}, range(0, 300)});
  const MergedPasses merged = mergePasses(elements, 6);
  EXPECT_EQ(merged.elements, (std::vector<PassElement>{{range(0, 20), range(0, 300)}}));
  EXPECT_EQ(merged.passes, 50);
  EXPECT_EQ(merged.saved, 950);
}

TEST(PassMerging, ObjectsWithoutLightsInCommonStayApart) {
  const std::vector<PassElement> elements{{{0}, range(0, 8)}, {{1}, range(8, 20)}, {{2}, {}}};
  const MergedPasses merged = mergePasses(elements, 4);
  EXPECT_EQ(merged.elements, std::vector(elements.begin(), elements.begin() + 2));
  EXPECT_EQ(merged.passes, 5);
  EXPECT_EQ(merged.saved, 0);
}

TEST(PassMerging, MergesOnlyIfThatSavesPasses) {
  // Merging the three common lights would give 1 + 1 + 1 passes instead of 1 + 1.
  const std::vector<PassElement> elements{{{0}, range(0, 4)}, {{1}, range(1, 5)}};
  EXPECT_EQ(mergePasses(elements, 4).elements, elements);
  // With one light per pass, each of the three common lights saves one pass.
  const MergedPasses merged = mergePasses(elements, 1);
  EXPECT_EQ(merged.saved, 3);
  EXPECT_EQ(merged.elements,
            (std::vector<PassElement>{{{0}, {0}}, {{1}, {4}}, {{0, 1}, {1, 2, 3}}}));
}

TEST(PassMerging, NothingGivesNothing) {
  const MergedPasses merged = mergePasses({}, 4);
  EXPECT_TRUE(merged.elements.empty());
  EXPECT_EQ(merged.passes, 0);
  EXPECT_EQ(merged.saved, 0);
}

// The algorithm as printed in the paper, which scores all pairs in each step.
int passesByAllPairs(std::vector<PassElement> elements, int most) {
  const auto total = [&](std::span<const PassElement> some) {
    int n = 0;
    for (const PassElement& e : some) n += passesOf(e, most);
    return n;
  };
  while (true) {
    int saved = 0;
    std::vector<PassElement> best;
    for (size_t a = 0; a < elements.size(); ++a) {
      for (size_t b = a + 1; b < elements.size(); ++b) {
        PassElement x = elements[a], y = elements[b], both;
        std::set_union(x.objects.begin(), x.objects.end(), y.objects.begin(), y.objects.end(),
                       std::back_inserter(both.objects));
        std::set_intersection(x.lights.begin(), x.lights.end(), y.lights.begin(), y.lights.end(),
                              std::back_inserter(both.lights));
        for (PassElement* e : {&x, &y}) {
          std::vector<uint32_t> rest;
          std::set_difference(e->lights.begin(), e->lights.end(), both.lights.begin(),
                              both.lights.end(), std::back_inserter(rest));
          e->lights = rest;
        }
        const int here = passesOf(elements[a], most) + passesOf(elements[b], most) -
                         total(std::vector{x, y, both});
        if (here <= saved) continue;
        saved = here;
        best = elements;
        best[a] = x;
        best[b] = y;
        best.push_back(both);
      }
    }
    if (saved == 0) return total(elements);
    elements = best;
  }
}

TEST(PassMerging, EqualsTheGreedyAlgorithmAndKeepsEachObjectsLights) {
  std::mt19937 random(5);
  int everSaved = 0;
  for (int round = 0; round < 60; ++round) {
    std::vector<PassElement> elements(1 + random() % 12);
    const uint32_t dense = 2 + random() % 8;
    for (uint32_t i = 0; i < elements.size(); ++i) {
      elements[i].objects = {i};
      for (uint32_t light = 0; light < 100; ++light)
        if (random() % 10 < dense) elements[i].lights.push_back(light);
    }
    const int most = 1 + static_cast<int>(random() % 16);
    const MergedPasses merged = mergePasses(elements, most);
    EXPECT_EQ(lightsOfObjects(merged.elements), lightsOfObjects(elements));
    int before = 0, after = 0;
    for (const PassElement& e : elements) before += passesOf(e, most);
    for (const PassElement& e : merged.elements) after += passesOf(e, most);
    EXPECT_EQ(merged.passes, after);
    EXPECT_EQ(merged.saved, before - after);
    EXPECT_EQ(merged.passes, passesByAllPairs(elements, most)) << "round " << round;
    everSaved += merged.saved;
  }
  EXPECT_GT(everSaved, 100);
}

TEST(PassMerging, ObjectsNeedTheMapsOfLightsThatMayBeHiddenFromThem) {
  Scene scene;
  const int grey = test::addMaterial(scene, vec3(0.5f));
  test::addMesh(scene, test::squareMesh(4.0f, grey));                       // under the box
  test::addMesh(scene, test::squareMesh(4.0f, grey), vec3(40, 0, 0));       // far from it
  test::addMesh(scene, test::boxMesh(vec3(1.0f), grey), vec3(0, 1.5f, 0));  // between
  const RenderScene render = test::renderSceneOf(scene);
  VisibilityDatabase database;
  database.setScene(render, test::everythingRebuilt());
  const std::vector<shared::Vpl> lights{test::makeVpl(vec3(0, 4, 0), vec3(0, -1, 0)),
                                        test::makeVpl(vec3(40, 4, 0), vec3(0, -1, 0))};
  database.setLights(render, lights);
  const std::vector<uint32_t> seen{0, 1};
  const std::vector<PassElement> elements = shadowedLights(database, seen);
  ASSERT_EQ(elements.size(), 2u);
  EXPECT_EQ(elements[0].objects, std::vector<uint32_t>{0});
  EXPECT_EQ(elements[0].lights.front(), 0u);
  EXPECT_EQ(elements[1], (PassElement{{1}, {}}));
}

}  // namespace
}  // namespace lamplighter
