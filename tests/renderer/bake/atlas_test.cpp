// Placement of charts on pages, and the surface points of texels.
#include "renderer/bake/atlas.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "renderer/bake/bake_points.h"
#include "renderer/bake/page_dilation.h"
#include "renderer/bake/second_uvs.h"
#include "renderer/base/error.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

Scene oneMesh(std::shared_ptr<const Mesh> mesh) {
  Scene scene;
  test::addMesh(scene, std::move(mesh));
  return scene;
}

TEST(Atlas, ChartsOfANodeShareAPageAndNoTexelBelongsToTwoCharts) {
  Scene scene;
  for (int i = 0; i < 12; ++i)
    test::addMesh(scene, test::boxMesh(vec3(1, 2, 1.5f)), vec3(3 * i, 0, 0));
  const RenderScene render = test::renderSceneOf(scene);
  const LightMapAtlas atlas = makeAtlas(render, {16.0f, 128});
  EXPECT_GT(atlas.pages, 1);
  EXPECT_TRUE(atlas.coarser.empty());
  std::map<uint32_t, int> pageOf;
  for (const ObjectChart& c : atlas.charts) {
    EXPECT_EQ(pageOf.emplace(c.object, c.page).first->second, c.page);
    EXPECT_FLOAT_EQ(c.texelsPerMetre, 16.0f);
  }
  for (int page = 0; page < atlas.pages; ++page) {
    std::map<std::pair<int, int>, uint32_t> owner;
    for (const BakePoint& p : bakePoints(render, atlas, page)) {
      EXPECT_LT(p.x, 128);
      EXPECT_LT(p.y, 128);
      EXPECT_EQ(owner.emplace(std::pair(p.x, p.y), p.object).first->second, p.object);
    }
  }
}

TEST(Atlas, ObjectsTooLargeForAPageGetCoarserTexels) {
  const Scene scene = oneMesh(test::squareMesh(100.0f));
  const LightMapAtlas atlas = makeAtlas(test::renderSceneOf(scene), {8.0f, 256});
  ASSERT_EQ(atlas.coarser.size(), 1u);
  EXPECT_EQ(atlas.coarser[0].node, scene.nodes[0].id);
  EXPECT_LT(atlas.charts[0].size.x, 257);
  EXPECT_GT(atlas.charts[0].size.x, 128);
}

TEST(Atlas, AreaLightsAndPanesHaveNoCharts) {
  Scene scene;
  const int glass = test::addMaterial(scene, vec3(1));
  scene.materials[static_cast<size_t>(glass)].transmission = 1.0f;
  test::addMesh(scene, test::squareMesh(1.0f, glass));
  test::addRectangleLight(scene, vec3(0, 2, 0), vec2(1), vec3(1));
  EXPECT_TRUE(makeAtlas(test::renderSceneOf(scene), {}).charts.empty());
}

TEST(BakePoints, LieOnTheSurfaceUnderTheirTexels) {
  const RenderScene render = test::renderSceneOf(oneMesh(test::squareMesh(2.0f)));
  const LightMapAtlas atlas = makeAtlas(render, {8.0f, 64});
  ASSERT_EQ(atlas.charts.size(), 1u);
  const ObjectChart& c = atlas.charts[0];
  int on = 0;
  for (const BakePoint& p : bakePoints(render, atlas, 0)) {
    const uint32_t* i = &render.indices[3 * p.triangle];
    const vec3 at = (1.0f - p.u - p.v) * render.positions[i[0]] + p.u * render.positions[i[1]] +
                    p.v * render.positions[i[2]];
    const vec2 texels = c.texelsOf(at);
    const vec2 off = texels - vec2(p.x, p.y);
    const bool isOn = std::abs(off.x - 0.5f) < 0.3f && std::abs(off.y - 0.5f) < 0.3f;
    on += isOn;
    // A texel in the gutter uses the nearest point of the square.
    if (!isOn) {
      EXPECT_LT(glm::length(off - 0.5f), 1.0f + kGutter * 1.5f);
    }
  }
  EXPECT_EQ(on, 4 * 16 * 16) << "a point in each quarter of 16 x 16 texels";
}

TEST(PageFill, TakesTheMeanOfNeighbours) {
  Image page(8, 8, vec3(-1.0f));
  page.at(0, 0) = vec3(2.0f);
  page.at(2, 0) = vec3(4.0f);
  fillUnknown(page);
  EXPECT_EQ(page.at(0, 0), vec3(2.0f));
  EXPECT_EQ(page.at(1, 0), vec3(3.0f));
  EXPECT_EQ(page.at(0, 1), vec3(2.0f));
  for (const vec3& p : page.pixels) EXPECT_GE(p.r, 0.0f);
}

TEST(SecondUvs, InstancesGetMeshesOfTheirOwn) {
  Scene scene;
  const auto box = test::boxMesh(vec3(1));
  test::addMesh(scene, box);
  test::addMesh(scene, box, vec3(4, 0, 0));
  scene.nodes[1].mesh = scene.nodes[0].mesh;
  const RenderScene render = test::renderSceneOf(scene);
  const LightMapAtlas atlas = makeAtlas(render, {8.0f, 128});
  const Scene out = withLightMapUvs(scene, render, atlas);
  ASSERT_NE(out.nodes[0].mesh, out.nodes[1].mesh);
  const auto uvs = [&](size_t node) {
    return out.meshes[static_cast<size_t>(out.nodes[node].mesh)]->primitives[0].uv1;
  };
  ASSERT_EQ(uvs(0).size(), 24u) << "corners of six sides";
  EXPECT_NE(uvs(0), uvs(1));
  for (const vec2& uv : uvs(0)) EXPECT_TRUE(uv.x > 0 && uv.y > 0 && uv.x < 1 && uv.y < 1);
}

TEST(SecondUvs, RefusesWhereATextureUsesThem) {
  Scene scene;
  const int brick = test::addMaterial(scene, vec3(1));
  scene.materials[0].baseColorTexture.texture = 0;
  scene.materials[0].baseColorTexture.texCoord = 1;
  Texture texture;
  texture.image = std::make_shared<Image8>(1, 1);
  scene.textures.push_back(texture);
  test::addMesh(scene, test::squareMesh(1.0f, brick));
  const RenderScene render = test::renderSceneOf(scene);
  EXPECT_THROW(withLightMapUvs(scene, render, makeAtlas(render, {})), InputError);
}

}  // namespace
}  // namespace lamplighter
