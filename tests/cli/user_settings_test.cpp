// The settings of the user do not change replays and subcommands, and their reference page is up to
// date.
#include <cstdlib>
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

std::string contents(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(UserSettings, SettingsDoNotChangeAReplay) {
  const fs::path folder = fs::path(testing::TempDir()) / "lamplighter_hostile_settings";
  fs::remove_all(folder);
  fs::create_directories(folder / "lamplighter");
  // A file that changes as much as possible, and a damaged one.
  const std::string hostile = R"({"lamplighter_settings":1,"settings":{"ui_scale":3,"keys":"grs",
    "tone_mapper":"linear","light_unit":"cd","preset":"draft","left_width":900,"right_width":900}})";
  const std::string keys = R"({"tool.move":"P","app.palette":"","edit.undo":"W"})";
  ASSERT_EQ(::setenv("XDG_CONFIG_HOME", folder.c_str(), 1), 0);
  for (const std::string& settings : {hostile, std::string("{\"")}) {
    std::ofstream(folder / "lamplighter/settings.json") << settings;
    std::ofstream(folder / "lamplighter/keys.json") << keys;
    const ProcessResult r = runLamplighter(
        {"replay", (test::sourceFolder() / "tests/recordings/place_light.jsonl").string(),
         "--headless", "--check", "-o", (folder / "out").string()});
    EXPECT_EQ(r.code, 0) << r.out << r.err;
    EXPECT_EQ(contents(folder / "lamplighter/settings.json"), settings);
    EXPECT_EQ(contents(folder / "lamplighter/keys.json"), keys);
    EXPECT_EQ(
        std::distance(fs::directory_iterator(folder / "lamplighter"), fs::directory_iterator()), 2);
  }
  ::unsetenv("XDG_CONFIG_HOME");
  fs::remove_all(folder);
}

TEST(UserSettings, ThePageIsUpToDate) {
  EXPECT_EQ(runLamplighter({"settings", "--markdown"}).out,
            contents(test::sourceFolder() / "docs/reference/settings.md"))
      << "run: lamplighter settings --markdown > docs/reference/settings.md";
}

}  // namespace
}  // namespace lamplighter
