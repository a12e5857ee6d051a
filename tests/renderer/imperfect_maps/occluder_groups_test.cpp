// Groups of triangles: complete, compact, and the same after changes as from nothing.
#include "renderer/imperfect_maps/occluder_groups.h"

#include <cmath>
#include <functional>
#include <set>

#include <gtest/gtest.h>

#include "tests/renderer/imperfect_maps/occluder_scene.h"

namespace lamplighter {
namespace {

TEST(OccluderGroups, ContainEachTriangleOnceWithItsArea) {
  const RenderScene scene = test::renderSceneOf(test::occluderBodies());
  const OccluderGroups groups(scene);
  std::set<std::pair<uint32_t, uint32_t>> seen;
  std::vector<double> areas(scene.objects.size(), 0.0);
  for (const OccluderGroup& group : groups.groups()) {
    EXPECT_LE(group.count, kOccluderGroupTriangles);
    EXPECT_EQ(group.area, groups.trianglesOf(group).back().areaUpTo);
    EXPECT_NEAR(group.facing.x + group.facing.y + group.facing.z, group.area, 1e-5f * group.area);
    areas[group.object] += static_cast<double>(group.area);
    const RenderObject& o = scene.objects[group.object];
    float before = 0.0f;
    for (const OccluderTriangle& t : groups.trianglesOf(group)) {
      EXPECT_TRUE(seen.insert({group.object, t.triangle}).second);
      const uint32_t* i = &scene.indices[o.firstIndex + 3 * t.triangle];
      const vec3 &a = scene.positions[i[0]], &b = scene.positions[i[1]], &c = scene.positions[i[2]];
      EXPECT_NEAR(t.areaUpTo - before, 0.5f * glm::length(glm::cross(b - a, c - a)),
                  1e-5f * group.area);
      before = t.areaUpTo;
      for (const vec3& p : {a, b, c})
        EXPECT_LE(glm::distance(p, group.centre), group.radius * 1.0001f + 1e-6f);
    }
  }
  EXPECT_EQ(seen.size(), scene.triangleCount() - 2) << "all but those of the clear pane";
  for (uint32_t i = 0; i < areas.size(); ++i)
    EXPECT_NEAR(groups.areaOf(i), areas[i], 1e-9 * areas[i]);
  EXPECT_EQ(groups.areaOf(3), 0.0) << "rays pass through the pane";
  EXPECT_NEAR(groups.areaOf(4), 400.0, 1e-3);
}

TEST(OccluderGroups, AreCompact) {
  const RenderScene scene = test::renderSceneOf([] {
    Scene s;
    test::addMesh(s, test::sphereMesh(1.0f, 64));
    return s;
  }());
  const OccluderGroups groups(scene);
  EXPECT_LE(groups.groups().size(), scene.triangleCount() / 8);
  for (const OccluderGroup& group : groups.groups()) EXPECT_LT(group.radius, 0.35f);
}

// A square of 20 m among small triangles is not in a group with them.
TEST(OccluderGroups, LeaveLargeTrianglesAlone) {
  Mesh mesh = *test::sphereMesh(0.5f, 16);
  Primitive& p = mesh.primitives[0];
  const auto first = static_cast<uint32_t>(p.positions.size());
  const auto large = static_cast<uint32_t>(p.indices.size() / 3);
  for (const vec3& corner : {vec3(-20, 0, -20), vec3(20, 0, -20), vec3(0, 0, 40)}) {
    p.positions.push_back(corner);
    p.normals.emplace_back(0.0f, 1.0f, 0.0f);
    p.uv0.emplace_back(0.0f);
  }
  p.indices.insert(p.indices.end(), {first, first + 1, first + 2});
  Scene scene;
  test::addMesh(scene, std::make_shared<const Mesh>(std::move(mesh)));
  const OccluderGroups groups(test::renderSceneOf(scene));
  for (const OccluderGroup& group : groups.groups()) {
    const bool isLarge = groups.trianglesOf(group)[0].triangle == large;
    EXPECT_EQ(isLarge, group.area > 100.0f);
    if (isLarge) {
      EXPECT_EQ(group.count, 1u);
    }
  }
}

void expectEqual(const OccluderGroups& a, const OccluderGroups& b) {
  ASSERT_EQ(a.groups().size(), b.groups().size());
  ASSERT_EQ(a.triangles().size(), b.triangles().size());
  for (size_t i = 0; i < a.groups().size(); ++i) {
    const OccluderGroup &g = a.groups()[i], &h = b.groups()[i];
    ASSERT_TRUE(g.centre == h.centre && g.radius == h.radius && g.area == h.area &&
                g.facing == h.facing && g.facingMixed == h.facingMixed && g.object == h.object &&
                g.first == h.first && g.count == h.count)
        << i;
  }
  for (size_t i = 0; i < a.triangles().size(); ++i)
    ASSERT_TRUE(a.triangles()[i].triangle == b.triangles()[i].triangle &&
                a.triangles()[i].areaUpTo == b.triangles()[i].areaUpTo);
  for (uint32_t i = 0; i < a.objects(); ++i) EXPECT_EQ(a.areaOf(i), b.areaOf(i));
}

TEST(OccluderGroups, AfterChangesEqualNewOnes) {
  Scene scene = test::occluderBodies();
  const NodeId lamp = test::addRectangleLight(scene, vec3(0, 2, 0), vec2(1.0f), vec3(5.0f));
  RenderScene render = test::renderSceneOf(scene);
  OccluderGroups groups(render);
  const auto edit = [&](const std::function<void(Scene&)>& change, bool isNews = true) {
    const Scene before = scene;
    change(scene);
    EXPECT_EQ(groups.update(render, update(render, scene, compare(before, scene))), isNews);
    expectEqual(groups, OccluderGroups(render));
  };
  edit([](Scene& s) { s.nodes[0].local.scale = vec3(2, 1, 1); });
  edit([](Scene& s) { s.materials[1].transmission = 0.0f; });
  edit([](Scene& s) { s.nodes[1].visible = false; });
  edit([](Scene& s) { s.nodes[4].local.translation.y = -1.0f; });
  edit([](Scene& s) { s.nodes[1].visible = true; });
  edit([](Scene& s) { s.materials[1].transmission = 1.0f; });
  edit([](Scene& s) { s.materials[0].baseColor = vec4(0.1f); }, false);
  edit([lamp](Scene& s) { s.find(lamp)->area->size = vec2(3.0f, 0.2f); });
  edit([](Scene& s) { test::addMesh(s, s.meshes[1], vec3(0, 4, 0)); });
  edit([](Scene& s) { s.nodes.pop_back(); });
}

}  // namespace
}  // namespace lamplighter
