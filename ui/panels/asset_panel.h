// The asset browser: a folder of glTF files by their thumbnails, to be placed by clicks.
#pragma once

#include <string>
#include <vector>

#include "editor/assets/asset_folder.h"
#include "ui/widgets/widgets.h"

namespace lamplighter {

class Thumbnails;
struct Requests;

struct AssetPanelState {
  std::string search;
  bool listed = false;  // the folder of the settings was asked for
};
// `thumbnails`: null where nothing is drawn.
void assetPanel(PanelContext ui, AssetPanelState& state, Thumbnails* thumbnails,
                Requests& requests);

}  // namespace lamplighter
