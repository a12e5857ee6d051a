// The command `lamplighter bake`.
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "docs/reference/visibility_reader.h"
#include "tests/support/folders.h"
#include "tests/support/process.h"

namespace lamplighter::test {
namespace {

namespace fs = std::filesystem;

const std::string kScene = (test::sourceFolder() / "assets/scenes/cornell_style.gltf").string();

class BakeCommand : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("lamplighter_bake_cli_" + std::string(info->name()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  ProcessResult run(std::vector<std::string> more) const {
    std::vector<std::string> all{"bake", kScene,   "-o",  folder_.string(), "--density",
                                 "2",    "--page", "256", "--vpls",         "32"};
    all.insert(all.end(), more.begin(), more.end());
    return runLamplighter(all);
  }
  fs::path folder_;
};

TEST_F(BakeCommand, WritesPagesAndACopyAndShowsProgress) {
  const ProcessResult r = run({});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.err.find("left"), std::string::npos) << r.err;
  EXPECT_TRUE(fs::exists(folder_ / "cornell_style-light-0.exr"));
  EXPECT_TRUE(fs::exists(folder_ / "cornell_style-light.json"));
  EXPECT_EQ(runLamplighter({"info", (folder_ / "cornell_style.gltf").string()}).code, 0);
}

TEST_F(BakeCommand, BakesFromLightOnSurfaces) {
  const ProcessResult r =
      run({"--method", "multi_mesh", "--set", "coarse_edge=0.5", "--set", "gather_rays=16"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(r.err.find("warning"), std::string::npos) << r.err;
  EXPECT_TRUE(fs::exists(folder_ / "cornell_style-light-0.exr"));
}

// The second bake into the folder takes nothing from the first.
TEST_F(BakeCommand, GlossyBouncesOfTheReferenceChangeTheLight) {
  const auto page = [&](const char* value) {
    const std::string scene =
        (test::sourceFolder() / "assets/scenes/cornell_specular.gltf").string();
    const ProcessResult r =
        runLamplighter({"bake", scene, "-o", folder_.string(), "--method", "reference", "--density",
                        "2", "--page", "256", "--set", "samples_per_pixel=2", "--set", value});
    EXPECT_EQ(r.code, 0) << r.err;
    std::ifstream in(folder_ / "cornell_specular-light-0.exr", std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string matt = page("glossy_bounces=false"), glossy = page("glossy_bounces=true");
  EXPECT_FALSE(matt.empty());
  EXPECT_NE(matt, glossy);
}

TEST_F(BakeCommand, GathersLightFromTexelsAndWritesVisibility) {
  const ProcessResult r = run({"--method", "surface_shadow_maps", "--visibility", "--set",
                               "texel=0.5", "--set", "depth_resolution=16"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(r.err.find("warning"), std::string::npos) << r.err;
  EXPECT_TRUE(fs::exists(folder_ / "cornell_style-light-0.exr"));
  const fs::path visibility = folder_ / "cornell_style-visibility.bin";
  EXPECT_NE(r.out.find(visibility.string()), std::string::npos) << r.out;
  const VisibilityReader reader(visibility.string());
  EXPECT_GT(reader.texels.size(), 50u);
  EXPECT_FALSE(reader.nodes.empty());
}

TEST_F(BakeCommand, WritesVertexColours) {
  const std::vector<std::string> command{
      "bake",     kScene,       "-o",    folder_.string(), "--vertex-colours",
      "--method", "multi_mesh", "--set", "gather_rays=16", "--shortest-edge",
      "1"};
  const ProcessResult r = runLamplighter(command);
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.out.find("triangles"), std::string::npos) << r.out;
  EXPECT_TRUE(fs::exists(folder_ / "cornell_style-light.json"));
  EXPECT_EQ(runLamplighter({"info", (folder_ / "cornell_style.gltf").string()}).code, 0);
  for (const std::vector<std::string>& bad : {std::vector<std::string>{"--exposure", "bright"},
                                              {"--contrast", "0"},
                                              {"--shortest-edge", "-1"},
                                              {"--shard", "1/2"},
                                              {"--visibility"},
                                              {"--density", "4"}}) {
    std::vector<std::string> all = command;
    all.insert(all.end(), bad.begin(), bad.end());
    const ProcessResult refused = runLamplighter(all);
    EXPECT_EQ(refused.code, 2) << bad[0];
    EXPECT_EQ(lines(refused.err), 1) << refused.err;
  }
  EXPECT_EQ(run({"--contrast", "0.1"}).code, 2) << "only of vertex colours";
  // A file where the folder should be.
  std::vector<std::string> blocked = command;
  blocked[3] = (folder_ / "cornell_style.gltf" / "below").string();
  const ProcessResult r2 = runLamplighter(blocked);
  EXPECT_EQ(r2.code, 2);
  EXPECT_EQ(lines(r2.err), 1) << r2.err;
}

TEST_F(BakeCommand, AShardWritesOnlyItsPart) {
  EXPECT_EQ(run({"--shard", "1/2"}).code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "cornell_style-light-0.exr"));
  const ProcessResult early = run({"--merge"});
  EXPECT_EQ(early.code, 2);
  EXPECT_NE(early.err.find("tiles are missing"), std::string::npos) << early.err;
  EXPECT_EQ(run({"--shard", "2/2"}).code, 0);
  EXPECT_EQ(run({"--merge"}).code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "cornell_style-light-0.exr"));
}

TEST_F(BakeCommand, RefusesInvalidOptionsInOneLine) {
  for (const std::vector<std::string>& bad :
       {std::vector<std::string>{"--shard", "0/2"},
        {"--shard", "3/2"},
        {"--shard", "two"},
        {"--density", "0"},
        {"--density", "nan"},
        {"--page", "7"},
        {"--method", "magic"},
        {"--method", "surface_shadow_maps", "--set", "mask=3"},
        {"--method", "surface_shadow_maps", "--set", "link_visibility=some"},
        {"--visibility", "--shard", "1/2"},
        {"--shard", "1/2", "--merge"}}) {
    const ProcessResult r = run(bad);
    EXPECT_EQ(r.code, 2) << bad[0];
    EXPECT_EQ(lines(r.err), 1) << r.err;
  }
  const ProcessResult same =
      runLamplighter({"bake", kScene, "-o", (test::sourceFolder() / "assets/scenes").string()});
  EXPECT_EQ(same.code, 2);
  EXPECT_NE(same.err.find("folder of the scene itself"), std::string::npos) << same.err;
}

}  // namespace
}  // namespace lamplighter::test
