#include "editor/preferences/preferences_file.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "renderer/base/error.h"
#include "renderer/base/json_text.h"

namespace lamplighter {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kSettingsFormat = 1;
constexpr size_t kMostPaths = 100, kLongestPath = 4096;

// Shortens text and makes it printable, because a file may contain anything.
std::string shown(const Json& j) {
  std::string text = j.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > 40) text = text.substr(0, 37) + "...";
  return text;
}

std::string shown(const std::string& text) { return shown(Json(text)); }

// The value with the declared type, which decides whether a JSON number is int or float.
ParameterValue valueOf(const ParameterSpec& spec, const Json& j) {
  const bool isText = std::holds_alternative<std::string>(spec.defaultValue);
  const bool isFlag = std::holds_alternative<bool>(spec.defaultValue);
  const bool isKind = isText ? j.is_string() : isFlag ? j.is_boolean() : j.is_number();
  if (!isKind) throw InputError(spec.name, shown(j) + " has the wrong type", "the default is used");
  return Settings::parse(spec, isText ? j.get<std::string>() : j.dump());
}

void readValues(const Json& values, Preferences& out, std::vector<std::string>& problems) {
  if (!values.is_object()) {
    problems.push_back("\"settings\" is not an object; the defaults are used");
    return;
  }
  for (const auto& [name, value] : values.items()) {
    const ParameterSpec* spec = findPreference(name);
    if (spec == nullptr) {
      problems.push_back(shown(name) + " is not a setting; it is ignored");
      continue;
    }
    try {
      out.set(name, valueOf(*spec, value));
    } catch (const InputError& e) {
      problems.emplace_back(e.what());
    }
  }
}

std::vector<std::filesystem::path> pathsOf(const Json& j, const char* name,
                                           std::vector<std::string>& problems) {
  std::vector<std::filesystem::path> out;
  bool isSound = j.is_array() && j.size() <= kMostPaths;
  for (const Json& entry : isSound ? j : Json::array()) {
    isSound =
        isSound && entry.is_string() && entry.get_ref<const std::string&>().size() < kLongestPath;
    if (!isSound) break;
    const std::filesystem::path path(entry.get<std::string>());
    if (path.is_absolute()) out.push_back(path.lexically_normal());
  }
  if (isSound) return out;
  problems.push_back(fmt::format("\"{}\" is not a list of paths; it is ignored", name));
  return {};
}

Json pathList(const std::vector<std::filesystem::path>& paths) {
  Json list = Json::array();
  for (const std::filesystem::path& path : paths) list.push_back(path.string());
  return list;
}

}  // namespace

Preferences parsePreferences(std::string_view text, std::vector<std::string>& problems) {
  Preferences out;
  const Json j = parseJson<Json>(text);
  if (!j.is_object()) {
    problems.emplace_back("is not a JSON object; the defaults are used");
    return out;
  }
  if (!j.contains("lamplighter_settings") || j["lamplighter_settings"] != kSettingsFormat) {
    problems.emplace_back("does not contain \"lamplighter_settings\": 1; the defaults are used");
    return out;
  }
  for (const auto& [name, value] : j.items()) {
    if (name == "settings") {
      readValues(value, out, problems);
    } else if (name == "recent_files") {
      out.recentFiles = pathsOf(value, "recent_files", problems);
      if (out.recentFiles.size() > Preferences::kMostRecent)
        out.recentFiles.resize(Preferences::kMostRecent);
    } else if (name == "favourite_folders") {
      out.favouriteFolders = pathsOf(value, "favourite_folders", problems);
    } else if (name == "asset_folder") {
      const auto paths = pathsOf(Json::array({value}), "asset_folder", problems);
      if (!paths.empty()) out.assetFolder = paths.front();
    } else if (name != "lamplighter_settings") {
      problems.push_back(shown(name) + " is unknown; it is ignored");
    }
  }
  return out;
}

std::string preferencesText(const Preferences& p) {
  Json j{{"lamplighter_settings", kSettingsFormat}};
  Json& values = j["settings"] = Json::object();
  for (const auto& [name, value] : p.values.values()) {
    std::visit(
        [&, key = name](const auto& v) {
          // A float converted to double would have extra digits.
          if constexpr (std::is_same_v<std::decay_t<decltype(v)>, float>)
            values[key] = std::stod(fmt::format("{}", v));
          else
            values[key] = v;
        },
        value);
  }
  j["recent_files"] = pathList(p.recentFiles);
  j["favourite_folders"] = pathList(p.favouriteFolders);
  if (!p.assetFolder.empty()) j["asset_folder"] = p.assetFolder.string();
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace lamplighter
