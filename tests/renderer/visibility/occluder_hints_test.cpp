// What stood between another light and another patch is asked first, to be quick. It must change no
// answer: which one that is hangs on threads, and on what was edited before.
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "renderer/sampling/vpl_set.h"
#include "renderer/scene/gltf_io.h"
#include "renderer/visibility/light_clusters.h"
#include "renderer/visibility/occluders.h"

namespace lamplighter {
namespace {

class OccluderHints : public testing::TestWithParam<const char*> {};

TEST_P(OccluderHints, ChangeNoAnswer) {
  const Scene level =
      loadGltf(std::filesystem::path(LAMPLIGHTER_SOURCE_DIR) / "assets/scenes" / GetParam()).scene;
  RenderScene scene;
  update(scene, level, SceneChanges::all());
  std::vector<shared::Vpl> lights;
  for (const SceneVpl& v :
       generateVpls(scene, RayCaster(scene), LightSet(scene), {200, 0.3f, 3, 1}).vpls)
    lights.push_back(v.vpl);
  Occluders occluders;
  occluders.resize(scene.objects.size());
  std::vector<ObjectPatches> patches;
  for (uint32_t i = 0; i < scene.objects.size(); ++i) {
    const MeshTopology topology = findTopology(scene, i);
    patches.push_back(placePatches(scene, i, topology));
    occluders.place(scene, i, topology, patches[i]);
  }
  occluders.finish(scene);

  // And candidates for all lights of a shaft, which ones come together being as accidental.
  const LightClusters clusters = clusterLights(lights);
  size_t among = 0, otherwise = 0;
  uint32_t random = 1;
  for (uint32_t object = 0; object < patches.size(); ++object) {
    for (size_t p = 0; p < patches[object].patches.size(); ++p) {
      const PatchRegion region(scene, object, patches[object], patches[object].patches[p]);
      if (region.count != 4) continue;
      for (size_t first = 0; first < clusters.order.size();) {
        random = random * 1664525u + 1013904223u;
        const size_t most = 4 + (random >> 28);
        size_t last = first + 1;
        const auto clusterOf = [&](size_t i) {
          return clusters.clusterOf[static_cast<size_t>(clusters.order[i])];
        };
        while (last < clusters.order.size() && last < first + most &&
               clusterOf(last) == clusterOf(first))
          ++last;
        std::vector<const shared::Vpl*> some;
        for (size_t i = first; i < last; ++i)
          some.push_back(&lights[static_cast<size_t>(clusters.order[i])]);
        const LightShaft shaft(some, region);
        Occluders::Candidates candidates;
        occluders.collect(shaft, {}, candidates);
        Blocker hint;
        for (size_t i = 0; i < some.size(); ++i) {
          if (!candidates.isWhole || !shaft.holds(i)) continue;
          const OcclusionPyramid pyramid(*some[i], region);
          if (pyramid.isDark() || pyramid.isDegenerate()) continue;
          Blocker none;
          const auto alone = occluders.occlusionWithout(scene, pyramid, {}, none);
          const auto found = occluders.occlusionAmong(scene, pyramid, candidates, {}, hint);
          ++among;
          otherwise += alone != found;
        }
        first = last;
      }
    }
  }
  EXPECT_EQ(otherwise, 0u) << "of " << among;

  // All that ever stood between: where nothing does, none of it is found to when it is asked first.
  std::set<std::pair<int, uint32_t>> blockers;
  const auto forAll = [&](const auto& visit) {
    for (uint32_t object = 0; object < patches.size(); ++object) {
      for (const Patch& patch : patches[object].patches) {
        const PatchRegion region(scene, object, patches[object], patch);
        for (const shared::Vpl& light : lights) {
          const OcclusionPyramid pyramid(light, region);
          Blocker met;
          visit(pyramid, occluders.occlusionWithout(scene, pyramid, {}, met), met);
        }
      }
    }
  };
  forAll([&](const OcclusionPyramid&, Occlusion, const Blocker& met) {
    if (met.object != kNone) blockers.emplace(met.object, met.item);
  });
  size_t asked = 0, differ = 0;
  forAll([&](const OcclusionPyramid& pyramid, Occlusion answer, const Blocker&) {
    if (answer != Occlusion::none) return;
    for (const auto& [object, item] : blockers) {
      Blocker first{object, item};
      differ += occluders.occlusionBy(scene, pyramid, {}, first) != Occlusion::none;
      ++asked;
    }
  });
  EXPECT_GT(asked, 100000u);
  EXPECT_EQ(differ, 0u) << "of " << asked << ", " << blockers.size() << " blockers";
}
INSTANTIATE_TEST_SUITE_P(Rooms, OccluderHints, testing::Values("pillar_room.gltf", "default.gltf"));

}  // namespace
}  // namespace lamplighter
