// The pictures that the viewport can show in addition to the lit one: views of the scene and of
// internal data of methods (Inspection), and views that methods draw themselves
// (MethodInfo::views). Menu, keys, actions and the command line are generated from this table.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/methods/inspection.h"

namespace lamplighter {

// Views of methods have the values after the last one.
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
  meshEdges,
  meshSamples,
  meshContrast,
  meshAge,
  mapAge,
  pendingPatches,
  shadowMap,
  edgeMask,
  prtObjects
};

struct ViewPicture;
struct ViewSubject;

struct DebugViewInfo {
  DebugView view;
  std::string name;   // for --view, and for actions after "view."
  std::string label;  // in the menu
  std::string key;    // "" for none; rebindable
  std::string help;   // one sentence
  // Null: the picture is radiance, or the method draws it.
  ViewPicture (*draw)(const ViewSubject& subject) = nullptr;
  std::vector<Capability> needs = {};  // of the method
  std::string method = {};             // method that draws the view; "": not a view of a method
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
