#include "renderer/debug_views/debug_view.h"

#include <algorithm>

#include "renderer/base/error.h"
#include "renderer/debug_views/debug_views.h"
#include "renderer/registry/registry.h"

namespace lamplighter {
namespace {

const std::vector<DebugViewInfo>& fixedViews() {
  using enum Capability;
  using Needs = std::vector<Capability>;
  const Needs ofPatches{patches}, ofLights{lights}, ofPatchesAndLights{patches, lights},
      ofTexels{texels}, ofElements{elements}, ofTransfer{transfer};
  static const std::vector<DebugViewInfo> views = {
      {DebugView::lit, "lit", "Lit", "Alt+1", "The picture as it is lit."},
      {DebugView::lightOnly, "light_only", "Light only", "Alt+2",
       "Incident light: the picture with a white albedo on every surface."},
      {DebugView::direct, "direct", "Direct light", "",
       "Direct illumination only, and the emission of surfaces."},
      {DebugView::indirect, "indirect", "Indirect light", "",
       "Indirect illumination only. The sum with the view Direct light is the lit picture."},
      {DebugView::falseColour, "false_colour", "False colour", "",
       "Illuminance in lux or luminance in nits in false colour, with a legend.",
       views::falseColour},
      {DebugView::albedo, "albedo", "Albedo", "Alt+3", "The albedo of surfaces, textures included.",
       views::albedo},
      {DebugView::normals, "normals", "Normals", "Alt+4",
       "Shading normals: x, y, z from -1 to 1 as red, green, blue from 0 to 1.", views::normals},
      {DebugView::flat, "flat", "Flat", "Alt+5",
       "Surfaces lit by a lamp at the camera instead of the level's lights.", views::flat},
      {DebugView::patches, "patches", "Patches", "",
       "The surface patches for which the visibility of each light is stored. Grey ones are "
       "bounding boxes of non-planar geometry.",
       views::patches, ofPatches},
      {DebugView::patchLevels, "patch_levels", "Patch levels", "",
       "The subdivision level of patches: higher where many lights are partially occluded.",
       views::patchLevels, ofPatches},
      {DebugView::occlusion, "occlusion", "Occlusion", "",
       "The visibility of one light sample from every patch: visible, partially occluded or "
       "occluded.",
       views::occlusion, ofPatchesAndLights},
      {DebugView::lightOcclusion, "light_occlusion", "Occlusion of a light", "",
       "For every patch, the fraction of the chosen light's samples that are surely unoccluded.",
       views::lightOcclusion, ofPatchesAndLights},
      {DebugView::partialLights, "partial_lights", "Partial lights", "",
       "The number of light samples that need a shadow map lookup, for every patch.",
       views::partialLights, ofPatches},
      {DebugView::lightsPerPatch, "lights_per_patch", "Lights per patch", "",
       "The number of light samples that reach a part of each patch.", views::lightsPerPatch,
       ofPatches},
      {DebugView::lightMaps, "light_maps", "Light maps", "",
       "The light maps alone: unshadowed light, with a grid of their texels.", views::lightMaps,
       ofTexels},
      {DebugView::lightMapDensity, "light_map_density", "Light-map density", "",
       "The distance between texels of light maps, on the surface.", views::lightMapDensity,
       ofTexels},
      {DebugView::meshEdges, "mesh_edges", "Elements", "",
       "The surface elements at whose corners light is stored. A grey element represents many "
       "small triangles.",
       views::meshEdges, ofElements},
      {DebugView::meshSamples, "mesh_samples", "Light of elements", "",
       "Where pixels show the light of elements, and where the light of records at pixels, while "
       "the camera is still.",
       views::meshSamples, ofElements},
      {DebugView::meshContrast, "mesh_contrast", "Contrast of elements", "",
       "How much the light differs between the corners of each element.", views::meshContrast,
       ofElements},
      {DebugView::meshAge, "mesh_age", "Age of elements", "",
       "The fraction of the rays of each element that are outdated or missing.", views::meshAge,
       ofElements},
      {DebugView::mapAge, "map_age", "Map age", "",
       "The mean number of frames since the light samples that reach a point were updated.",
       views::mapAge, ofLights},
      {DebugView::pendingPatches, "pending_patches", "Pending patches", "",
       "For every patch, the number of light samples that reach it and are not updated yet.",
       views::pendingPatches, ofPatches},
      {DebugView::shadowMap, "shadow_map", "Shadow map", "",
       "The shadow map of the chosen light sample, coloured by distance.", views::shadowMap,
       ofLights},
      {DebugView::edgeMask, "edge_mask", "Edge mask", "",
       "Where the low-resolution pass interpolates, and where geometric edges need a sum at every "
       "pixel.",
       views::edgeMask},
      {DebugView::prtObjects, "prt_objects", "Transfer objects", "",
       "Which objects are lit by precomputed transfer.", views::prtObjects, ofTransfer},
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
      all.push_back({id, view.name, view.label, "", view.help, nullptr, {}, method.name});
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
  throw InputError("view", "there is no view '" + std::string(name) + "'", "give one of " + names);
}

}  // namespace lamplighter
