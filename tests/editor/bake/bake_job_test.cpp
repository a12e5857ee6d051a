// Baking to files: at once, in shards, and resumed after a cancellation.
#include "editor/bake/bake_job.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include <gtest/gtest.h>

#include "renderer/base/error.h"
#include "renderer/base/threads.h"
#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/surface.h"
#include "tests/support/render.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

std::string bytesOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

class BakeJob : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("lamplighter_bake_" + std::string(info->name()));
    fs::remove_all(folder_);
    const int white = test::addMaterial(scene_, vec3(0.8f));
    const int red = test::addMaterial(scene_, vec3(0.8f, 0.2f, 0.1f));
    test::addMesh(scene_, test::roomMesh(vec3(4, 3, 4), white), vec3(0, 1.5f, 0));
    test::addMesh(scene_, test::boxMesh(vec3(1), red), vec3(0.7f, 0.5f, -0.5f));
    test::addMesh(scene_, test::boxMesh(vec3(0.6f, 1.6f, 0.6f), white), vec3(-0.9f, 0.8f, 0.2f));
    test::addRectangleLight(scene_, vec3(0, 2.8f, 0), vec2(1), vec3(8));
  }
  void TearDown() override { fs::remove_all(folder_); }

  BakeJobOptions options(const std::string& name) const {
    BakeJobOptions o;
    o.atlas = {16.0f, 256};
    o.light.counts = {64, 0.5f, 1, 1};
    o.output = folder_ / name;
    o.name = "room";
    return o;
  }
  // The bytes of the pages and of the scene, by file name.
  std::map<std::string, std::string> filesOf(const std::string& name) const {
    std::map<std::string, std::string> files;
    for (const fs::directory_entry& e : fs::directory_iterator(folder_ / name))
      if (e.is_regular_file()) files[e.path().filename()] = bytesOf(e.path());
    return files;
  }

  Scene scene_;
  fs::path folder_;
};

TEST_F(BakeJob, MergedShardsEqualTheWholeBakeBitForBit) {
  const BakeReport whole = bake(scene_, options("whole"), {});
  EXPECT_TRUE(whole.isWhole);
  EXPECT_EQ(whole.found, whole.tiles);
  EXPECT_GT(whole.tiles, 6);
  BakeJobOptions part = options("parts");
  part.shards = 3;
  int found = 0;
  for (const int shard : {2, 3, 1}) {
    part.shard = shard;
    const BakeReport r = bake(scene_, part, {});
    EXPECT_FALSE(r.isWhole);
    found += r.found;
    BakeJobOptions merge = options("parts");
    merge.mergeOnly = true;
    if (shard != 1) {
      EXPECT_THROW(bake(scene_, merge, {}), InputError) << "tiles are missing";
    }
  }
  EXPECT_EQ(found, whole.tiles);
  BakeJobOptions merge = options("parts");
  merge.mergeOnly = true;
  EXPECT_EQ(bake(scene_, merge, {}).found, 0);
  EXPECT_EQ(filesOf("whole"), filesOf("parts"));
  EXPECT_FALSE(fs::exists(folder_ / "parts" / "parts")) << "merging deletes the parts";
}

TEST_F(BakeJob, ResumesAfterACancellation) {
  const BakeReport whole = bake(scene_, options("whole"), {});
  const BakeReport first = bake(scene_, options("again"), [](int done, int) { return done < 3; });
  EXPECT_TRUE(first.isCancelled);
  EXPECT_EQ(first.found, 3);
  EXPECT_TRUE(filesOf("again").empty());
  // A truncated tile is computed again.
  for (const fs::directory_entry& e : fs::recursive_directory_iterator(folder_ / "again")) {
    if (!e.is_regular_file()) continue;
    fs::resize_file(e.path(), fs::file_size(e.path()) / 2);
    break;
  }
  const BakeReport second = bake(scene_, options("again"), {});
  EXPECT_EQ(second.taken, 2);
  EXPECT_EQ(second.found, whole.tiles - 2);
  EXPECT_EQ(filesOf("whole"), filesOf("again"));
}

TEST_F(BakeJob, MergedShardsOfMeshesEqualTheWholeBakeBitForBit) {
  const auto ofMeshes = [&](const std::string& name) {
    BakeJobOptions o = options(name);
    o.light.method = BakeMethod::meshes;
    o.light.surface.mask = 32;
    return o;
  };
  EXPECT_TRUE(bake(scene_, ofMeshes("whole"), {}).isWhole);
  for (const int shard : {2, 1}) {
    BakeJobOptions part = ofMeshes("parts");
    part.shards = 2;
    part.shard = shard;
    bake(scene_, part, {});
  }
  EXPECT_EQ(bake(scene_, ofMeshes("parts"), {}).found, 0);
  EXPECT_EQ(filesOf("whole"), filesOf("parts"));
  // Other elements are another bake.
  BakeJobOptions other = ofMeshes("parts");
  other.light.surface.edge = 0.5f;
  other.shards = 2;
  other.shard = 1;
  EXPECT_EQ(bake(scene_, other, {}).taken, 0);
}

TEST_F(BakeJob, MergedShardsOfGatheredLightAndVisibilityEqualTheWholeBakeBitForBit) {
  const auto ofLinks = [&](const std::string& name) {
    BakeJobOptions o = options(name);
    o.atlas.texelsPerMetre = 8.0f;
    o.light.method = BakeMethod::links;
    o.light.surface.mask = 32;
    o.light.texels.texel = 0.5f;
    o.light.texels.map = {DepthMapKind::octahedral, 16};
    o.light.texels.visibility = TexelVisibility::rays;
    o.visibility = o.light.texels;
    return o;
  };
  {
    const ThreadLimit one(1);
    const BakeReport whole = bake(scene_, ofLinks("whole"), {});
    EXPECT_TRUE(whole.isWhole);
    EXPECT_EQ(std::ranges::count(whole.files, folder_ / "whole" / "room-visibility.bin"), 1);
  }
  for (const int shard : {2, 1}) {
    BakeJobOptions part = ofLinks("parts");
    part.shards = 2;
    part.shard = shard;
    bake(scene_, part, {});
  }
  EXPECT_FALSE(fs::exists(folder_ / "parts" / "room-visibility.bin"));
  // Another error of links, or visibility, is another bake; more files are not.
  for (const bool isFiner : {true, false}) {
    BakeJobOptions other = ofLinks("parts");
    isFiner ? void(other.light.texels.linkError = 0.002f)
            : void(other.light.texels.visibility = TexelVisibility::stored);
    other.shards = 2;
    other.shard = 1;
    EXPECT_EQ(bake(scene_, other, [](int, int) { return false; }).taken, 0);
  }
  BakeJobOptions merge = ofLinks("parts");
  merge.mergeOnly = true;
  EXPECT_EQ(bake(scene_, merge, {}).found, 0);
  EXPECT_EQ(filesOf("whole"), filesOf("parts"));
  EXPECT_NE(bytesOf(folder_ / "whole" / "room-light.json")
                .find("\"visibility\": \"room-visibility.bin\""),
            std::string::npos);
}

TEST_F(BakeJob, SaysWhenTexelsOfVisibilityAreLargerThanWanted) {
  BakeJobOptions o = options("coarse");
  o.light.counts.total = 1;
  o.visibility = TexelRadiosityOptions();
  o.visibility->memory = size_t{1} << 20;
  const BakeReport report = bake(scene_, o, {});
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("visibility has texels of"), std::string::npos);
}

TEST_F(BakeJob, TilesOfAnotherSceneAreNotReused) {
  bake(scene_, options("one"), [](int done, int) { return done < 3; });
  scene_.nodes[1].local.translation.x += 0.1f;
  EXPECT_EQ(bake(scene_, options("one"), {}).taken, 0);
}

TEST_F(BakeJob, RefusesASceneWithoutSurfaces) {
  EXPECT_THROW(bake(Scene(), options("empty"), {}), InputError);
}

// Renders the baked scene as a game would (albedo/π × light map, looked up by the second UV set of
// the copy) and compares it with the path tracer.
TEST_F(BakeJob, TheBakedSceneMatchesThePathTracer) {
  BakeJobOptions o = options("shown");
  o.atlas = {16.0f, 256};
  o.light.method = BakeMethod::reference;
  o.light.paths.bounces = 2;
  o.light.samples = 64;
  const BakeReport report = bake(scene_, o, {});
  ASSERT_EQ(report.pages, 1);
  const Scene copy = loadGltf(o.output / "room.gltf").scene;
  Texture page;
  const Image light = readImage(o.output / "room-light-0.exr");
  RenderScene render;
  update(render, copy, SceneChanges::all());
  const RayCaster rays(render);
  const View view = test::lookAt(vec3(1.6f, 1.7f, 1.8f), vec3(-0.2f, 0.9f, -0.3f), 96, 72, 0.9f);
  const Image reference = test::renderReference(scene_, view, 256, 2);
  Image shown(view.width, view.height);
  const auto texel = [&](int x, int y) {
    return light.at(std::clamp(x, 0, light.width - 1), std::clamp(y, 0, light.height - 1));
  };
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const vec3 direction =
          view.rayDirection(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const Hit hit = rays.intersect({view.eye, 0.0f, direction}, Surfaces::seen);
      ASSERT_TRUE(hit);
      const Surface s = surfaceAt(render, hit.object, hit.triangle, hit.u, hit.v);
      const uint32_t first = render.objects[hit.object].firstIndex + 3 * hit.triangle;
      const auto uv = [&](uint32_t k) { return render.uv1[render.indices[first + k]]; };
      const vec2 at = ((1.0f - hit.u - hit.v) * uv(0) + hit.u * uv(1) + hit.v * uv(2)) *
                          static_cast<float>(light.width) -
                      0.5f;
      const vec2 floor = glm::floor(at), t = at - floor;
      const int fx = static_cast<int>(floor.x), fy = static_cast<int>(floor.y);
      const vec3 e = glm::mix(glm::mix(texel(fx, fy), texel(fx + 1, fy), t.x),
                              glm::mix(texel(fx, fy + 1), texel(fx + 1, fy + 1), t.x), t.y);
      shown.at(x, y) = s.albedo / kPi * e + s.emission;
    }
  }
  const Metrics m = compareImages(shown, reference);
  RecordProperty("relRmse", std::to_string(m.relRmse));
  EXPECT_LT(m.relRmse, 0.12);
  EXPECT_NEAR(m.bias, 1.0, 0.02);
}

}  // namespace
}  // namespace lamplighter
