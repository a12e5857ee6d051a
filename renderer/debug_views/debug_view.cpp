#include "renderer/debug_views/debug_view.h"

#include <algorithm>

#include "renderer/base/error.h"
#include "renderer/registry/registry.h"

namespace lamplighter {
namespace {

const std::vector<DebugViewInfo>& fixedViews() {
  using enum Capability;
  static const std::vector<DebugViewInfo> views = {
      {DebugView::lit, "lit", "Lit", "Alt+1", "The picture as it is."},
      {DebugView::lightOnly, "light_only", "Light only", "Alt+2",
       "The light that arrives, as if every surface were white."},
      {DebugView::direct, "direct", "Direct light", "",
       "Light that comes straight from lights, and what shines itself."},
      {DebugView::indirect, "indirect", "Indirect light", "",
       "Light that bounced on its way; with direct light it is the lit picture."},
      {DebugView::falseColour, "false_colour", "False colour", "",
       "Illuminance in lux or luminance in nits by colours, as the legend says."},
      {DebugView::albedo, "albedo", "Albedo", "Alt+3",
       "What share of the light surfaces reflect, textures included."},
      {DebugView::normals, "normals", "Normals", "Alt+4",
       "Shading normals: x, y, z from -1 to 1 as red, green, blue from 0 to 1."},
      {DebugView::flat, "flat", "Flat", "Alt+5",
       "Surfaces under a lamp at the camera, whatever the level's lights are."},
      {DebugView::patches,
       "patches",
       "Patches",
       "",
       "The pieces of surface for which it is known which lights reach them; grey ones "
       "are boxes around what is not planar.",
       {patches}},
      {DebugView::patchLevels,
       "patch_levels",
       "Patch levels",
       "",
       "How often the patches are halved there: more where many lights are partial.",
       {patches}},
      {DebugView::occlusion,
       "occlusion",
       "Occlusion",
       "",
       "What the geometry says of one light sample on every patch: nothing, something "
       "or everything stands between.",
       {patches, lights}},
      {DebugView::lightOcclusion,
       "light_occlusion",
       "Occlusion of a light",
       "",
       "What share of the chosen light's samples nothing can stand before, on every "
       "patch.",
       {patches, lights}},
      {DebugView::partialLights,
       "partial_lights",
       "Partial lights",
       "",
       "For how many light samples each patch must look up shadow maps.",
       {patches}},
      {DebugView::lightsPerPatch,
       "lights_per_patch",
       "Lights per patch",
       "",
       "How many light samples reach some of each patch.",
       {patches}},
      {DebugView::lightMaps,
       "light_maps",
       "Light maps",
       "",
       "The light maps alone: light without shadows, lines through the texels.",
       {texels}},
      {DebugView::lightMapDensity,
       "light_map_density",
       "Light-map density",
       "",
       "How far apart the texels of light maps are.",
       {texels}},
      {DebugView::mapAge,
       "map_age",
       "Map age",
       "",
       "For how many frames the light that reaches a place has waited to be brought up "
       "to date, on "
       "average.",
       {lights}},
      {DebugView::pendingPatches,
       "pending_patches",
       "Pending patches",
       "",
       "For how many light samples that reach it each patch waits.",
       {patches}},
      {DebugView::shadowMap,
       "shadow_map",
       "Shadow map",
       "",
       "The chosen light sample's shadow map, by the distance of what it holds.",
       {lights}},
      {DebugView::edgeMask, "edge_mask", "Edge mask", "",
       "Where the low-resolution pass may interpolate, and where surfaces make it sum "
       "pixel by pixel."},
      {DebugView::prtObjects,
       "prt_objects",
       "Transfer objects",
       "",
       "Which objects are lit by precomputed transfer.",
       {transfer}},
  };
  return views;
}

// The views of all methods follow the others.
constexpr int kFirstOfMethods = static_cast<int>(DebugView::prtObjects) + 1;

std::vector<DebugViewInfo> allViews() {
  std::vector<DebugViewInfo> all = fixedViews();
  for (const MethodInfo& method : methods()) {
    for (const MethodView& view : method.views) {
      const auto id = static_cast<DebugView>(kFirstOfMethods + static_cast<int>(all.size()) -
                                             static_cast<int>(fixedViews().size()));
      all.push_back({id, view.name, view.label, "", view.help, {}, method.name});
    }
  }
  return all;
}

}  // namespace

std::span<const DebugViewInfo> debugViews() {
  static const std::vector<DebugViewInfo> all = allViews();
  return all;
}

const DebugViewInfo& infoOf(DebugView view) {
  return *std::ranges::find(debugViews(), view, &DebugViewInfo::view);
}

const DebugViewInfo& findDebugView(std::string_view name) {
  const auto views = debugViews();
  const auto found = std::ranges::find(views, name, &DebugViewInfo::name);
  if (found != views.end()) return *found;
  std::string names;
  for (const DebugViewInfo& v : views) names += (names.empty() ? "" : ", ") + v.name;
  throw InputError("view", "'" + std::string(name) + "' is none", "give one of " + names);
}

}  // namespace lamplighter
