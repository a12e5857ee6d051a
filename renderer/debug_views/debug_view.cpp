#include "renderer/debug_views/debug_view.h"

#include <algorithm>
#include <array>

#include "renderer/base/error.h"

namespace lamplighter {
namespace {

constexpr std::array kViews = {
    DebugViewInfo{DebugView::lit, "lit", "Lit", "Alt+1", "The picture as it is."},
    DebugViewInfo{DebugView::lightOnly, "light_only", "Light only", "Alt+2",
                  "The light that arrives, as if every surface were white."},
    DebugViewInfo{DebugView::direct, "direct", "Direct light", "",
                  "Light that comes straight from lights, and what shines itself."},
    DebugViewInfo{DebugView::indirect, "indirect", "Indirect light", "",
                  "Light that bounced on its way; with direct light it is the lit picture."},
    DebugViewInfo{DebugView::falseColour, "false_colour", "False colour", "",
                  "Illuminance in lux or luminance in nits by colours, as the legend says."},
    DebugViewInfo{DebugView::albedo, "albedo", "Albedo", "Alt+3",
                  "What share of the light surfaces reflect, textures included."},
    DebugViewInfo{DebugView::normals, "normals", "Normals", "Alt+4",
                  "Shading normals: x, y, z from -1 to 1 as red, green, blue from 0 to 1."},
    DebugViewInfo{DebugView::flat, "flat", "Flat", "Alt+5",
                  "Surfaces under a lamp at the camera, whatever the level's lights are."},
    DebugViewInfo{DebugView::patches, "patches", "Patches", "",
                  "The pieces of surface for which it is known which lights reach them; grey ones "
                  "are boxes around what is not planar."},
    DebugViewInfo{DebugView::patchLevels, "patch_levels", "Patch levels", "",
                  "How often the patches are halved there: more where many lights are partial."},
    DebugViewInfo{DebugView::occlusion, "occlusion", "Occlusion", "",
                  "What the geometry says of one light sample on every patch: nothing, something "
                  "or everything stands between."},
    DebugViewInfo{DebugView::lightOcclusion, "light_occlusion", "Occlusion of a light", "",
                  "What share of the chosen light's samples nothing can stand before, on every "
                  "patch."},
    DebugViewInfo{DebugView::partialLights, "partial_lights", "Partial lights", "",
                  "For how many light samples each patch must look up shadow maps."},
    DebugViewInfo{DebugView::lightsPerPatch, "lights_per_patch", "Lights per patch", "",
                  "How many light samples reach some of each patch."},
    DebugViewInfo{DebugView::lightMaps, "light_maps", "Light maps", "",
                  "The light maps alone: light without shadows, lines through the texels."},
    DebugViewInfo{DebugView::lightMapDensity, "light_map_density", "Light-map density", "",
                  "How far apart the texels of light maps are."},
    DebugViewInfo{DebugView::mapAge, "map_age", "Map age", "",
                  "For how many frames the light that reaches a place has waited to be brought up "
                  "to date, on "
                  "average."},
    DebugViewInfo{DebugView::pendingPatches, "pending_patches", "Pending patches", "",
                  "For how many light samples that reach it each patch waits."},
    DebugViewInfo{DebugView::shadowMap, "shadow_map", "Shadow map", "",
                  "The chosen light sample's shadow map, by the distance of what it holds."},
    DebugViewInfo{DebugView::edgeMask, "edge_mask", "Edge mask", "",
                  "Where the low-resolution pass may interpolate, and where surfaces make it sum "
                  "pixel by pixel."},
    DebugViewInfo{DebugView::prtObjects, "prt_objects", "Transfer objects", "",
                  "Which objects are lit by precomputed transfer."},
};

}  // namespace

std::span<const DebugViewInfo> debugViews() { return kViews; }

const DebugViewInfo& infoOf(DebugView view) {
  return *std::find_if(kViews.begin(), kViews.end(),
                       [&](const DebugViewInfo& v) { return v.view == view; });
}

const DebugViewInfo& findDebugView(std::string_view name) {
  const auto found = std::find_if(kViews.begin(), kViews.end(),
                                  [&](const DebugViewInfo& v) { return v.name == name; });
  if (found != kViews.end()) return *found;
  std::string names;
  for (const DebugViewInfo& v : kViews) names += (names.empty() ? "" : ", ") + std::string(v.name);
  throw InputError("view", "'" + std::string(name) + "' is none", "give one of " + names);
}

}  // namespace lamplighter
