// What is asked of many lights at once against what each is told alone: the same, to the bit, for a
// database that a drag brought up to date is the one that is made from nothing.
#include "renderer/visibility/mover_shadows.h"

#include <gtest/gtest.h>

#include "renderer/sampling/vpl_set.h"
#include "renderer/scene/gltf_io.h"
#include "renderer/visibility/shadow_reaches.h"
#include "renderer/visibility/visibility_database.h"

namespace lamplighter {
namespace {

class MoversOfARoom : public testing::Test {
 protected:
  void SetUp() override {
    level_ =
        loadGltf(std::filesystem::path(LAMPLIGHTER_SOURCE_DIR) / "assets/scenes/pillar_room.gltf")
            .scene;
    update(scene_, level_, SceneChanges::all());
    for (const SceneVpl& v :
         generateVpls(scene_, RayCaster(scene_), LightSet(scene_), {130, 0.5f, 1, 1}).vpls)
      lights_.push_back(v.vpl);
    for (const Node& n : level_.nodes)
      if (n.name == "mover") mover_ = n.id;
  }

  uint32_t moverObject() const {
    for (uint32_t i = 0; i < scene_.objects.size(); ++i)
      if (scene_.objects[i].node == mover_) return i;
    return 0;
  }

  // The lights, eight at a time, for which a rectangle of objects that do not move is neither dark
  // nor degenerate.
  template <typename Visit>
  void forEachBatch(const Visit& visit) const {
    for (uint32_t object = 0; object < scene_.objects.size(); ++object) {
      const ObjectPatches patches = placePatches(scene_, object, findTopology(scene_, object));
      for (const Patch& patch : patches.patches) {
        if (object == moverObject() || patch.chart == kNone) continue;
        const PatchRegion region(scene_, object, patches, patch);
        std::vector<size_t> some;
        for (size_t slot = 0; slot < lights_.size(); ++slot) {
          const OcclusionPyramid pyramid(lights_[slot], region);
          if (!pyramid.isDark() && !pyramid.isDegenerate()) some.push_back(slot);
          if (some.size() < 8 && slot + 1 < lights_.size()) continue;
          if (!some.empty()) visit(region, some);
          some.clear();
        }
      }
    }
  }

  Scene level_;
  RenderScene scene_;
  std::vector<shared::Vpl> lights_;
  NodeId mover_ = kNoNode;
};

TEST_F(MoversOfARoom, PyramidsMeetTogetherWhatEachMeetsAlone) {
  uint32_t random = 1;
  const auto next = [&] {
    random = random * 1664525u + 1013904223u;
    return static_cast<float>(random >> 8) * 0x1p-24f;
  };
  size_t met = 0, asked = 0, differ = 0;
  forEachBatch([&](const PatchRegion& region, const std::vector<size_t>& slots) {
    std::vector<PyramidApex> apices;
    for (const size_t slot : slots) apices.emplace_back(lights_[slot]);
    std::vector<const PyramidApex*> pointers;
    for (const PyramidApex& a : apices) pointers.push_back(&a);
    const PyramidBatch batch(pointers, region);
    BoxBatch boxes;
    std::array<Bounds, BoxBatch::kBoxes> each;
    for (size_t i = 0; i < each.size(); ++i) {
      const vec3 at = scene_.bounds.min + vec3(next(), next(), next()) * scene_.bounds.extent();
      each[i].add(at);
      each[i].add(at + 0.5f * vec3(next(), next(), next()));
      boxes.set(i, each[i]);
    }
    for (size_t i = 0; i < slots.size(); ++i) {
      const OcclusionPyramid alone(lights_[slots[i]], region);
      const auto is = [&](uint32_t mask, size_t bit, bool expected) {
        differ += (mask >> bit & 1) != (expected ? 1u : 0u);
        met += expected;
        ++asked;
      };
      is(batch.mayMeet(each[0]), i, alone.mayMeet(each[0]));
      is(batch.mayMeetOwn(boxes), i, alone.mayMeet(each[i]));
      is(batch.mayMeetSphere(each[1].centre(), 0.3f), i,
         alone.mayMeetSphere(each[1].centre(), 0.3f));
      for (size_t b = 0; b < each.size(); ++b)
        is(batch.mayMeetSome(i, boxes), b, alone.mayMeet(each[b]));
    }
  });
  EXPECT_GT(met, 10000u);
  EXPECT_GT(asked - met, 10000u);
  EXPECT_EQ(differ, 0u) << "of " << asked;
}

TEST_F(MoversOfARoom, ShadowsReachTogetherWhatEachReachesAlone) {
  const Caster caster(scene_.objects[moverObject()].bounds);
  ShadowReaches reaches(lights_.size());
  std::vector<ShadowReach> each;
  for (size_t i = 0; i < lights_.size(); ++i) {
    each.emplace_back(lights_[i], caster);
    if (i % 7 != 0) reaches.set(i, each[i]);  // the others stay empty
  }
  size_t reached = 0, differ = 0;
  forEachBatch([&](const PatchRegion& region, const std::vector<size_t>& slots) {
    for (const size_t slot : slots) {
      const bool expected = slot % 7 != 0 && each[slot].mayFallOn(region.centre, region.radius);
      const uint32_t mask = reaches.mayFallOn(slot / 8, region.centre, region.radius);
      differ += (mask >> slot % 8 & 1) != (expected ? 1u : 0u);
      reached += expected;
    }
  });
  EXPECT_GT(reached, 1000u);
  EXPECT_EQ(differ, 0u);
}

// Whatever they were met by before.
TEST_F(MoversOfARoom, MoversShadowTogetherWhatTheyShadowAlone) {
  Occluders occluders;
  occluders.resize(scene_.objects.size());
  for (uint32_t i = 0; i < scene_.objects.size(); ++i) {
    const MeshTopology topology = findTopology(scene_, i);
    occluders.place(scene_, i, topology, placePatches(scene_, i, topology));
  }
  occluders.finish(scene_);
  const uint32_t mover = moverObject();
  const MoverShadows shadows(occluders, {&mover, 1}, lights_);
  ASSERT_TRUE(shadows.isAbout(0));
  size_t met = 0, asked = 0, differ = 0;
  uint32_t random = 1;
  forEachBatch([&](const PatchRegion& region, const std::vector<size_t>& slots) {
    std::vector<MoverShadows::Question> questions;
    for (const size_t slot : slots) {
      random = random * 1664525u + 1013904223u;
      questions.push_back({slot, static_cast<MoverShadows::Hint>(random >> 24)});
    }
    const MoverShadows::Answer answer = shadows.of(region, questions);
    for (size_t i = 0; i < slots.size(); ++i) {
      Blocker first;
      const Occlusion alone = occluders.occlusionBy(
          scene_, OcclusionPyramid(lights_[slots[i]], region), {&mover, 1}, first);
      const bool isMet = (answer.met >> i & 1) != 0;
      differ += alone != (isMet ? Occlusion::partial : Occlusion::none);
      met += isMet;
      ++asked;
    }
  });
  EXPECT_GT(met, 1000u);
  EXPECT_GT(asked - met, 1000u);
  EXPECT_EQ(differ, 0u) << "of " << asked;
}

// Steps and turns, of which some lights miss a few.
TEST_F(MoversOfARoom, ADragLeavesNoEntryOtherThanFromNothing) {
  RenderSceneChanges everything;
  everything.rebuilt = true;
  VisibilityDatabase kept;
  kept.setScene(scene_, everything);
  kept.setLights(scene_, lights_);
  std::vector<int> some;
  for (int slot = 0; slot < static_cast<int>(lights_.size()); slot += 3) some.push_back(slot);
  for (int step = 0; step < 9; ++step) {
    const Scene before = level_;
    Node& node = *level_.find(mover_);
    node.local.translation += vec3(0.11f, step % 4 == 1 ? 0.3f : 0.0f, -0.07f);
    node.local.rotation = glm::angleAxis(0.3f * static_cast<float>(step), vec3(0.0f, 1.0f, 0.0f));
    kept.setScene(scene_, update(scene_, level_, compare(before, level_)));
    kept.refresh(scene_, some);
    if (step % 3 != 2) continue;
    kept.refreshAll(scene_);
    VisibilityDatabase fresh;
    fresh.setScene(scene_, everything);
    fresh.setLights(scene_, lights_);
    size_t differ = 0;
    for (uint32_t object = 0; object < fresh.objects(); ++object) {
      for (int p = 0; p < static_cast<int>(fresh.patches(object).patches.size()); ++p) {
        const auto a = kept.row(object, p), b = fresh.row(object, p);
        for (size_t i = 0; i < b.size(); ++i) differ += a[i] != b[i];
      }
    }
    EXPECT_EQ(differ, 0u) << "after step " << step;
  }
}

}  // namespace
}  // namespace lamplighter
