// State of a session that belongs to the user and not to the document: settings, keys, messages,
// open panels.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "editor/assets/asset_folder.h"
#include "editor/assets/asset_library.h"
#include "editor/keys/key_bindings.h"
#include "editor/notices/notices.h"
#include "editor/preferences/preferences.h"

namespace lamplighter {

// The panel below the view. The light table is in LightingState.
enum class BottomPanel : uint8_t { none, assets, log };

struct UserState {
  Preferences preferences;
  KeyList fileKeys;  // from keys.json
  Notices notices;
  AssetLibrary assets;
  std::vector<AssetFile> assetFiles;   // in the folder of the preferences
  std::filesystem::path assetsListed;  // the folder of this list
  BottomPanel bottom = BottomPanel::none;
  bool showsSettings = false;
  // Requests of actions to the window, which resets them.
  bool opensPalette = false;
  std::optional<int> focusStep;  // moves the keyboard focus to another panel; 0: to the menus
  std::set<std::string> ran;     // names of the actions that ran, for reports
  // Where actions save files in a replay, instead of beside the recorded level. Empty: no
  // restriction.
  std::filesystem::path writeFolder;
};

}  // namespace lamplighter
