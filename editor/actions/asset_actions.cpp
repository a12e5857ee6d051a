// Actions for props from a folder of glTF files.
#include <filesystem>

#include "editor/actions/arguments.h"
#include "editor/actions/place_asset.h"
#include "editor/assets/asset_folder.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "editor/session/user_state.h"

namespace lamplighter {

namespace {

namespace fs = std::filesystem;

fs::path assetFolderOf(const Session& s) {
  const fs::path& chosen = s.home().preferences.assetFolder;
  return chosen.empty() ? s.document().path.parent_path() : chosen;
}

// Searches relative to the asset folder, then to the level's folder, then to the working directory.
fs::path foundAsset(const Session& s, const std::string& name) {
  std::error_code error;
  for (const fs::path& folder :
       {s.home().preferences.assetFolder, s.document().path.parent_path()}) {
    if (!folder.empty() && fs::exists(folder / name, error)) return folder / name;
  }
  return name;
}

}  // namespace

void addAssetActions(ActionRegistry& r) {
  r.add({"asset.folder", "Folder of assets", "FOLDER",
         "Shows the glTF files of a folder in the asset browser.", "",
         [](Session& s, const Arguments& a) {
           std::error_code error;
           const fs::path beside = s.document().path.parent_path() / a[0];
           const fs::path folder =
               fs::absolute(fs::is_directory(beside, error) ? beside : fs::path(a[0]), error)
                   .lexically_normal();
           s.home().assetFiles = listAssets(folder);
           s.home().preferences.assetFolder = folder;
           s.home().assetsListed = folder;
           s.home().bottom = BottomPanel::assets;
           s.lighting().showsTable = false;
           s.setStatus("Found " + std::to_string(s.home().assetFiles.size()) + " assets in " +
                       folder.filename().string());
         },
         nullptr, true})
      .asks = {.kind = ActionAsk::Kind::folder,
               .title = "Choose a folder of assets",
               .suggested = [](const Session& s) { return assetFolderOf(s).string(); }};
  r.add({"asset.place", "Place an asset", "FILE",
         "Adds the objects of a glTF file to the level, on the surface in the middle of the view "
         "or, with place.start, on the clicked surface. Copies share their meshes and need little "
         "memory.",
         "", [](Session& s, const Arguments& a) { placeAsset(s, foundAsset(s, a[0])); }})
      .asks = {.title = "Place an asset",
               .extensions = kSceneExtensions,
               .suggested = [](const Session& s) { return (assetFolderOf(s) / "").string(); }};
}

}  // namespace lamplighter
