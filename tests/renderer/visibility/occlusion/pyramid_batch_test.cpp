// Eight occlusion pyramids at a time give the results of each pyramid alone.
#include "renderer/visibility/occlusion/pyramid_batch.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/scenes/room_lights.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

TEST(PyramidBatch, IntersectsTrianglesAsSinglePyramidsDo) {
  uint32_t random = 2;
  const auto next = [&] {
    random = random * 1664525u + 1013904223u;
    return static_cast<float>(random >> 8) * 0x1p-24f;
  };
  size_t asked = 0, differ = 0, met = 0, unsure = 0, missed = 0, missedUnsure = 0;
  const RenderScene scene = test::renderSceneOf(test::loadAsset("pillar_room"));
  const std::vector<shared::Vpl> lights = test::lightsOf(scene, 100);
  const auto askOf = [&](const PatchRegion& region, std::span<const shared::Vpl* const> some) {
    std::vector<PyramidApex> apices;
    for (const shared::Vpl* light : some) apices.emplace_back(*light);
    std::vector<const PyramidApex*> pointers;
    for (const PyramidApex& apex : apices) pointers.push_back(&apex);
    const PyramidBatch batch(LightPacket(pointers), region);
    std::array<vec3, 3> t;  // small triangles, and triangles as large as the room
    const float size = next();
    for (vec3& corner : t)
      corner =
          glm::mix(region.centre + vec3(next(), next(), next()) - 0.5f,
                   scene.bounds.min + vec3(next(), next(), next()) * scene.bounds.extent(), size);
    const PyramidBatch::Met answer = batch.meets(t);
    const LightMask sure = batch.surelyMiss(t, 1e-4f), held = batch.hold(t[0]);
    for (size_t i = 0; i < some.size(); ++i, ++asked) {
      const OcclusionPyramid alone(*some[i], region);
      const bool expected = alone.meets(t[0], t[1], t[2]);
      const bool isMet = (answer.met() >> i & 1) != 0, isUnsure = (answer.unsure >> i & 1) != 0,
                 isMissed = (sure >> i & 1) != 0;
      differ += (isUnsure ? batch.planesOf(i).meet(t[0], t[1], t[2]) : isMet) != expected;
      differ += (held >> i & 1) != (alone.holds(t[0]) ? 1u : 0u);
      differ += isMissed && expected;
      met += expected;
      unsure += isUnsure;
      missed += isUnsure && isMissed;
      missedUnsure += isUnsure && !expected;
    }
  };
  for (uint32_t object = 0; object < scene.objects.size(); ++object) {
    const ObjectPatches patches = placePatches(scene, object, findTopology(scene, object));
    for (const Patch& patch : patches.patches) {
      const PatchRegion region(scene, object, patches, patch);
      if (region.count != 4) continue;
      std::vector<const shared::Vpl*> some;
      for (const shared::Vpl& light : lights) {
        const OcclusionPyramid alone(light, region);
        if (!alone.isDark() && !alone.isDegenerate()) some.push_back(&light);
        if (some.size() < LightPacket::kLights && &light != &lights.back()) continue;
        if (!some.empty()) askOf(region, some);
        some.clear();
      }
    }
  }
  EXPECT_GT(met, 1000u);
  EXPECT_GT(unsure, 1000u);
  EXPECT_GT(2 * missed, missedUnsure);
  EXPECT_EQ(differ, 0u) << "of " << asked;
}

}  // namespace
}  // namespace lamplighter
