// The command `lamplighter replay`: what its checks compare, and that they can fail. The recordings
// themselves have one test each (tests/CMakeLists.txt).
#include <filesystem>
#include <fstream>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/folders.h"
#include "tests/support/process.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;
using test::ProcessResult;
using test::runLamplighter;

const fs::path kRecordings = test::sourceFolder() / "tests/recordings";

std::string contents(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Replay : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("lamplighter_replay_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "recordings");
    // The relative paths of the recording need the folders of the repository.
    fs::create_directories(folder_ / "assets");
    fs::copy(test::sourceFolder() / "assets/scenes", folder_ / "assets/scenes",
             fs::copy_options::recursive);
    std::string text = contents(kRecordings / "place_light.jsonl");
    replace(text, "../../assets", "../assets");
    write(text);
    for (const auto& entry : fs::directory_iterator(kRecordings)) {
      if (entry.path().filename().string().starts_with("place_light.") &&
          entry.path().extension() == ".png")
        fs::copy(entry.path(), folder_ / "recordings");
    }
  }
  void TearDown() override { fs::remove_all(folder_); }

  static void replace(std::string& text, const std::string& what, const std::string& by) {
    const size_t at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), by);
  }
  fs::path recording() const { return folder_ / "recordings/place_light.jsonl"; }
  void write(const std::string& text) const { std::ofstream(recording()) << text; }
  ProcessResult replay(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"replay", recording().string(), "--headless", "-o",
                                       (folder_ / "out").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runLamplighter(arguments);
  }
  std::map<std::string, std::string> pictures() const {
    std::map<std::string, std::string> out;
    for (const auto& entry : fs::directory_iterator(folder_ / "out"))
      out[entry.path().filename().string()] = contents(entry.path());
    return out;
  }

  fs::path folder_;
};

TEST_F(Replay, GivesTheSameHashesAndBitsTwiceAndAtAnyNumberOfThreads) {
  std::map<std::string, std::string> first;
  std::string hashes;
  for (const char* threads : {"1", "2", "3"}) {
    const ProcessResult r = replay({"--threads", threads});
    ASSERT_EQ(r.code, 0) << r.err;
    std::map<std::string, std::string> seen = pictures();
    // Pictures of the whole window show times, which differ between runs.
    std::erase_if(seen,
                  [](const auto& p) { return p.first.find(".window.") != std::string::npos; });
    EXPECT_EQ(seen.size(), 6u);
    if (first.empty()) {
      first = seen;
      hashes = r.out;
    }
    EXPECT_TRUE(seen == first) << threads;
    EXPECT_EQ(r.out, hashes);
  }
}

// With the frame clock, the times that the window shows are equal, too.
TEST_F(Replay, GivesTheSameWindowPicturesTwiceWithTheFrameClock) {
  std::map<std::string, std::string> first;
  for (const char* threads : {"1", "2"}) {
    const ProcessResult r = replay({"--frame-clock", "--threads", threads});
    ASSERT_EQ(r.code, 0) << r.err;
    std::map<std::string, std::string> seen = pictures();
    std::erase_if(seen,
                  [](const auto& p) { return p.first.find(".window.") == std::string::npos; });
    if (seen.empty()) GTEST_SKIP() << "there are no pictures of the window without OpenGL";
    EXPECT_EQ(seen.size(), 6u);
    if (first.empty()) first = seen;
    EXPECT_TRUE(seen == first);
  }
}

// Skipped frames do not change the result.
TEST_F(Replay, GivesTheSamePicturesWithSkippedFrames) {
  const ProcessResult r = replay({"--frame-clock", "--check"});
  EXPECT_EQ(r.code, 0) << r.out << r.err;
}

TEST_F(Replay, FailsACheckWhereTheDocumentDiffers) {
  std::string text = contents(recording());
  const size_t at = text.find("\"document\":\"") + 12;
  text[at] = text[at] == '0' ? '1' : '0';
  write(text);
  const ProcessResult r = replay({"--check"});
  EXPECT_EQ(r.code, 1);
  EXPECT_NE(r.out.find("start: FAILED: the document is "), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("5 checks passed, 1 failed"), std::string::npos) << r.out;
}

TEST_F(Replay, FailsACheckWhereThePictureDiffersAndWritesTheDifference) {
  // Replaces the picture with the light by the one without it.
  fs::copy_file(folder_ / "recordings/place_light.start.png",
                folder_ / "recordings/place_light.moved.png", fs::copy_options::overwrite_existing);
  const ProcessResult r = replay({"--check"});
  EXPECT_EQ(r.code, 1);
  EXPECT_NE(r.out.find("moved: FAILED: "), std::string::npos) << r.out;
  EXPECT_TRUE(fs::exists(folder_ / "out/place_light.moved.png"));
  EXPECT_TRUE(fs::exists(folder_ / "out/place_light.moved.difference.png"));
}

TEST_F(Replay, FailsACheckWithoutABaselineAndWritesItOnRequest) {
  fs::remove(folder_ / "recordings/place_light.moved.png");
  EXPECT_EQ(replay({"--check"}).code, 1);
  const ProcessResult written = replay({"--update-baselines"});
  EXPECT_EQ(written.code, 0) << written.err;
  EXPECT_EQ(replay({"--check"}).code, 0);
  EXPECT_EQ(contents(folder_ / "recordings/place_light.moved.png"),
            contents(kRecordings / "place_light.moved.png"));
}

TEST_F(Replay, ReportsChecksAndEditLatencies) {
  const ProcessResult r =
      replay({"--check", "--report", (folder_ / "report.json").string(), "--threads", "2"});
  ASSERT_EQ(r.code, 0) << r.err;
  const auto report = nlohmann::json::parse(contents(folder_ / "report.json"));
  EXPECT_EQ(report["backend"], "cpu");
  EXPECT_EQ(report["checks"].size(), 6u);
  EXPECT_EQ(report["checks"][0]["passed"], true);
  int seen = 0;
  for (const auto& edit : report["edits"]) {
    if (!edit["visible"].get<bool>()) continue;
    ++seen;
    const int half = edit["within_50"]["frames"], most = edit["within_95"]["frames"];
    EXPECT_GE(half, 1);
    EXPECT_LE(half, most);
    EXPECT_LE(most, edit["settled"]["frames"].get<int>());
    EXPECT_GT(edit["settled"]["milliseconds"].get<double>(), 0.0);
  }
  EXPECT_GE(seen, 3);  // a light is placed and moved, and both steps are undone
  EXPECT_NE(r.out.find(" edits seen: 95% in "), std::string::npos) << r.out;
}

TEST_F(Replay, RefusesAChangedScene) {
  std::ofstream(folder_ / "assets/scenes/cornell_style.gltf", std::ios::app) << "\n";
  const ProcessResult r = replay({"--check"});
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.err.find("is not the one that was recorded"), std::string::npos) << r.err;
}

}  // namespace
}  // namespace lamplighter
