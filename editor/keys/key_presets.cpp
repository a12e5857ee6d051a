#include "editor/keys/key_presets.h"

#include <utility>

namespace lamplighter {

namespace {

using Keys = std::vector<std::pair<std::string, std::string>>;

const std::vector<std::pair<std::string, Keys>>& all() {
  static const std::vector<std::pair<std::string, Keys>> kPresets = {
      {"wer", {}},
      {"grs",
       {{"tool.move", "G"}, {"tool.rotate", "R"}, {"tool.scale", "S"}, {"tool.snap", "Shift+Tab"}}},
  };
  return kPresets;
}

}  // namespace

std::vector<std::string> keyPresetNames() {
  std::vector<std::string> names;
  for (const auto& [name, keys] : all()) names.push_back(name);
  return names;
}

const Keys& keysOfPreset(const std::string& name) {
  for (const auto& [preset, keys] : all())
    if (preset == name) return keys;
  return all().front().second;
}

}  // namespace lamplighter
