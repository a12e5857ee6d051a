// The pictures that the viewport can show besides the lit one. Menu, keys, actions and the command
// line are generated from this table.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lamplighter {

enum class DebugView {
  lit,
  lightOnly,
  direct,
  indirect,
  falseColour,
  albedo,
  normals,
  flat,
  patches,
  patchLevels,
  occlusion,
  lightOcclusion,
  partialLights,
  lightsPerPatch,
  lightMaps,
  lightMapDensity,
  mapAge,
  pendingPatches,
  shadowMap,
  edgeMask,
  prtObjects
};

struct DebugViewInfo {
  DebugView view;
  const char* name;   // for --view, and for actions after "view."
  const char* label;  // in the menu
  const char* key;    // "" for none; rebindable
  const char* help;   // one sentence
};

// In the order of the menu.
std::span<const DebugViewInfo> debugViews();
const DebugViewInfo& infoOf(DebugView view);
// Throws InputError if there is no view of that name.
const DebugViewInfo& findDebugView(std::string_view name);

// Whether the picture is radiance, which needs exposure and tone mapping; other pictures are
// display colours.
inline bool isRadiance(DebugView view) {
  return view == DebugView::lit || view == DebugView::lightOnly || view == DebugView::direct ||
         view == DebugView::indirect;
}

// Whether it shows internal data of the engine; other views show the level and its light.
inline bool isOfEngine(DebugView view) { return view > DebugView::flat; }

// Whether it shows the selected light sample, or the light to which that sample belongs.
inline bool needsLightSample(DebugView view) {
  return view == DebugView::occlusion || view == DebugView::lightOcclusion ||
         view == DebugView::shadowMap;
}

}  // namespace lamplighter
