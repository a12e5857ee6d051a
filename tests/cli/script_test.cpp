// The command `lamplighter script`, which runs actions from a file.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/folders.h"
#include "tests/support/process.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;
using test::ProcessResult;
using test::runLamplighter;

class Script : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("lamplighter_script_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  static std::string contents(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path file(const std::string& name) const { return folder_ / name; }
  ProcessResult run(const std::string& text, const std::string& threads = "0") const {
    std::ofstream(file("script.txt")) << text;
    return runLamplighter({"script", file("script.txt").string(),
                           (test::sourceFolder() / "assets/scenes/cornell_style.gltf").string(),
                           "--size", "96x64", "--backend", "cpu", "--threads", threads});
  }

  fs::path folder_;
};

TEST_F(Script, RunsOneActionPerLine) {
  const ProcessResult r =
      run("# a comment\n\n  render.set vpls=40   # and another\n"
          "select.name lamp\nlight.radiance 4 2 1\nscript.wait\n"
          "app.screenshot \"" +
          file("a b.png").string() + "\"\nerror.measure 4\nfile.save_as " +
          file("lit.gltf").string() + "\napp.quit\nno.such.action\n");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(fs::exists(file("a b.png")));
  EXPECT_TRUE(fs::exists(file("lit.gltf")));
  EXPECT_NE(r.out.find("\nerror "), std::string::npos) << r.out;
}

TEST_F(Script, GivesTheSamePictureAtAnyNumberOfThreads) {
  const std::string text = "render.set vpls=40\nscript.wait\napp.screenshot ";
  ASSERT_EQ(run(text + file("1.png").string(), "1").code, 0);
  ASSERT_EQ(run(text + file("2.png").string(), "2").code, 0);
  EXPECT_FALSE(contents(file("1.png")).empty());
  EXPECT_TRUE(contents(file("1.png")) == contents(file("2.png")));
}

TEST_F(Script, ErrorsNameFileAndLine) {
  const ProcessResult r = run("script.wait\n\nlight.radiance 1 2\n");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.err.find("script.txt:3: "), std::string::npos) << r.err;
  EXPECT_EQ(run("render.set vpls=zero\n").code, 2);
  EXPECT_EQ(run("app.screenshot \"unclosed\n").code, 2);
  EXPECT_EQ(runLamplighter({"script", file("none.txt").string()}).code, 2);
}

}  // namespace
}  // namespace lamplighter
