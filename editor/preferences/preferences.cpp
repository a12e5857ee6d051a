#include "editor/preferences/preferences.h"

#include <algorithm>
#include <map>

#include "editor/keys/key_presets.h"
#include "editor/presets/presets.h"
#include "renderer/base/error.h"
#include "renderer/image/tone_map.h"

namespace lamplighter {

namespace {

std::vector<std::string> presetNames() {
  std::vector<std::string> names;
  for (const Preset& p : presets()) names.push_back(p.name);
  return names;
}

std::vector<std::string> mapperNames() {
  std::vector<std::string> names;
  for (const ToneMapperInfo& m : toneMappers()) names.emplace_back(m.name);
  return names;
}

std::vector<PreferenceSection> declared() {
  using S = UserSettings;
  return {
      {"Appearance",
       {{&S::uiScale,
         "ui_scale",
         "UI scale",
         "",
         "Size of the user interface, relative to the scale of the screen.",
         {0.5, 4.0}},
        {&S::toasts, "toasts", "Toasts",
         "Shows messages in a corner of the view for a few seconds."},
        {&S::toastSeconds,
         "toast_seconds",
         "Toasts stay",
         "s",
         "Duration of a message in the view. Errors stay twice as long.",
         {1.0, 30.0}},
        {&S::thumbnailSize,
         "thumbnail_size",
         "Thumbnails",
         "px",
         "Size of the previews in the asset browser.",
         {48, 192}}}},
      {"Input",
       {&S::keys, "keys", "Keys",
        "Keys for moving, rotating and scaling; keys.json in the same folder binds single actions.",
        keyPresetNames()}},
      {"Work",
       {{&S::lightUnit,
         "light_unit",
         "Light unit",
         "The unit in which the strength of lights is shown and typed.",
         {"lm", "cd", "nits", "W"}},
        {&S::toneMapper, "tone_mapper", "Tone mapper", "How radiance is mapped to the display.",
         mapperNames()},
        {&S::preset, "preset", "Preset", "Budgets and quality settings when the program starts.",
         presetNames()}}},
      {"Window",
       {{&S::windowWidth,
         "window_width",
         "Width",
         "px",
         "Width of the window when the program starts.",
         {640, 16384}},
        {&S::windowHeight,
         "window_height",
         "Height",
         "px",
         "Height of the window when the program starts.",
         {400, 16384}},
        {&S::leftWidth,
         "left_width",
         "Outliner",
         "px",
         "Width of the outliner, at UI scale 1.",
         {150.0, 4000.0}},
        {&S::rightWidth,
         "right_width",
         "Inspector",
         "px",
         "Width of the inspector and the render panel, at UI scale 1.",
         {150.0, 4000.0}},
        {&S::bottomHeight,
         "bottom_height",
         "Lower panel",
         "px",
         "Height of the light table, the asset browser or the log, at UI scale 1.",
         {120.0, 4000.0}},
        {&S::renderShare,
         "render_share",
         "Render panel",
         "",
         "Share of the height of the right column that the render panel takes.",
         {0.15, 0.85}}},
       false},
  };
}

const ParameterTable<UserSettings>& settingsTable() {
  static const auto table = [] {
    ParameterTable<UserSettings> all({});
    for (const PreferenceSection& section : preferenceSections()) all.append(section.table);
    return all;
  }();
  return table;
}

std::filesystem::path normal(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(path, error);
  return (error ? path : absolute).lexically_normal();
}

}  // namespace

const std::vector<PreferenceSection>& preferenceSections() {
  static const std::vector<PreferenceSection> kSections = declared();
  return kSections;
}

const std::vector<std::string>& offeredValues(const std::string& name) {
  static const std::map<std::string, std::vector<std::string>> kOffered{
      // The panel is scaled while the slider is dragged, which would move it away from the pointer.
      {"ui_scale", {"0.75", "1", "1.25", "1.5", "2", "3"}}};
  static const std::vector<std::string> kSlider;
  const auto it = kOffered.find(name);
  return it == kOffered.end() ? kSlider : it->second;
}

const ParameterSpec* findPreference(const std::string& name) {
  return findParameter(settingsTable().specs(), name);
}

const ParameterSpec& preferenceNamed(const std::string& name) {
  if (const ParameterSpec* spec = findPreference(name)) return *spec;
  throw InputError(name, "there is no such setting", "docs/reference/settings.md lists them");
}

UserSettings Preferences::settings() const { return settingsTable().read(values); }

void Preferences::setText(const std::string& name, const std::string& text) {
  set(name, Settings::parse(preferenceNamed(name), text));
}

void Preferences::set(const std::string& name, ParameterValue value) {
  if (value == preferenceNamed(name).defaultValue)
    values.reset(name);
  else
    values.set(name, std::move(value));
}

void Preferences::addRecent(const std::filesystem::path& file) {
  const std::filesystem::path path = normal(file);
  std::erase(recentFiles, path);
  recentFiles.insert(recentFiles.begin(), path);
  if (recentFiles.size() > kMostRecent) recentFiles.resize(kMostRecent);
}

std::vector<std::filesystem::path> Preferences::recentFolders() const {
  std::vector<std::filesystem::path> folders;
  for (const std::filesystem::path& file : recentFiles) {
    if (std::find(folders.begin(), folders.end(), file.parent_path()) == folders.end())
      folders.push_back(file.parent_path());
  }
  return folders;
}

void Preferences::toggleFavourite(const std::filesystem::path& folder) {
  const std::filesystem::path path = normal(folder);
  if (std::erase(favouriteFolders, path) == 0) favouriteFolders.push_back(path);
}

}  // namespace lamplighter
