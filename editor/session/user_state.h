// What a session keeps of its user and of what happened, none of it part of the document: settings,
// keys, notices, which panels are open.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>

#include "editor/assets/asset_folder.h"
#include "editor/assets/asset_library.h"
#include "editor/keys/key_bindings.h"
#include "editor/notices/notices.h"
#include "editor/preferences/preferences.h"

namespace lamplighter {

// What is shown below the view; the light table is in LightingState.
enum class BottomPanel : uint8_t { none, assets, log };

struct UserState {
  Preferences preferences;
  KeyList fileKeys;  // of keys.json
  Notices notices;
  AssetLibrary assets;
  std::vector<AssetFile> assetFiles;   // of the folder in the preferences, as it was listed
  std::filesystem::path assetsListed;  // that folder, once it was
  BottomPanel bottom = BottomPanel::none;
  bool showsSettings = false;
  std::set<std::string> ran;  // names of the actions that did something, for reports
  // Replays write here what actions save: never beside the level that was recorded. Empty:
  // anywhere.
  std::filesystem::path writeFolder;
};

}  // namespace lamplighter
