// What a user sets once for all levels, and what the program remembers of them: declared here;
// settings panel, file, actions and docs/reference/settings.md follow. No part of a level, and
// never read where input is replayed or recorded.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/base/parameters.h"

namespace lamplighter {

// By their sections in the settings panel.
struct PreferenceSection {
  std::string label;
  std::vector<ParameterSpec> specs;
};
const std::vector<PreferenceSection>& preferenceSections();
// nullptr: there is none of that name.
const ParameterSpec* findPreference(const std::string& name);
// Throws InputError.
const ParameterSpec& preferenceNamed(const std::string& name);

struct Preferences {
  Settings values;                                      // those that differ from their defaults
  std::vector<std::filesystem::path> recentFiles;       // the last one first
  std::vector<std::filesystem::path> favouriteFolders;  // of the file dialog
  std::filesystem::path assetFolder;                    // of the asset browser

  bool operator==(const Preferences&) const = default;

  // Values at their defaults are not kept. Throws InputError for an unknown name or bad value.
  void setText(const std::string& name, const std::string& text);
  void set(const std::string& name, ParameterValue value);
  bool boolean(const char* name) const { return values.boolean(preferenceNamed(name)); }
  int integer(const char* name) const { return values.integer(preferenceNamed(name)); }
  float real(const char* name) const { return values.real(preferenceNamed(name)); }
  std::string choice(const char* name) const { return values.choice(preferenceNamed(name)); }

  static constexpr size_t kMostRecent = 10;
  void addRecent(const std::filesystem::path& file);
  // Folders of the recent files, each once.
  std::vector<std::filesystem::path> recentFolders() const;
  // A favourite, or none any more.
  void toggleFavourite(const std::filesystem::path& folder);
};

}  // namespace lamplighter
