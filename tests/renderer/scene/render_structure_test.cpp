// Nodes that are added, removed, hidden or shown change only their own objects. What is there has
// the values of a newly built scene, also for rays.
#include <random>

#include <gtest/gtest.h>

#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/render_scene.h"
#include "tests/support/edit_sequence.h"
#include "tests/support/scenes/random_boxes.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

std::vector<uint32_t> present(const RenderScene& s) {
  std::vector<uint32_t> objects;
  for (uint32_t i = 0; i < s.objects.size(); ++i)
    if (!s.objects[i].isEmpty()) objects.push_back(i);
  return objects;
}

// Whether the objects that are there are equal, in the same order.
bool looksLike(const RenderScene& a, const RenderScene& b) {
  const std::vector<uint32_t> ofA = present(a), ofB = present(b);
  if (ofA.size() != ofB.size() || a.bounds.min != b.bounds.min || a.bounds.max != b.bounds.max ||
      a.materials != b.materials || a.nominalEmission != b.nominalEmission ||
      a.firstDark != b.firstDark || a.textures != b.textures || a.punctuals != b.punctuals ||
      a.triangleCount() != b.triangleCount())
    return false;
  for (size_t i = 0; i < ofA.size(); ++i) {
    const RenderObject &o = a.objects[ofA[i]], &p = b.objects[ofB[i]];
    if (o.node != p.node || o.material != p.material || o.kind != p.kind ||
        o.isAreaLight != p.isAreaLight || o.world != p.world || o.bounds.min != p.bounds.min ||
        o.bounds.max != p.bounds.max || o.vertexCount != p.vertexCount ||
        o.indexCount != p.indexCount || o.leftOutBy != p.leftOutBy)
      return false;
    for (uint32_t v = 0; v < o.vertexCount; ++v) {
      const uint32_t from = o.firstVertex + v, to = p.firstVertex + v;
      if (a.positions[from] != b.positions[to] || a.normals[from] != b.normals[to] ||
          a.localPositions[from] != b.localPositions[to] || a.uv0[from] != b.uv0[to] ||
          a.colors[from] != b.colors[to] || a.tangents[from] != b.tangents[to])
        return false;
    }
    for (uint32_t k = 0; k < o.indexCount; ++k)
      if (a.indices[o.firstIndex + k] - o.firstVertex !=
          b.indices[p.firstIndex + k] - p.firstVertex)
        return false;
  }
  return true;
}

struct Edited {
  Scene scene = test::randomBoxes(8, 3);
  RenderScene render = test::renderSceneOf(scene);

  RenderSceneChanges become(Scene after) {
    const SceneChanges changes = compare(scene, after);
    scene = std::move(after);
    return update(render, scene, changes);
  }
  bool isLikeNew() const { return looksLike(render, test::renderSceneOf(scene)); }
};

TEST(RenderStructure, HidingAndShowingChangesOneObjectInPlace) {
  Edited e;
  const size_t objects = e.render.objects.size(), vertices = e.render.positions.size();
  Scene hidden = e.scene;
  hidden.nodes[3].visible = false;
  const Scene shown = e.scene;
  RenderSceneChanges changes = e.become(hidden);
  EXPECT_FALSE(changes.rebuilt);
  EXPECT_TRUE(changes.objects);
  ASSERT_EQ(changes.movedObjects.size(), 1u);
  const uint32_t object = changes.movedObjects[0];
  EXPECT_FALSE(changes.movedBounds[0].empty());
  EXPECT_TRUE(e.render.objects[object].isEmpty());
  EXPECT_TRUE(e.isLikeNew());
  changes = e.become(shown);
  EXPECT_FALSE(changes.rebuilt);
  EXPECT_EQ(changes.movedObjects, std::vector<uint32_t>{object});
  EXPECT_TRUE(changes.movedBounds[0].empty());
  EXPECT_EQ(e.render.objects.size(), objects);
  EXPECT_EQ(e.render.positions.size(), vertices);
  EXPECT_TRUE(e.isLikeNew());
}

TEST(RenderStructure, ADeletedObjectComesBackToItsPlaceByUndo) {
  Edited e;
  const Scene before = e.scene;
  Scene after = e.scene;
  after.nodes.erase(after.nodes.begin() + 4);
  const RenderSceneChanges gone = e.become(after);
  EXPECT_FALSE(gone.rebuilt);
  EXPECT_EQ(gone.movedObjects.size(), 1u);
  EXPECT_TRUE(e.isLikeNew());
  const size_t vertices = e.render.positions.size();
  const RenderSceneChanges back = e.become(before);
  EXPECT_FALSE(back.rebuilt);
  EXPECT_EQ(back.movedObjects, gone.movedObjects);
  EXPECT_EQ(e.render.positions.size(), vertices);
  EXPECT_TRUE(e.isLikeNew());
}

TEST(RenderStructure, ANewLightIsAppendedAndChangesNoMaterialOfOthers) {
  Edited e;
  const size_t objects = e.render.objects.size();
  const Scene before = e.scene;
  Scene after = e.scene;
  test::addRectangleLight(after, vec3(0, 3, 0), vec2(1.0f), vec3(5.0f));
  const RenderSceneChanges added = e.become(after);
  EXPECT_FALSE(added.rebuilt);
  EXPECT_FALSE(added.materials);
  EXPECT_TRUE(added.emissions.empty());
  EXPECT_EQ(added.movedObjects, std::vector<uint32_t>{static_cast<uint32_t>(objects)});
  EXPECT_TRUE(e.isLikeNew());
  EXPECT_FALSE(e.become(before).rebuilt);
  EXPECT_TRUE(e.isLikeNew());
}

// A node that is put under another parent moves to the end of the list.
TEST(RenderStructure, ANodeThatChangesItsPlaceInTheListGetsAnotherObject) {
  Edited e;
  const Scene before = e.scene;
  Scene after = e.scene;
  std::rotate(after.nodes.begin() + 2, after.nodes.begin() + 3, after.nodes.end());
  EXPECT_EQ(e.become(after).movedObjects.size(), 2u);
  EXPECT_TRUE(e.isLikeNew());
  e.become(before);
  EXPECT_TRUE(e.isLikeNew());
  Scene reversed = before;
  std::reverse(reversed.nodes.begin(), reversed.nodes.end());
  EXPECT_TRUE(e.become(reversed).rebuilt);
  EXPECT_TRUE(e.isLikeNew());
}

TEST(RenderStructure, OtherMaterialsTexturesOrKindsOfMeshesRebuildTheScene) {
  Edited e;
  const auto rebuilds = [&](auto&& edit) {
    Scene after = e.scene;
    edit(after);
    const bool is = e.become(after).rebuilt;
    EXPECT_TRUE(e.isLikeNew());
    return is;
  };
  EXPECT_TRUE(rebuilds([](Scene& s) { test::addMaterial(s, vec3(0.2f)); }));
  EXPECT_TRUE(rebuilds([](Scene& s) { s.materials[0].transmission = 1.0f; }));
  EXPECT_TRUE(rebuilds([](Scene& s) { s.nodes[2].meshKind = MeshKind::complex; }));
  EXPECT_FALSE(rebuilds([](Scene& s) {
    s.nodes[2].visible = false;
    s.materials[1].baseColor = vec4(0.9f);
  }));
}

TEST(RenderStructure, MergedChangesTellWhatWasThereFirst) {
  Edited e;
  Scene after = e.scene;
  after.nodes[3].visible = false;
  RenderSceneChanges changes = e.become(after);
  const Bounds first = changes.movedBounds[0];
  after.nodes[3].visible = true;
  after.nodes[3].local.translation.x += 1.0f;
  changes.merge(e.become(after));
  EXPECT_TRUE(changes.objects);
  ASSERT_EQ(changes.movedBounds.size(), 1u);
  EXPECT_EQ(changes.movedBounds[0].min, first.min);
}

// What a ray hits, independent of the numbers of objects.
using Seen = std::tuple<float, NodeId, uint32_t>;
Seen seen(const RenderScene& scene, const Hit& hit) {
  return {hit.t, hit ? scene.objects[hit.object].node : kNoNode, hit.triangle};
}

bool staysLikeNew(const test::EditSequence& edits) {
  Edited e;
  RayCaster rays(e.render);
  std::vector<Scene> history{e.scene};
  std::mt19937 random(7);
  const auto unit = [&] { return static_cast<float>(random() >> 8) / 8388608.0f - 1.0f; };
  for (const test::Edit& edit : edits) {
    // Every fourth step goes back to an earlier state.
    Scene after = history[edit.node % history.size()];
    if (edit.node % 4 != 0) {
      after = e.scene;
      apply(after, edit);
    }
    rays.update(e.become(after));
    history.push_back(e.scene);
    const RenderScene built = test::renderSceneOf(e.scene);
    if (!looksLike(e.render, built)) return false;
    const RayCaster fresh(built);
    for (int i = 0; i < 200; ++i) {
      const Ray ray{4.0f * vec3(unit(), unit(), unit()), 0.0f, vec3(unit(), unit(), unit())};
      if (seen(e.render, rays.intersect(ray)) != seen(built, fresh.intersect(ray)) ||
          rays.occluded(ray) != fresh.occluded(ray))
        return false;
    }
  }
  return true;
}

class StructureEdits : public testing::TestWithParam<uint32_t> {};

TEST_P(StructureEdits, LeaveTheObjectsAndHitsOfANewScene) {
  EXPECT_EQ(test::shortestFailing(test::randomStructureEdits(30, GetParam()), staysLikeNew),
            test::EditSequence());
}
INSTANTIATE_TEST_SUITE_P(Seeds, StructureEdits, testing::Range(1u, 9u));

}  // namespace
}  // namespace lamplighter
