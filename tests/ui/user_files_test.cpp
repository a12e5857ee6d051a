// The files of the user: read, written, and renamed if they are damaged.
#include "ui/app/user_files.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

class UserFilesTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("lamplighter_user_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const char* name, const std::string& text) const {
    fs::create_directories(folder_);
    std::ofstream(folder_ / name) << text;
  }
  std::string text(const char* name) const {
    std::ifstream in(folder_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path folder_;
};

TEST_F(UserFilesTest, NoFileIsCreatedBeforeTheFirstChange) {
  UserFiles files(folder_);
  Preferences p = files.readPreferences();
  for (int i = 0; i < 100; ++i) files.keep(p);
  files.flush(p);
  EXPECT_FALSE(fs::exists(folder_));
  p.setText("ui_scale", "2");
  for (int i = 0; i < 100; ++i) files.keep(p);
  EXPECT_TRUE(fs::exists(folder_ / "settings.json"));
  UserFiles again(folder_);
  EXPECT_EQ(again.readPreferences(), p);
  EXPECT_TRUE(again.problems().empty());
}

TEST_F(UserFilesTest, AValueIsNotWrittenWhileItChanges) {
  UserFiles files(folder_);
  Preferences p = files.readPreferences();
  for (int i = 0; i < 100; ++i) {
    p.set("left_width", 200.0f + static_cast<float>(i));
    files.keep(p);
  }
  EXPECT_FALSE(fs::exists(folder_ / "settings.json"));
  files.flush(p);
  EXPECT_TRUE(fs::exists(folder_ / "settings.json"));
}

TEST_F(UserFilesTest, ADamagedFileIsRenamed) {
  for (const char* aside : {"settings.json.broken-1", "settings.json.broken-2"}) {
    write("settings.json", "{ broken");
    UserFiles files(folder_);
    Preferences p = files.readPreferences();
    EXPECT_EQ(p, Preferences());
    ASSERT_EQ(files.problems().size(), 1u);
    EXPECT_NE(files.problems()[0].find(aside), std::string::npos) << files.problems()[0];
    EXPECT_EQ(files.problems()[0].find('\n'), std::string::npos);
    p.setText("ui_scale", "2");
    files.flush(p);
    EXPECT_EQ(text(aside), "{ broken");
  }
}

TEST_F(UserFilesTest, ADamagedFileThatCannotBeRenamedIsNotOverwritten) {
  fs::create_directories(folder_ / "settings.json");  // a folder with that name
  std::ofstream(folder_ / "settings.json/inside") << "kept";
  UserFiles files(folder_);
  Preferences p = files.readPreferences();
  ASSERT_EQ(files.problems().size(), 1u);
  p.setText("ui_scale", "2");
  files.flush(p);
  bool isKept = false;
  for (const auto& entry : fs::recursive_directory_iterator(folder_))
    isKept = isKept || entry.path().filename() == "inside";
  EXPECT_TRUE(isKept);
}

TEST_F(UserFilesTest, AFolderThatCannotBeCreatedIsReportedOnce) {
  std::ofstream(folder_) << "a file in place of the folder";
  UserFiles files(folder_);
  Preferences p = files.readPreferences();
  p.setText("ui_scale", "2");
  files.flush(p);
  EXPECT_FALSE(files.takeWriteProblem().empty());
  p.setText("ui_scale", "3");
  files.flush(p);
  EXPECT_TRUE(files.takeWriteProblem().empty());
}

TEST_F(UserFilesTest, KeysAreReadAndTheirProblemsNameTheFile) {
  write("keys.json", R"({"tool.move": "G", "tool.scale": "Strg+A"})");
  UserFiles files(folder_);
  EXPECT_EQ(files.readKeys().size(), 1u);
  ASSERT_EQ(files.problems().size(), 1u);
  EXPECT_NE(files.problems()[0].find("keys.json"), std::string::npos);
}

}  // namespace
}  // namespace lamplighter
