// The statistics of many_lights.
#pragma once

#include "renderer/methods/common_statistics.h"
#include "renderer/methods/field_light/parameters.h"
#include "renderer/methods/stored_depth_parameters.h"
#include "renderer/methods/surface_light_parameters.h"

namespace lamplighter {

// Numbers of VPLs, unless stated otherwise. Refreshed and pending ones are `updates` and `pending`.
struct ManyLightsStats : SurfaceLightStats, StoredDepthStats, LightFieldStats {
  using LightFieldStats::take;
  using StoredDepthStats::take;
  using SurfaceLightStats::take;

  int vpls = 0;             // shown
  int oldestFrames = 0;     // frames that the oldest pending VPL has waited
  int mapsToSharpen = 0;    // coarse maps that become fine when nothing is pending
  int mapsRendered = 0;     // in this frame, except fine maps
  uint64_t mapRays = 0;     // in this frame: rays of these maps
  int mapsSharpened = 0;    // in this frame: fine maps rendered
  int mapsHeld = 0;         // of shown VPLs
  int mapsWithoutRoom = 0;  // needed maps that do not fit; their VPLs use proxies
  int mapsSpared = 0;  // in this frame: a mover was hidden from the light, so its map stays valid
  // Paths of indirect light in this frame: traced again; of these, the ones that hit something else
  // now; the ones that were kept. And paths that wait.
  int pathsWalked = 0, pathsReplaced = 0, pathsKept = 0, pathsPending = 0;
  int patchesPending = 0;        // roots of patches that wait for entries of the database
  uint64_t visibilityTests = 0;  // in this frame: occlusion pyramids against the scene
  uint64_t lightMapTexels = 0;   // in this frame: texels × lights added or subtracted
  float lightMapTexel = 0.0f;    // texel spacing that memory allows [m]; 0: no light maps
  bool lightMapsWithoutRoom = false;
  // Merged passes of the last sum: the number drawn, and the number saved.
  int mergedPasses = 0, passesSaved = 0;
  // share of pixels that the low-resolution pass interpolated in the last sum
  float interpolatedShare = 0.0f;
  int transfersPending = 0;    // transfers of objects that are being computed
  float transferShare = 1.0f;  // progress of the first of them
  // Objects with transfer; of these, objects whose pixels sum all direct light, because the error
  // of transfer would be too large; lights that pixels sum for this reason, counted once per other
  // object. Then: objects without transfer because memory is short.
  int transferObjects = 0, transferObjectsLeft = 0, transferLightsLeft = 0;
  int transferObjectsWithoutRoom = 0;
  int lightsWithoutShare = 0;  // in the settled picture, because memory is short
  // For a refined picture: number of VPLs in the mean, and the target number.
  int vplsRefined = 0, vplsToRefine = 0;
  uint64_t glUploads = 0;  // in this frame: bytes of patches and lights that went to the GPU
  uint64_t glWaits = 0;    // in this frame: times that the processor waited for the GPU
  // Memory [bytes]; what the visibility database needs if it does not fit and is not used.
  uint64_t mapBytes = 0, visibilityBytes = 0, visibilityBytesNeeded = 0, lightMapBytes = 0,
           transferBytes = 0, shareBytes = 0;
};

const StatisticTable<ManyLightsStats>& manyLightsStatistics();

}  // namespace lamplighter
