// The command `lamplighter converge`.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "renderer/image/image_io.h"
#include "tests/support/folders.h"
#include "tests/support/process.h"

namespace lamplighter::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class ConvergeCommand : public testing::Test {
 protected:
  static constexpr const char* kSize = "48x32";
  const std::string from_ = (sourceFolder() / "assets/scenes/cornell_style.gltf").string();

  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("lamplighter_converge_cli_" + std::string(info->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  // A copy of the scene after `edit` of its nodes.
  template <typename Edit>
  std::string write(const std::string& name, Edit edit) const {
    json scene = json::parse(std::ifstream(from_));
    for (json& node : scene["nodes"]) edit(node);
    std::ofstream(file(name)) << scene;
    return file(name);
  }
  // The lamp stands at the left, lower.
  std::string writeMoved() const {
    return write("moved.gltf", [](json& node) {
      if (node["name"] == "lamp") node["translation"] = {-0.6, 1.2, 0.5};
    });
  }
  std::string renderReference(const std::string& scene) const {
    const std::string picture = file("reference.exr");
    const ProcessResult r = runLamplighter({"render", scene, "-o", picture, "--method", "reference",
                                            "--spp", "64", "--bounces", "2", "--size", kSize});
    EXPECT_EQ(r.code, 0) << r.err;
    return picture;
  }
  // Of the floor. Pixels at the border of the lamp would dominate the error of so small a picture.
  std::string writeMask() const {
    Image mask(48, 32);
    for (int y = 24; y < 32; ++y)
      for (int x = 12; x < 36; ++x) mask.at(x, y) = vec3(1.0f);
    writeExr(mask, file("mask.exr"));
    return file("mask.exr");
  }
  ProcessResult run(std::vector<std::string> more) const {
    std::vector<std::string> all{"converge", from_, "--backend", "cpu"};
    all.insert(all.end(), more.begin(), more.end());
    return runLamplighter(all);
  }
  json measured(std::vector<std::string> more) const {
    more.insert(more.end(), {"--size", kSize, "--json"});
    const ProcessResult r = run(more);
    EXPECT_EQ(r.code, 0) << r.err;
    return json::parse(r.out, nullptr, false);
  }
  void expectOneError(const ProcessResult& r, const std::string& part) const {
    EXPECT_EQ(r.code, 2);
    EXPECT_EQ(lines(r.err), 1) << r.err;
    EXPECT_NE(r.err.find(part), std::string::npos) << r.err;
    EXPECT_EQ(r.out, "");
  }

  fs::path folder_;
};

TEST_F(ConvergeCommand, TheErrorFallsAfterAMove) {
  const std::string to = writeMoved(), reference = renderReference(to);
  // Few light samples per frame, so that the first frames show little of the edit.
  const json j =
      measured({to, "--against", reference, "--mask", writeMask(), "--set", "updates=16"});
  const double start = j["curve"].front()["error"], end = j["end"];
  EXPECT_GT(start, 0.5);
  EXPECT_LT(end, 0.3);
  EXPECT_EQ(j["curve"].back()["error"], j["end"]);
  EXPECT_GT(j["frames"], 3);
  for (size_t i = 1; i < j["curve"].size(); ++i)
    EXPECT_GT(j["curve"][i]["seconds"], j["curve"][i - 1]["seconds"]);
  EXPECT_EQ(j["first_frame"], j["curve"].front()["seconds"]);
  EXPECT_EQ(j["settled"], j["curve"].back()["seconds"]);
  EXPECT_GT(j["opening"]["first_frame"], 0.0);
  EXPECT_GT(j["opening"]["settled"], j["opening"]["first_frame"]);
  EXPECT_FALSE(j["stages"].empty());
  for (const char* key :
       {"from", "to", "against", "mask", "method", "backend", "device", "to_10", "to_5"})
    EXPECT_TRUE(j.contains(key)) << key;
}

TEST_F(ConvergeCommand, WithoutTheOtherStateOpeningIsMeasured) {
  const json j = measured({"--against", renderReference(from_), "--mask", writeMask()});
  EXPECT_TRUE(j["to"].is_null());
  EXPECT_EQ(j["first_frame"], j["opening"]["first_frame"]);
  EXPECT_EQ(j["settled"], j["opening"]["settled"]);
  EXPECT_LT(j["end"], 0.3);
}

TEST_F(ConvergeCommand, MeasuresEveryMethod) {
  const std::string to = writeMoved(), reference = renderReference(to);
  const json paths = measured({to, "--against", reference, "--method", "reference", "--spp", "64",
                               "--set", "samples_per_frame=8"});
  EXPECT_EQ(paths["frames"], 8);
  EXPECT_LE(paths["to_10"], paths["to_5"]);
  EXPECT_LE(paths["to_5"], paths["settled"]);
  EXPECT_LT(paths["end"], 1e-6) << "the same paths as the reference";
  const json open = measured({to, "--against", reference, "--method", "ambient_occlusion"});
  EXPECT_TRUE(open["to_10"].is_null());
}

TEST_F(ConvergeCommand, StopsAtATimeLimit) {
  const json j = measured({"--against", renderReference(from_), "--method", "reference", "--set",
                           "samples_per_pixel=1000000", "--seconds", "0.2"});
  EXPECT_TRUE(j["settled"].is_null());
  EXPECT_GE(j["curve"].back()["seconds"], 0.2);
}

TEST_F(ConvergeCommand, ComparesThePixelsOfTheMask) {
  const std::string reference = renderReference(from_);
  const auto end = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--against", reference, "--method", "reference", "--spp", "4"});
    return measured(more)["end"];
  };
  EXPECT_NE(end({"--mask", writeMask()}), end({}));
}

TEST_F(ConvergeCommand, PrintsATableAndASummary) {
  const ProcessResult r =
      run({"--against", renderReference(from_), "--vpls", "32", "--size", kSize});
  EXPECT_EQ(r.code, 0) << r.err;
  for (const char* word :
       {"seconds", "error", "opening", "first_frame", "to_10", "to_5", "settled", "end"})
    EXPECT_NE(r.out.find(word), std::string::npos) << word << "\n" << r.out;
}

TEST_F(ConvergeCommand, RefusesBadInputInOneLine) {
  const std::string to = writeMoved(), picture = file("grey.exr");
  writeExr(Image(48, 32, vec3(0.5f)), picture);
  writeExr(Image(8, 8, vec3(1.0f)), file("small.exr"));
  writeExr(Image(48, 32), file("black.exr"));
  const auto refuses = [&](std::vector<std::string> more, const std::string& part) {
    more.insert(more.end(), {"--size", kSize});
    expectOneError(run(more), part);
  };
  refuses({to}, "--against");
  refuses({to, "--against", file("absent.exr")}, "absent.exr");
  refuses({to, "--against", to}, "moved.gltf");
  refuses({to, "--against", file("small.exr")}, "8x8");
  refuses({to, "--against", picture, "--mask", file("small.exr")}, "small.exr");
  refuses({to, "--against", picture, "--mask", file("black.exr")}, "no pixel");
  refuses({to, "--against", file("black.exr")}, "black");
  refuses({file("absent.glb"), "--against", picture}, "absent.glb");
  refuses({picture, "--against", picture}, "grey.exr");
  refuses({from_, "--against", picture}, "something moved");
  const std::string other = write(
      "other.gltf", [](json& node) { node["name"] = "other " + node["name"].get<std::string>(); });
  refuses({other, "--against", picture}, "no node has the name");
  refuses({to, "--against", picture, "--camera", "nobody"}, "nobody");
  refuses({to, "--against", picture, "--method", "magic"}, "magic");
  refuses({to, "--against", picture, "--set", "colour=red"}, "colour");
  refuses({to, "--against", picture, "--seconds", "0"}, "--seconds");
  expectOneError(run({to, "--against", picture}), "--size 48x32");
}

}  // namespace
}  // namespace lamplighter::test
