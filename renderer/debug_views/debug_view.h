// What the viewport can show besides the lit picture, declared once: menu, keys, actions and the
// command line follow from this table.
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
  const char* name;   // as in --view, and after "view." as an action
  const char* label;  // as in the menu
  const char* key;    // "" for none; rebindable
  const char* help;   // one sentence
};

// In the order they are shown.
std::span<const DebugViewInfo> debugViews();
const DebugViewInfo& infoOf(DebugView view);
// Throws InputError when there is none of that name.
const DebugViewInfo& findDebugView(std::string_view name);

// Whether the picture is radiance, to be exposed and tone-mapped; the others are colours of the
// display as they are.
inline bool isRadiance(DebugView view) {
  return view == DebugView::lit || view == DebugView::lightOnly || view == DebugView::direct ||
         view == DebugView::indirect;
}

// Whether it shows what the engine keeps; the others show the level and its light.
inline bool isOfEngine(DebugView view) { return view > DebugView::flat; }

// Whether it is about a light sample, or the light that one is on.
inline bool needsLightSample(DebugView view) {
  return view == DebugView::occlusion || view == DebugView::lightOcclusion ||
         view == DebugView::shadowMap;
}

}  // namespace lamplighter
