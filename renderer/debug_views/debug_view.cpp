#include "renderer/debug_views/debug_view.h"

#include <algorithm>
#include <array>

#include "renderer/base/error.h"

namespace lamplighter {
namespace {

constexpr std::array kViews = {
    DebugViewInfo{DebugView::lit, "lit", "Lit", "Alt+1", "The picture as it is."},
    DebugViewInfo{DebugView::lightOnly, "light_only", "Light only", "Alt+2",
                  "Incident light: the picture with a white albedo on every surface."},
    DebugViewInfo{DebugView::direct, "direct", "Direct light", "",
                  "Direct illumination only, and the emission of surfaces."},
    DebugViewInfo{
        DebugView::indirect, "indirect", "Indirect light", "",
        "Indirect illumination only. The sum with the view Direct light is the lit picture."},
    DebugViewInfo{DebugView::falseColour, "false_colour", "False colour", "",
                  "Illuminance in lux or luminance in nits in false colour, with a legend."},
    DebugViewInfo{DebugView::albedo, "albedo", "Albedo", "Alt+3",
                  "The albedo of surfaces, textures included."},
    DebugViewInfo{DebugView::normals, "normals", "Normals", "Alt+4",
                  "Shading normals: x, y, z from -1 to 1 as red, green, blue from 0 to 1."},
    DebugViewInfo{DebugView::flat, "flat", "Flat", "Alt+5",
                  "Surfaces lit by a lamp at the camera instead of the level's lights."},
    DebugViewInfo{DebugView::patches, "patches", "Patches", "",
                  "The surface patches for which the visibility of each light is stored. Grey ones "
                  "are bounding boxes of non-planar geometry."},
    DebugViewInfo{
        DebugView::patchLevels, "patch_levels", "Patch levels", "",
        "The subdivision level of patches: higher where many lights are partially occluded."},
    DebugViewInfo{DebugView::occlusion, "occlusion", "Occlusion", "",
                  "The visibility of one light sample from every patch: visible, partially "
                  "occluded or occluded."},
    DebugViewInfo{
        DebugView::lightOcclusion, "light_occlusion", "Occlusion of a light", "",
        "For every patch, the fraction of the chosen light's samples that are surely unoccluded."},
    DebugViewInfo{DebugView::partialLights, "partial_lights", "Partial lights", "",
                  "The number of light samples that need a shadow map lookup, for every patch."},
    DebugViewInfo{DebugView::lightsPerPatch, "lights_per_patch", "Lights per patch", "",
                  "The number of light samples that reach a part of each patch."},
    DebugViewInfo{DebugView::lightMaps, "light_maps", "Light maps", "",
                  "The light maps alone: unshadowed light, with a grid of their texels."},
    DebugViewInfo{DebugView::lightMapDensity, "light_map_density", "Light-map density", "",
                  "The distance between texels of light maps, on the surface."},
    DebugViewInfo{
        DebugView::mapAge, "map_age", "Map age", "",
        "The mean number of frames since the light samples that reach a point were updated."},
    DebugViewInfo{
        DebugView::pendingPatches, "pending_patches", "Pending patches", "",
        "For every patch, the number of light samples that reach it and are not updated yet."},
    DebugViewInfo{DebugView::shadowMap, "shadow_map", "Shadow map", "",
                  "The shadow map of the chosen light sample, coloured by distance."},
    DebugViewInfo{DebugView::edgeMask, "edge_mask", "Edge mask", "",
                  "Where the low-resolution pass interpolates, and where geometric edges need a "
                  "sum at every pixel."},
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
