#include "editor/preferences/preferences.h"

#include <algorithm>

#include "editor/keys/key_presets.h"
#include "editor/presets/presets.h"
#include "renderer/base/error.h"
#include "renderer/image/tone_map.h"

namespace lamplighter {

namespace {

ParameterSpec number(const char* name, const char* label, const char* unit, const char* help,
                     float usual, float least, float most) {
  return {name, label, unit, help, usual, least, most};
}

ParameterSpec count(const char* name, const char* label, const char* unit, const char* help,
                    int usual, int least, int most) {
  return {name, label, unit, help, usual, static_cast<double>(least), static_cast<double>(most)};
}

ParameterSpec choice(const char* name, const char* label, const char* help, const char* usual,
                     std::vector<std::string> choices) {
  ParameterSpec spec{name, label, "", help, std::string(usual)};
  spec.choices = std::move(choices);
  return spec;
}

ParameterSpec flag(const char* name, const char* label, const char* help, bool usual) {
  return {name, label, "", help, usual};
}

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
  return {
      {"Appearance",
       {number("ui_scale", "UI scale", "",
               "Size of the user interface, relative to the scale of the screen.", 1.0f, 0.5f,
               4.0f),
        flag("toasts", "Toasts", "Shows messages in a corner of the view for a few seconds.", true),
        number("toast_seconds", "Toasts stay", "s",
               "Duration of a message in the view. Errors stay twice as long.", 4.0f, 1.0f, 30.0f),
        count("thumbnail_size", "Thumbnails", "px", "Size of the previews in the asset browser.",
              84, 48, 192)}},
      {"Input",
       {choice("keys", "Keys",
               "Which keys move, rotate and scale; keys.json in the same folder binds single "
               "actions.",
               "wer", keyPresetNames())}},
      {"Work",
       {choice("light_unit", "Light unit",
               "The unit in which the strength of lights is shown and typed.", "lm",
               {"lm", "cd", "nits", "W"}),
        choice("tone_mapper", "Tone mapper", "How radiance is mapped to the display.", "filmic",
               mapperNames()),
        choice("preset", "Preset", "The budgets and qualities that the program starts with.",
               "work", presetNames())}},
      {"Window",
       {count("window_width", "Width", "px", "Of the window when it opens.", 1280, 640, 16384),
        count("window_height", "Height", "px", "Of the window when it opens.", 720, 400, 16384),
        number("left_width", "Outliner", "px", "Width of the outliner, at UI scale 1.", 232.0f,
               150.0f, 4000.0f),
        number("right_width", "Inspector", "px",
               "Width of the inspector and the render panel, at UI scale 1.", 330.0f, 150.0f,
               4000.0f),
        number("bottom_height", "Lower panel", "px",
               "Height of the light table, the asset browser or the log, at UI scale 1.", 220.0f,
               120.0f, 4000.0f),
        number("render_share", "Render panel", "", "Its share of the right column's height.", 0.5f,
               0.15f, 0.85f)}},
  };
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

const ParameterSpec* findPreference(const std::string& name) {
  for (const PreferenceSection& section : preferenceSections()) {
    for (const ParameterSpec& spec : section.specs)
      if (spec.name == name) return &spec;
  }
  return nullptr;
}

const ParameterSpec& preferenceNamed(const std::string& name) {
  if (const ParameterSpec* spec = findPreference(name)) return *spec;
  throw InputError(name, "there is no such setting", "docs/reference/settings.md lists them");
}

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
