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

class OccluderHints : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    update(scene_,
           loadGltf(std::filesystem::path(LAMPLIGHTER_SOURCE_DIR) / "assets/scenes" / GetParam())
               .scene,
           SceneChanges::all());
    for (const SceneVpl& v :
         generateVpls(scene_, RayCaster(scene_), LightSet(scene_), {200, 0.3f, 3, 1}).vpls)
      lights_.push_back(v.vpl);
    occluders_.resize(scene_.objects.size());
    for (uint32_t i = 0; i < scene_.objects.size(); ++i) {
      const MeshTopology topology = findTopology(scene_, i);
      patches_.push_back(placePatches(scene_, i, topology));
      occluders_.place(scene_, i, topology, patches_[i]);
    }
    occluders_.finish(scene_);
  }

  template <typename Visit>
  void forEachPatch(const Visit& visit) const {
    for (uint32_t object = 0; object < patches_.size(); ++object)
      for (const Patch& patch : patches_[object].patches)
        visit(PatchRegion(scene_, object, patches_[object], patch));
  }
  Occlusion alone(const OcclusionPyramid& pyramid, Blocker& met) const {
    return occluders_.occlusionWithout(scene_, pyramid, {}, met);
  }

  RenderScene scene_;
  std::vector<shared::Vpl> lights_;
  std::vector<ObjectPatches> patches_;
  Occluders occluders_;
};

// Where nothing stands between, none of all that ever did is found to when it is asked first.
TEST_P(OccluderHints, ChangeNoAnswer) {
  std::set<std::pair<int, uint32_t>> blockers;
  forEachPatch([&](const PatchRegion& region) {
    for (const shared::Vpl& light : lights_) {
      Blocker met;
      alone(OcclusionPyramid(light, region), met);
      if (met.object != kNone) blockers.emplace(met.object, met.item);
    }
  });
  size_t asked = 0, differ = 0;
  forEachPatch([&](const PatchRegion& region) {
    for (const shared::Vpl& light : lights_) {
      const OcclusionPyramid pyramid(light, region);
      Blocker met;
      if (alone(pyramid, met) != Occlusion::none) continue;
      for (const auto& [object, item] : blockers) {
        Blocker first{object, item};
        differ += occluders_.occlusionBy(scene_, pyramid, {}, first) != Occlusion::none;
        ++asked;
      }
    }
  });
  EXPECT_GT(asked, 100000u);
  EXPECT_EQ(differ, 0u) << "of " << asked << ", " << blockers.size() << " blockers";
}

// Nor do the candidates of a shaft: which lights come together in it is as accidental.
TEST_P(OccluderHints, OfAShaftChangeNoAnswer) {
  const LightClusters clusters = clusterLights(lights_);
  const auto light = [&](size_t i) { return static_cast<size_t>(clusters.order[i]); };
  size_t asked = 0, differ = 0;
  uint32_t random = 1;
  forEachPatch([&](const PatchRegion& region) {
    if (region.count != 4) return;
    for (size_t first = 0, last = 0; first < clusters.order.size(); first = last) {
      random = random * 1664525u + 1013904223u;
      const size_t most = 4 + (random >> 28);
      std::vector<const shared::Vpl*> some;
      for (; last < clusters.order.size() && some.size() < most &&
             clusters.clusterOf[light(last)] == clusters.clusterOf[light(first)];
           ++last)
        some.push_back(&lights_[light(last)]);
      const LightShaft shaft(some, region);
      Occluders::Candidates candidates;
      occluders_.collect(shaft, {}, candidates);
      Blocker hint;  // of the light before
      for (size_t i = 0; i < some.size(); ++i) {
        const OcclusionPyramid pyramid(*some[i], region);
        if (!candidates.isWhole || !shaft.holds(i) || pyramid.isDark() || pyramid.isDegenerate())
          continue;
        Blocker met;
        differ +=
            occluders_.occlusionAmong(scene_, pyramid, candidates, {}, hint) != alone(pyramid, met);
        ++asked;
      }
    }
  });
  EXPECT_GT(asked, 10000u);
  EXPECT_EQ(differ, 0u) << "of " << asked;
}
INSTANTIATE_TEST_SUITE_P(Rooms, OccluderHints, testing::Values("pillar_room.gltf", "default.gltf"));

}  // namespace
}  // namespace lamplighter
