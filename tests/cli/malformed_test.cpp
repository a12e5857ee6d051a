// Malformed scenes given to the program: no crash, no hang, an error of one line.
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/support/process.h"
#include "tests/support/shared_files.h"

namespace lamplighter {
namespace {

TEST(MalformedScenes, LoadOrAreRefusedInOneLine) {
  const std::filesystem::path folder = test::sharedScenes() / "malformed";
  if (!std::filesystem::exists(folder / "cases.tsv")) GTEST_SKIP() << "no " << folder;
  const auto cases = test::readTable(folder / "cases.tsv");
  ASSERT_GT(cases.size(), 20u);
  for (auto row : cases) {
    const std::string file = (folder / row["file"]).string(), expect = row["expect"];
    const test::ProcessResult r = test::runLamplighter({"info", file});
    SCOPED_TRACE(row["file"] + " (" + row["note"] + "): " + r.err);
    const bool mayLoad = expect != "error", mayFail = expect != "load";
    EXPECT_TRUE((r.code == 0 && mayLoad) || (r.code == 2 && mayFail)) << r.code;
    if (r.code == 2) {
      EXPECT_EQ(test::lines(r.err), 1);
      EXPECT_TRUE(r.err.starts_with("error: " + file + ": "));
      EXPECT_NE(r.err.find("; "), std::string::npos) << "the remedy is missing";
      EXPECT_TRUE(r.out.empty()) << "a partial scene was printed";
    } else {
      EXPECT_NE(r.out.find("triangles"), std::string::npos);
      EXPECT_EQ(("\n" + r.err).find("\nerror: "), std::string::npos);
    }
  }
}

TEST(MalformedScenes, AreNotRendered) {
  const std::filesystem::path scene =
      test::sharedScenes() / "malformed" / "derived-cut-room" / "modern-hall-cut.glb";
  if (!std::filesystem::exists(scene)) GTEST_SKIP() << "no " << scene;
  const std::filesystem::path out =
      std::filesystem::path(testing::TempDir()) / "lamplighter_malformed.png";
  std::filesystem::remove(out);
  const test::ProcessResult r =
      test::runLamplighter({"render", scene.string(), "-o", out.string(), "--backend", "cpu"});
  EXPECT_EQ(r.code, 2);
  EXPECT_EQ(test::lines(r.err), 1) << r.err;
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace lamplighter
