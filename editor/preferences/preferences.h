// The settings of a user for all levels, and the state that the program remembers. The settings are
// declared in preferences.cpp; the settings panel, the file, the actions and
// docs/reference/settings.md follow. They are not part of a level. Replays and recordings never
// read them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/base/parameter_table.h"

namespace lamplighter {

struct UserSettings {
  float uiScale = 1.0f;  // relative to the scale of the screen
  bool toasts = true;
  float toastSeconds = 4.0f;
  int thumbnailSize = 84;  // [pixels]
  std::string keys = "wer";
  std::string lightUnit = "lm", toneMapper = "filmic", preset = "work";
  int windowWidth = 1280, windowHeight = 720;                            // [pixels]
  float leftWidth = 232.0f, rightWidth = 330.0f, bottomHeight = 220.0f;  // at UI scale 1
  float renderShare = 0.5f;  // of the right column's height
};

// Grouped by the sections of the settings panel.
struct PreferenceSection {
  std::string label;
  ParameterTable<UserSettings> table;
  bool isOpen = true;  // at first
};
const std::vector<PreferenceSection>& preferenceSections();
// The values of a numeric setting that menus and the panel offer in place of a slider; empty: there
// is a slider.
const std::vector<std::string>& offeredValues(const std::string& name);
// nullptr if the name is unknown.
const ParameterSpec* findPreference(const std::string& name);
// Throws InputError.
const ParameterSpec& preferenceNamed(const std::string& name);

struct Preferences {
  Settings values;                                      // only values that differ from the defaults
  std::vector<std::filesystem::path> recentFiles;       // last opened first
  std::vector<std::filesystem::path> favouriteFolders;  // of the file dialog
  std::filesystem::path assetFolder;                    // of the asset browser

  bool operator==(const Preferences&) const = default;

  // Default values are not stored. Throws InputError for an unknown name or an invalid value.
  void setText(const std::string& name, const std::string& text);
  void set(const std::string& name, ParameterValue value);
  UserSettings settings() const;

  static constexpr size_t kMostRecent = 10;
  void addRecent(const std::filesystem::path& file);
  // Folders of the recent files, without duplicates.
  std::vector<std::filesystem::path> recentFolders() const;
  // Adds a favourite folder, or removes it if it is one.
  void toggleFavourite(const std::filesystem::path& folder);
};

}  // namespace lamplighter
