// Tests of eight lights at a time give the results of each light alone, bit for bit. A database
// that is updated during a drag must equal a new one.
#include "renderer/visibility/movers/mover_shadows.h"

#include <limits>

#include <gtest/gtest.h>

#include "renderer/visibility/movers/shadow_volumes.h"
#include "renderer/visibility/visibility_database.h"
#include "tests/support/scenes/room_lights.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

class MoversOfARoom : public testing::Test {
 protected:
  void SetUp() override {
    level_ = test::loadAsset("pillar_room");
    scene_ = test::renderSceneOf(level_);
    lights_ = test::lightsOf(scene_, {130, 0.5f, 1, 1});
    for (const Node& n : level_.nodes)
      if (n.name == "mover") mover_ = n.id;
  }

  uint32_t moverObject() const {
    for (uint32_t i = 0; i < scene_.objects.size(); ++i)
      if (scene_.objects[i].node == mover_) return i;
    return 0;
  }

  // Visits each rectangle of static objects with up to eight lights at a time for which it is
  // neither dark nor degenerate.
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

  Occluders placeOccluders() const {
    Occluders occluders;
    occluders.resize(scene_.objects.size());
    for (uint32_t i = 0; i < scene_.objects.size(); ++i) {
      const MeshTopology topology = findTopology(scene_, i);
      occluders.place(scene_, i, topology, placePatches(scene_, i, topology));
    }
    occluders.finish(scene_);
    return occluders;
  }

  MoverPlace placeOf(const Occluders& occluders) const {
    const std::span<const Bounds> groups = occluders.groups(moverObject());
    return {occluders.caster(moverObject()), {groups.begin(), groups.end()}};
  }

  // The path after three steps in this direction.
  MoverPath straightPath(const vec3& direction) const {
    MoverPath path;
    MoverPlace place{Caster(Bounds{vec3(0.0f), vec3(1.0f)}), {}};
    for (int i = 0; i < 3; ++i) {
      const MoverPlace before = place;
      place.caster.box.min += 0.03f * direction;
      place.caster.box.max += 0.03f * direction;
      path.advance({&before, 1}, {&place, 1});
    }
    return path;
  }

  // Calls visit(region, slot, whether the mover may block the light, slack) for the same entries in
  // the same order for any shadows, with random hints.
  template <typename Visit>
  void forEachAnswer(const MoverShadows& shadows, const Visit& visit) const {
    uint32_t random = 1;
    forEachBatch([&](const PatchRegion& region, const std::vector<size_t>& slots) {
      std::vector<MoverShadows::Question> questions;
      for (const size_t slot : slots) {
        random = random * 1664525u + 1013904223u;
        questions.push_back({slot, static_cast<MoverShadows::Hint>(random >> 24)});
      }
      MoverShadows::Answer answer;
      if (!questions.empty()) answer = shadows.of(region, questions);
      size_t i = 0;
      for (const size_t slot : slots) {
        const bool isAsked = i < questions.size() && questions[i].slot == slot;
        visit(region, slot, isAsked && (answer.met >> i & 1) != 0,
              isAsked ? answer.slack[i] : 0.0f);
        if (isAsked) ++i;
      }
    });
  }

  Scene level_;
  RenderScene scene_;
  std::vector<shared::Vpl> lights_;
  NodeId mover_ = kNoNode;
};

TEST_F(MoversOfARoom, EightPyramidsEqualSinglePyramids) {
  uint32_t random = 1;
  const auto next = [&] {
    random = random * 1664525u + 1013904223u;
    return static_cast<float>(random >> 8) * 0x1p-24f;
  };
  const MotionMetric metrics[] = {MotionMetric(), {glm::normalize(vec3(1.0f, 0.2f, -0.5f)), 8.0f}};
  size_t met = 0, asked = 0, differ = 0;
  forEachBatch([&](const PatchRegion& region, const std::vector<size_t>& slots) {
    std::vector<PyramidApex> apices;
    for (const size_t slot : slots) apices.emplace_back(lights_[slot]);
    std::vector<const PyramidApex*> pointers;
    for (const PyramidApex& a : apices) pointers.push_back(&a);
    PyramidBatch batch(LightPacket(pointers), region);
    batch.weighBy(metrics[random % 2]);
    std::array<Bounds, 13> each;
    for (size_t i = 0; i < each.size(); ++i) {
      const vec3 at = scene_.bounds.min + vec3(next(), next(), next()) * scene_.bounds.extent();
      each[i].add(at);
      each[i].add(at + 0.5f * vec3(next(), next(), next()));
    }
    const BoxBatches boxes(each);
    PyramidBatch::Indices which{};
    for (size_t i = 0; i < slots.size(); ++i)
      which[i] = static_cast<int32_t>((i * 5) % each.size());
    PyramidBatch::Depths ofEach;
    const LightMask metEach = batch.mayMeetEach(boxes, which, ofEach);
    for (size_t i = 0; i < slots.size(); ++i) {
      const OcclusionPyramid alone(lights_[slots[i]], region);
      const auto is = [&](uint32_t mask, size_t bit, bool expected) {
        differ += (mask >> bit & 1) != (expected ? 1u : 0u);
        met += expected;
        ++asked;
      };
      PyramidBatch::Depths depths;
      is(batch.mayMeet(each[0]), i, alone.mayMeet(each[0]));
      is(batch.mayMeetSphere(each[1].centre(), 0.3f, depths), i,
         alone.mayMeetSphere(each[1].centre(), 0.3f));
      const bool any =
          std::any_of(each.begin(), each.end(), [&](const Bounds& b) { return alone.mayMeet(b); });
      is(metEach, i, alone.mayMeet(each[static_cast<size_t>(which[i])]));
      const PyramidBatch::Found found = batch.find(i, boxes, i % 3 == 0 ? 0.0f : 1e9f);
      is(found.box != kNone, 0, any);
      is(found.depth >= 0.0f, 0, any);
      if (any) is(1, 0, alone.mayMeet(each[static_cast<size_t>(found.box)]));
    }
  });
  EXPECT_GT(met, 10000u);
  EXPECT_GT(asked - met, 10000u);
  EXPECT_EQ(differ, 0u) << "of " << asked;
}

TEST_F(MoversOfARoom, EightShadowVolumesEqualSingleOnes) {
  const Caster caster(scene_.objects[moverObject()].bounds);
  ShadowVolumes reaches(lights_.size());
  std::vector<ShadowVolume> each;
  for (size_t i = 0; i < lights_.size(); ++i) {
    each.emplace_back(lights_[i], caster);
    if (i % 7 != 0) reaches.set(i, each[i]);  // the other slots are empty
  }
  size_t reached = 0, differ = 0;
  forEachBatch([&](const PatchRegion& region, const std::vector<size_t>& slots) {
    for (const size_t slot : slots) {
      const bool expected = slot % 7 != 0 && each[slot].mayFallOn(region.centre, region.radius);
      const uint64_t bit = uint64_t{1} << slot % 64;
      const uint64_t both = bit | uint64_t{1} << 5;  // and another light
      differ += (reaches.mayFallOn(slot / 64, bit, region.centre, region.radius) != 0) != expected;
      differ += (reaches.mayFallOn(slot / 64, both, region.centre, region.radius) & bit) !=
                (expected ? bit : 0);
      reached += expected;
    }
  });
  EXPECT_GT(reached, 1000u);
  EXPECT_EQ(differ, 0u);
}

// The hints, which come from earlier tests, do not change the result.
TEST_F(MoversOfARoom, ShadowsOfEightLightsEqualThoseOfSingleLights) {
  const Occluders occluders = placeOccluders();
  const uint32_t mover = moverObject();
  const MoverShadows shadows(occluders, {&mover, 1}, lights_, MoverPath());
  ASSERT_TRUE(shadows.isAbout(0));
  size_t met = 0, asked = 0, differ = 0;
  forEachAnswer(shadows, [&](const PatchRegion& region, size_t slot, bool isMet, float) {
    Blocker first;
    const Occlusion alone =
        occluders.occlusionBy(scene_, OcclusionPyramid(lights_[slot], region), {&mover, 1}, first);
    differ += alone != (isMet ? Occlusion::partial : Occlusion::none);
    met += isMet;
    ++asked;
  });
  EXPECT_GT(met, 1000u);
  EXPECT_GT(asked - met, 1000u);
  EXPECT_EQ(differ, 0u) << "of " << asked;
}

// As long as the mover has moved less than the slack by the motion metric, for any direction and
// rotation, the result stays valid.
TEST_F(MoversOfARoom, ResultsStayValidWithinTheirSlack) {
  const uint32_t mover = moverObject();
  const Occluders before = placeOccluders();
  const MoverPlace placeBefore = placeOf(before);
  const vec3 steps[] = {{0.05f, 0.0f, 0.0f},    {-0.03f, 0.02f, 0.0f}, {0.0f, 0.0f, -0.08f},
                        {0.01f, -0.15f, 0.01f}, {0.0f, 0.25f, 0.2f},   {0.004f, 0.0f, 0.003f}};
  float angle = 0.0f;
  for (const vec3& shift : steps) {
    // Without a direction; along the step, as in a straight drag; along another direction.
    const vec3 straight = glm::normalize(shift), other = glm::normalize(vec3(1.0f, 0.1f, 0.3f));
    std::array<size_t, 3> valid{}, met{};
    for (size_t metric = 0; metric < 3; ++metric) {
      const MoverPath path =
          metric == 0 ? MoverPath() : straightPath(metric == 1 ? straight : other);
      std::vector<float> slacks;
      std::vector<bool> answers;
      forEachAnswer(MoverShadows(before, {&mover, 1}, lights_, path),
                    [&](const PatchRegion&, size_t, bool isMet, float slack) {
                      slacks.push_back(slack);
                      answers.push_back(isMet);
                    });
      const Scene old = level_;
      Node& node = *level_.find(mover_);
      const Transform place = node.local;
      node.local.translation += shift;
      node.local.rotation = glm::angleAxis(angle, vec3(0.0f, 1.0f, 0.0f)) * node.local.rotation;
      update(scene_, level_, compare(old, level_));
      const Occluders after = placeOccluders();
      const float step = 1.01f * farthestStep(placeBefore, placeOf(after), path.metric());
      size_t differ = 0, i = 0;
      forEachAnswer(MoverShadows(after, {&mover, 1}, lights_, MoverPath()),
                    [&](const PatchRegion&, size_t, bool isMet, float) {
                      const bool isValid = slacks[i] > step;
                      valid[metric] += isValid;
                      met[metric] += isValid && isMet;
                      differ += isValid && isMet != answers[i];
                      ++i;
                    });
      if (metric == 0) {
        EXPECT_LT(step, 0.6f);
        EXPECT_GT(valid[0], 100u) << "after " << step << " m";
        if (step < 0.1f) {
          EXPECT_GT(met[0], 100u);
        }
      }
      EXPECT_EQ(differ, 0u) << "of " << valid[metric] << " after " << step << " m, metric "
                            << metric;
      node.local = place;
      update(scene_, level_, SceneChanges::all());
    }
    if (angle == 0.0f) {
      EXPECT_GT(valid[1], valid[0]);
      EXPECT_GT(met[1], met[0]);
    }
    angle += 0.02f;
  }
}

// Drags with steps and rotations in which some lights skip updates. Short steps keep most entries.
class DragsInARoom : public MoversOfARoom, public testing::WithParamInterface<float> {
 protected:
  // move(node, step): one step of the mover.
  template <typename Move>
  void drag(int steps, const Move& move) {
    VisibilityDatabase kept;
    kept.setScene(scene_, test::everythingRebuilt());
    kept.setLights(scene_, lights_);
    std::vector<int> some;
    for (int slot = 0; slot < static_cast<int>(lights_.size()); slot += 3) some.push_back(slot);
    for (int step = 0; step < steps; ++step) {
      const Scene before = level_;
      move(*level_.find(mover_), step);
      kept.setScene(scene_, update(scene_, level_, compare(before, level_)));
      kept.refresh(scene_, some);
      if (step % 3 != 2) continue;
      kept.refreshAll(scene_);
      VisibilityDatabase fresh;
      fresh.setScene(scene_, test::everythingRebuilt());
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
};

TEST_P(DragsInARoom, GiveTheEntriesOfANewDatabase) {
  drag(18, [&](Node& node, int step) {
    node.local.translation += GetParam() * vec3(0.11f, step % 4 == 1 ? 0.3f : 0.0f, -0.07f);
    node.local.rotation =
        glm::angleAxis(GetParam() * 0.3f * static_cast<float>(step), vec3(0.0f, 1.0f, 0.0f));
  });
}

// Along an axis, back and forth, then not quite straight, then along another axis.
TEST_P(DragsInARoom, GiveTheEntriesOfANewDatabaseIfStraight) {
  drag(30, [&](Node& node, int step) {
    const float length = 0.3f * GetParam() * (step % 3 == 0 ? -1.0f : 1.0f);
    const float aside = step > 8 ? 0.002f * static_cast<float>(step % 5) : 0.0f;
    node.local.translation +=
        step < 18 ? vec3(length, 0.0f, length * aside) : vec3(0.0f, length * aside, -length);
  });
}
INSTANTIATE_TEST_SUITE_P(Steps, DragsInARoom, testing::Values(1.0f, 0.2f, 0.03f));

// For slacks and steps of any length.
TEST(MoverPathTest, MarksAreValidOnlyWithinTheirSlack) {
  for (const float step : {0.0003f, 0.01f, 0.17f, 1.5f, 40.0f}) {
    MoverPath path;
    path.advance(step, 0.7f);
    for (const float slack : {-1.0f, 0.0f, 0.02f, 0.3f, 1.0f, 100.0f}) {
      MoverPath::Mark mark = path.markAfter(slack);
      float gone = 0.0f;
      for (int i = 0; i < 3000 && gone < 2.0f * slack + 1.0f; ++i) {
        if (mark >= path.now()) {
          EXPECT_LE(gone, slack) << "in steps of " << step;
        }
        const MoverPath::Mark by = path.advance(step, 0.7f);
        mark = static_cast<MoverPath::Mark>(std::max(mark, by) - by);
        gone += step;
      }
    }
    EXPECT_EQ(path.markAfter(0.0f), 0);
  }
  MoverPath path;
  path.advance(0.01f, 0.7f);
  MoverPath::Mark mark = path.markAfter(0.1f);
  for (int i = 0; i < 7; ++i) path.advance(0.01f, 0.7f);
  EXPECT_GE(mark, path.now());
  EXPECT_EQ(path.advance(std::numeric_limits<float>::infinity(), 0.7f), 255);
}

// The metric follows a straight path and is reset when the path is not straight.
TEST_F(MoversOfARoom, MetricFollowsTwoStraightSteps) {
  MoverPath path = straightPath(vec3(0.0f, 0.0f, -1.0f));
  EXPECT_NEAR(std::abs(path.metric().axis.z), 1.0f, 1e-5f);
  EXPECT_GT(path.metric().across, 1.0f);
  const MoverPath::Mark mark = path.markAfter(0.5f);
  EXPECT_GE(mark, path.now());
  const auto at = [](const vec3& place) {
    return MoverPlace{Caster(Bounds{place - 0.5f, place + 0.5f}), {}};
  };
  const MoverPlace here = at(vec3(0.0f)), ahead = at(vec3(0.0f, 0.0f, 0.02f)),
                   aside = at(vec3(0.02f, 0.0f, 0.02f));
  EXPECT_EQ(path.advance({&here, 1}, {&ahead, 1}), 0);
  EXPECT_GE(mark, path.now());
  EXPECT_EQ(path.advance({&ahead, 1}, {&aside, 1}), 255) << "all marks are invalid";
  EXPECT_EQ(path.metric().axis, vec3(0.0f));
  EXPECT_EQ(path.metric().lengthOf(vec3(0.03f, 0.0f, 0.04f)), 0.05f);
}

}  // namespace
}  // namespace lamplighter
