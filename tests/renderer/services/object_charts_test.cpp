// Charts of objects: shared by instances, cached by content, and never read from a damaged file.
#include "renderer/services/object_charts.h"

#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

class ObjectChartsTest : public testing::Test {
 protected:
  ObjectChartsTest()
      : folder_(fs::path(testing::TempDir()) /
                (std::string("object_charts_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    const auto box = test::boxMesh(vec3(1, 2, 3));
    first_ = test::addMesh(scene_, box);
    second_ = test::addMesh(scene_, box, vec3(5, 0, 0));
    scene_.find(second_)->mesh = scene_.find(first_)->mesh;
    scene_.find(second_)->local.rotation = glm::normalize(quat(0.1f, 0.5f, -0.2f, 0.7f));
    update(render_, scene_, SceneChanges::all());
  }
  ~ObjectChartsTest() override { fs::remove_all(folder_); }

  RenderSceneChanges change(const std::function<void(Scene&)>& edit) {
    const Scene before = scene_;
    edit(scene_);
    return update(render_, scene_, compare(before, scene_));
  }

  fs::path folder_;
  Scene scene_;
  NodeId first_ = 0, second_ = 0;
  RenderScene render_;
};

TEST_F(ObjectChartsTest, InstancesShareALayout) {
  ObjectCharts charts({});
  const auto objects = charts.find(render_, 16.0f);
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(charts.computed(), 1u);
  EXPECT_EQ(objects[0].atlas, objects[1].atlas);
  // A vertex has the same texel in both instances.
  for (uint32_t corner = 0; corner < 3; ++corner) {
    vec2 texels[2];
    for (uint32_t i = 0; i < 2; ++i)
      texels[i] = objects[i].texelsOf(
          4, render_.positions[render_.indices[render_.objects[i].firstIndex + 12 + corner]]);
    EXPECT_NEAR(texels[0].x, texels[1].x, 1e-3f);
    EXPECT_NEAR(texels[0].y, texels[1].y, 1e-3f);
  }
}

TEST_F(ObjectChartsTest, OnlyWhatChangesTheLayoutMakesAnother) {
  ObjectCharts charts({});
  charts.find(render_, 16.0f);
  charts.outdate(change([&](Scene& s) {
    s.find(first_)->local.translation.y = 4.0f;
    s.find(first_)->local.rotation = glm::normalize(quat(0.3f, -0.5f, 0.2f, 0.1f));
  }));
  EXPECT_EQ(charts.find(render_, 16.0f)[0].space.translation.y, 4.0f);
  EXPECT_EQ(charts.computed(), 1u);
  charts.outdate(change([&](Scene& s) { s.find(first_)->local.scale = vec3(2.0f); }));
  const auto objects = charts.find(render_, 16.0f);
  EXPECT_EQ(charts.computed(), 2u);
  EXPECT_GT(objects[0].atlas->size.x, objects[1].atlas->size.x) << "texels are of one size";
  charts.find(render_, 8.0f);
  EXPECT_EQ(charts.computed(), 3u) << "at half the density the larger box has the layout that the "
                                      "smaller one had";
}

TEST_F(ObjectChartsTest, AreaLightsAndFlattenedObjectsHaveNone) {
  test::addRectangleLight(scene_, vec3(0, 4, 0), vec2(1.0f), vec3(1.0f));
  scene_.find(second_)->local.scale.y = 0.0f;
  update(render_, scene_, SceneChanges::all());
  ObjectCharts charts({});
  const auto objects = charts.find(render_, 16.0f);
  ASSERT_EQ(objects.size(), 3u);
  EXPECT_NE(objects[0].atlas, nullptr);
  EXPECT_EQ(objects[1].atlas, nullptr);
  EXPECT_EQ(objects[2].atlas, nullptr);
}

TEST_F(ObjectChartsTest, AFileIsReusedAndADamagedOneIsReplaced) {
  std::vector<uint8_t> expected;
  fs::path file;
  {
    ObjectCharts charts(folder_);
    expected = bytesOf(*charts.find(render_, 16.0f)[0].atlas);
    file = charts.fileOf(0);
    EXPECT_EQ(charts.computed(), 1u);
  }
  const auto find = [&](size_t computed) {
    ObjectCharts charts(folder_);
    EXPECT_EQ(bytesOf(*charts.find(render_, 16.0f)[0].atlas), expected);
    EXPECT_EQ(charts.computed(), computed);
  };
  find(0);
  std::ifstream in(file, std::ios::binary);
  std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
  for (const size_t at : {size_t{3}, size_t{20}, size_t{50}, bytes.size() - 1}) {
    std::vector<char> bad = bytes;
    bad[at] = static_cast<char>(bad[at] ^ 1);
    std::ofstream(file, std::ios::binary)
        .write(bad.data(), static_cast<std::streamsize>(bad.size()));
    find(1);
    find(0);
  }
}

TEST(MeshAtlas, IgnoresBytesOfAnotherMesh) {
  Scene scene;
  test::addMesh(scene, test::sphereMesh(1.0f, 8));
  const RenderScene render = test::renderSceneOf(scene);
  const MeshAtlas atlas = makeMeshAtlas(render.positions, render.indices, 16.0f);
  const std::vector<uint8_t> bytes = bytesOf(atlas);
  const size_t triangles = render.triangleCount();
  ASSERT_TRUE(meshAtlasOf(bytes, triangles).has_value());
  EXPECT_EQ(bytesOf(*meshAtlasOf(bytes, triangles)), bytes);
  EXPECT_FALSE(meshAtlasOf(bytes, triangles - 1).has_value());
  for (size_t length = 0; length < bytes.size(); length += 7)
    EXPECT_FALSE(meshAtlasOf(std::span(bytes).first(length), triangles).has_value());
}

TEST(MeshAtlas, NoTexelBelongsToTwoCharts) {
  Scene scene;
  test::addMesh(scene, test::sphereMesh(1.0f, 16));
  const RenderScene render = test::renderSceneOf(scene);
  const MeshAtlas atlas = makeMeshAtlas(render.positions, render.indices, 16.0f);
  std::vector<int> owner(static_cast<size_t>(atlas.size.x) * static_cast<size_t>(atlas.size.y),
                         kNone);
  for (size_t i = 0; i < atlas.charts.size(); ++i) {
    const PlacedChart& c = atlas.charts[i];
    for (int y = c.at.y; y < c.at.y + c.size.y; ++y)
      for (int x = c.at.x; x < c.at.x + c.size.x; ++x) {
        int& o = owner[static_cast<size_t>(y * atlas.size.x + x)];
        EXPECT_EQ(o, kNone);
        o = static_cast<int>(i);
      }
  }
  for (const int chart : atlas.chartOfTriangle) EXPECT_NE(chart, kNone);
}

}  // namespace
}  // namespace lamplighter
