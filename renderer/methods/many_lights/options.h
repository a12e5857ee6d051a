// The settings of the method, in the form that its stages use.
#pragma once

#include "renderer/base/parameters.h"
#include "renderer/methods/many_lights/live_lights.h"
#include "renderer/methods/many_lights/refinement.h"
#include "renderer/prt/prt_lights.h"

namespace lamplighter {

// Read once per frame. `refines`: the caller has time for refinement.
struct ManyLightsOptions {
  ManyLightsOptions(const Settings& settings, bool refines);
  ManyLightsOptions() = default;

  // The maps for a number of slots. Fine maps have the largest resolution for which each slot could
  // have one in memory, beside its coarse map.
  struct MapRooms {
    MapRoom coarse, fine;
    int scale() const { return fine.maps == 0 ? 1 : fine.resolution / coarse.resolution; }
    bool operator==(const MapRooms&) const = default;
  };
  MapRooms mapRooms(int slots) const;
  int mostMaps() const;  // coarse maps in memory, including those of refinement

  // Disables everything that needs the visibility database, as in naive.
  void forgoVisibility();

  VplCounts counts;
  int mapResolution = 0;
  int mapScale = 1;     // wanted resolution of fine maps, relative to coarse ones
  size_t mapBytes = 0;  // limit of all maps, including those of refinement
  float groupShare = 0.0f;
  RefreshBudget budget;  // per frame
  int mostPaths = 0;     // per frame; 0: no limit
  float clampDistance = 0.0f;
  float shadowBias = 0.0f;
  int antialias = 1;
  bool fillsCorners = false;  // adds the light that the clamp removes
  bool useVisibility = false;
  size_t visibilityBytes = 0;  // limit
  bool useLightMaps = false;   // in addition to useVisibility
  float lightMapTexel = 0.1f;
  size_t lightMapBytes = 0;  // limit
  int lightsPerPass = 0;     // does not change a picture
  bool mergePasses = false;
  int block = 1;  // pixels
  bool speculars = false;
  float leastRoughness = 0.1f;
  bool usePrt = false;  // in addition to useVisibility
  PrtLights::Options prt;
  Refinement::Options refinement;
};

}  // namespace lamplighter
