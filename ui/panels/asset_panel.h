// The asset browser: thumbnails of a folder of glTF files. A click places an asset.
#pragma once

#include <string>

#include "editor/assets/asset_folder.h"
#include "ui/widgets/widgets.h"

namespace lamplighter {

class Thumbnails;
struct Requests;

struct AssetPanelState {
  std::string search;
  bool listed = false;  // the folder from the settings was requested
};
// `thumbnails`: null if nothing is drawn.
void assetPanel(PanelContext ui, AssetPanelState& state, Thumbnails* thumbnails,
                Requests& requests);

}  // namespace lamplighter
