// `lamplighter bake --probes`.
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "renderer/image/image_io.h"
#include "tests/support/folders.h"
#include "tests/support/process.h"
#include "tests/support/scenes/gltf_files.h"

namespace lamplighter::test {
namespace {

const std::string kRoom = (sourceFolder() / "assets/scenes/cornell_style.gltf").string();

class BakeProbes : public testing::Test {
 protected:
  ProcessResult run(const std::vector<std::string>& more, const std::string& into = "baked") const {
    std::vector<std::string> all{"bake", kRoom, "-o", (folder_.path() / into).string()};
    all.insert(all.end(), more.begin(), more.end());
    return runLamplighter(all);
  }
  std::filesystem::path file(const std::string& ending, const std::string& into = "baked") const {
    return folder_.path() / into / ("cornell_style_probes" + ending);
  }
  TemporaryFolder folder_;
};

const std::vector<std::string> kSmall{"--probes",        "--no-maps", "--probe-spp", "16",
                                      "--probe-spacing", "0.5",       "--bounces",   "2"};

std::vector<std::string> smallWith(const std::vector<std::string>& more) {
  std::vector<std::string> all = kSmall;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST_F(BakeProbes, WritesTextAndVolumeWithTheSameNumbers) {
  const ProcessResult r = run(kSmall);
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.out.find("0.5 m apart"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find(file(".exr").string()), std::string::npos) << r.out;
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "baked/cornell_style.gltf"));
  const auto j = nlohmann::json::parse(readText(file(".json")));
  EXPECT_EQ(j["volume"], "cornell_style_probes.exr");
  EXPECT_EQ(j["bounces"], 2);
  EXPECT_EQ(j["samples"], 16);
  const Image volume = readImage(file(".exr"));
  const int x = j["size"][0], y = j["size"][1], z = j["size"][2];
  ASSERT_EQ(volume.width, 9 * x);
  ASSERT_EQ(volume.height, y * z);
  size_t i = 0, lit = 0;
  for (int row = 0; row < y * z; ++row)
    for (int column = 0; column < x; ++column, ++i) {
      const auto& probe = j["probes"].at(i);
      lit += probe["valid"].get<bool>();
      EXPECT_GT(probe["coefficients"][0].get<float>(), 0.0f) << "filled in, too";
      for (size_t c = 0; c < 27; ++c)
        EXPECT_EQ(volume.at(static_cast<int>(c / 3) * x + column, row)[static_cast<int>(c % 3)],
                  probe["coefficients"][c].get<float>());
    }
  EXPECT_EQ(i, j["probes"].size());
  EXPECT_GT(lit, 20u);
}

TEST_F(BakeProbes, IsTheSameWithAnyNumberOfThreads) {
  ASSERT_EQ(run(smallWith({"--threads", "1"}), "one").code, 0);
  ASSERT_EQ(run(smallWith({"--threads", "2"}), "two").code, 0);
  EXPECT_EQ(readText(file(".json", "one")), readText(file(".json", "two")));
  EXPECT_EQ(readText(file(".exr", "one")), readText(file(".exr", "two")));
}

TEST_F(BakeProbes, GoesAlongWithMapsOrVertexColours) {
  const ProcessResult maps =
      run({"--density", "2", "--page", "256", "--vpls", "32", "--probes", "--probe-spp", "4"});
  EXPECT_EQ(maps.code, 0) << maps.err;
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "baked/cornell_style-light-0.exr"));
  EXPECT_TRUE(std::filesystem::exists(file(".exr")));
  const ProcessResult colours =
      run({"--vertex-colours", "--method", "multi_mesh", "--set", "gather_rays=16",
           "--shortest-edge", "1", "--probes", "--probe-spp", "4"},
          "colours");
  EXPECT_EQ(colours.code, 0) << colours.err;
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "colours/cornell_style.gltf"));
  EXPECT_TRUE(std::filesystem::exists(file(".json", "colours")));
}

TEST_F(BakeProbes, IsCoarserInsteadOfTooLarge) {
  const ProcessResult r = run(smallWith({"--most-probes", "20"}));
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.err.find("instead of 0.5 m"), std::string::npos) << r.err;
  EXPECT_LE(nlohmann::json::parse(readText(file(".json")))["probes"].size(), 20u);
}

TEST_F(BakeProbes, RefusesInvalidOptionsInOneLine) {
  for (const std::vector<std::string>& bad : {smallWith({"--probe-spacing", "0"}),
                                              smallWith({"--probe-spacing", "wide"}),
                                              smallWith({"--probe-padding", "-1"}),
                                              smallWith({"--probe-padding", "nan"}),
                                              smallWith({"--probe-spp", "0"}),
                                              smallWith({"--most-probes", "1"}),
                                              smallWith({"--shard", "1/2"}),
                                              smallWith({"--vertex-colours"}),
                                              smallWith({"--density", "2"}),
                                              smallWith({"--visibility"}),
                                              std::vector<std::string>{"--no-maps"},
                                              {"--probe-spp", "16"},
                                              {"--probe-padding", "1"}}) {
    const ProcessResult r = run(bad);
    EXPECT_EQ(r.code, 2) << bad.back();
    EXPECT_EQ(lines(r.err), 1) << r.err;
  }
  // Where the file should be is a folder: found before anything is baked, nothing is written.
  std::filesystem::create_directories(file(".exr", "blocked"));
  const ProcessResult r = run(kSmall, "blocked");
  EXPECT_EQ(r.code, 2);
  EXPECT_EQ(lines(r.err), 1) << r.err;
  EXPECT_FALSE(std::filesystem::exists(file(".json", "blocked")));
}

}  // namespace
}  // namespace lamplighter::test
