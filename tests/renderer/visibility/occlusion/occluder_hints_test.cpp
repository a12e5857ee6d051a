// Occluders found for other lights and patches are tested first, to save time. These hints must not
// change any result, because they depend on the number of threads and on earlier edits.
#include <array>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "renderer/visibility/occlusion/back_facing_lights.h"
#include "renderer/visibility/occlusion/occluders.h"
#include "tests/support/scenes/room_lights.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

class OccluderHints : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    scene_ = test::renderSceneOf(test::loadAsset(GetParam()));
    lights_ = test::lightsOf(scene_, 200);
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

// For visible pairs, no occluder of any other pair blocks the light when it is tested first.
TEST_P(OccluderHints, ChangeNoResult) {
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

// The choice of lights that are tested together does not change any result either.
TEST_P(OccluderHints, OfOtherLightsChangeNoResult) {
  size_t asked = 0, differ = 0, sidesDiffer = 0;
  std::array<size_t, 3> found{};
  uint32_t random = 1;
  forEachPatch([&](const PatchRegion& region) {
    std::array<Blocker, LightPacket::kLights> hints;  // from previous lights
    for (size_t first = 0, last = 0; first < lights_.size(); first = last) {
      random = random * 1664525u + 1013904223u;
      last = std::min(first + 1 + (random >> 29), lights_.size());
      std::vector<PyramidApex> apices;
      std::vector<const PyramidApex*> pointers;
      for (size_t i = first; i < last; ++i) apices.emplace_back(lights_[i]);
      for (const PyramidApex& a : apices) pointers.push_back(&a);
      const BackFacingLights sides(lanesOf(LightPacket(pointers), region), region);
      std::vector<const shared::Vpl*> open;
      for (size_t i = first; i < last; ++i) {
        const OcclusionPyramid pyramid(lights_[i], region);
        const bool isDark = (sides.dark >> (i - first) & 1) != 0,
                   isDegenerate = (sides.degenerate >> (i - first) & 1) != 0;
        sidesDiffer += pyramid.isDark() != isDark || pyramid.isDegenerate() != isDegenerate;
        if (!pyramid.isDark() && !pyramid.isDegenerate()) open.push_back(&lights_[i]);
      }
      if (open.empty()) continue;
      const Occluders::States states = occluders_.occlusionsWithout(
          scene_, {open, region}, {}, std::span(hints).first(open.size()));
      for (size_t i = 0; i < open.size(); ++i) {
        Blocker met;
        const Occlusion state = alone(OcclusionPyramid(*open[i], region), met);
        differ += states[i] != state;
        ++found[static_cast<size_t>(state)];
        ++asked;
      }
    }
  });
  EXPECT_GT(asked, 10000u);
  for (const size_t count : found) EXPECT_GT(count, 100u);
  EXPECT_EQ(differ, 0u) << "of " << asked;
  EXPECT_EQ(sidesDiffer, 0u);
}
INSTANTIATE_TEST_SUITE_P(Rooms, OccluderHints, testing::Values("pillar_room", "default"));

}  // namespace
}  // namespace lamplighter
