// Settings as text: round trips and malformed files.
#include "editor/preferences/preferences.h"

#include <set>

#include <gtest/gtest.h>

#include "editor/preferences/preferences_file.h"
#include "editor/session/apply.h"
#include "editor/session/user_state.h"
#include "renderer/base/error.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

TEST(Preferences, AreRestored) {
  Preferences p;
  p.setText("ui_scale", "1.25");
  p.setText("toasts", "false");
  p.setText("thumbnail_size", "100");
  p.setText("keys", "grs");
  p.addRecent("/levels/b.gltf");
  p.addRecent("/levels/\"a\" ü.glb");
  p.toggleFavourite("/levels");
  p.assetFolder = "/kit";
  std::vector<std::string> problems;
  EXPECT_EQ(parsePreferences(preferencesText(p), problems), p);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(p.recentFiles.front(), "/levels/\"a\" ü.glb");
}

TEST(Preferences, DefaultsAreNotStored) {
  Preferences p;
  p.setText("ui_scale", "2");
  p.setText("ui_scale", "1");
  EXPECT_EQ(p, Preferences());
}

TEST(Preferences, HaveUniqueNamesLabelsAndHelp) {
  std::set<std::string> names;
  for (const PreferenceSection& section : preferenceSections()) {
    EXPECT_FALSE(section.label.empty());
    for (const ParameterSpec& spec : section.table.specs()) {
      EXPECT_TRUE(names.insert(spec.name).second) << spec.name;
      EXPECT_FALSE(spec.label.empty()) << spec.name;
      EXPECT_FALSE(spec.help.empty()) << spec.name;
      // The default is a valid value.
      EXPECT_NO_THROW(Settings::parse(spec, Settings::format(spec.defaultValue))) << spec.name;
    }
  }
}

TEST(Preferences, RecentFilesAreLimitedAndUnique) {
  Preferences p;
  for (int i = 0; i < 30; ++i) p.addRecent("/a/" + std::to_string(i) + ".gltf");
  p.addRecent("/a/25.gltf");
  EXPECT_EQ(p.recentFiles.size(), Preferences::kMostRecent);
  EXPECT_EQ(p.recentFiles[0], "/a/25.gltf");
  EXPECT_EQ(p.recentFiles[1], "/a/29.gltf");
  EXPECT_EQ(p.recentFolders(), std::vector<std::filesystem::path>{"/a"});
}

TEST(Preferences, AMalformedFileGivesTheDefaults) {
  for (const char* text : {"", "{", "[]", "null", "{\"lamplighter_settings\": 2}", "\xff\xfe",
                           "{\"settings\": {\"ui_scale\": 2}}"}) {
    std::vector<std::string> problems;
    EXPECT_EQ(parsePreferences(text, problems), Preferences()) << text;
    EXPECT_EQ(problems.size(), 1u) << text;
  }
}

TEST(Preferences, ProblemsArePrintableAndOneLine) {
  std::vector<std::string> problems;
  parsePreferences(R"({"lamplighter_settings": 1, "settings": {"keys": "a\r\nb\u001b[2J"}})",
                   problems);
  ASSERT_EQ(problems.size(), 1u);
  for (const char c : problems[0]) EXPECT_GE(static_cast<unsigned char>(c), 0x20) << problems[0];
}

// Copying or printing such a deeply nested value recursively would overflow the stack.
TEST(Preferences, DeeplyNestedJsonGivesTheDefaults) {
  const std::string deep = std::string(500'000, '[') + std::string(500'000, ']');
  for (const char* name : {"asset_folder", "recent_files", "settings", "other"}) {
    std::vector<std::string> problems;
    EXPECT_EQ(
        parsePreferences(
            "{\"lamplighter_settings\": 1, \"" + std::string(name) + "\": " + deep + "}", problems),
        Preferences());
    EXPECT_EQ(problems.size(), 1u) << name;
  }
}

TEST(Preferences, ValidEntriesAreUsedAndOthersReported) {
  std::vector<std::string> problems;
  const Preferences p = parsePreferences(R"({"lamplighter_settings": 1, "settings":
    {"ui_scale": 1e9, "toasts": "yes", "thumbnail_size": 64, "keys": "qwertz", "frobnicate": 1,
     "left_width": null},
    "recent_files": [1], "favourite_folders": ["relative", "/absolute"], "other": 1})",
                                         problems);
  const UserSettings settings = p.settings();
  EXPECT_EQ(settings.thumbnailSize, 64);
  EXPECT_FLOAT_EQ(settings.uiScale, 1.0f);
  EXPECT_TRUE(settings.toasts);
  EXPECT_EQ(settings.keys, "wer");
  EXPECT_TRUE(p.recentFiles.empty());
  EXPECT_EQ(p.favouriteFolders, std::vector<std::filesystem::path>{"/absolute"});
  EXPECT_EQ(problems.size(), 7u);
  for (const std::string& problem : problems)
    EXPECT_EQ(problem.find('\n'), std::string::npos) << problem;
}

using SettingsActions = test::SessionFixture;

TEST_F(SettingsActions, ChangeTheSession) {
  ASSERT_TRUE(session_.runAction("settings.set light_unit=cd"));
  EXPECT_EQ(session_.lighting().unit, LightUnit::candela);
  ASSERT_TRUE(session_.runAction("settings.set keys=grs"));
  EXPECT_EQ(session_.actions().forKey(Key::g, {})->name, "tool.move");
  ASSERT_TRUE(session_.runAction("view.ui_scale 1.5"));
  EXPECT_FLOAT_EQ(session_.home().preferences.settings().uiScale, 1.5f);
  // Another action changed the unit; settings.set keeps that change.
  ASSERT_TRUE(session_.runAction("lights.unit nits"));
  ASSERT_TRUE(session_.runAction("settings.set toasts=false"));
  EXPECT_EQ(session_.lighting().unit, LightUnit::nits);
  ASSERT_TRUE(session_.runAction("settings.reset keys"));
  EXPECT_EQ(session_.actions().forKey(Key::w, {})->name, "tool.move");
  ASSERT_TRUE(session_.runAction("settings.reset"));
  EXPECT_EQ(session_.lighting().unit, LightUnit::lumens);
  EXPECT_TRUE(session_.home().preferences.values.values().empty());
  EXPECT_FALSE(session_.editing().canUndo()) << "settings are not part of the level";
}

TEST_F(SettingsActions, RefuseInvalidValues) {
  for (const char* bad : {"settings.set ui_scale=9", "settings.set nothing=1", "settings.set",
                          "settings.set ui_scale", "settings.reset nothing", "view.ui_scale x"}) {
    EXPECT_FALSE(session_.runAction(bad)) << bad;
    EXPECT_EQ(session_.home().notices.all().back().kind, NoticeKind::error) << bad;
  }
  EXPECT_TRUE(session_.home().preferences.values.values().empty());
}

}  // namespace
}  // namespace lamplighter
