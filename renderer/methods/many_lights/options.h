// What the method's settings say, as its stages take it.
#pragma once

#include "renderer/base/parameters.h"
#include "renderer/methods/many_lights/live_lights.h"
#include "renderer/methods/many_lights/refinement.h"
#include "renderer/prt/prt_lights.h"

namespace lamplighter {

// Read once a frame. `refines`: the caller has time for it.
struct ManyLightsOptions {
  ManyLightsOptions(const Settings& settings, bool refines);
  ManyLightsOptions() = default;

  // Room for the maps of so many slots: fine ones as fine as memory allows if each slot had one,
  // beside its coarse one.
  struct MapRooms {
    MapRoom coarse, fine;
    int scale() const { return fine.maps == 0 ? 1 : fine.resolution / coarse.resolution; }
    bool operator==(const MapRooms&) const = default;
  };
  MapRooms mapRooms(int slots) const;
  int mostMaps() const;  // coarse ones, held at a time, those of refinement included

  // All that is made of visibility is left out, as in naive.
  void forgoVisibility();

  VplCounts counts;
  int mapResolution = 0;
  int mapScale = 1;     // of fine maps, as wanted
  size_t mapBytes = 0;  // of all maps at most, those of refinement included
  float groupShare = 0.0f;
  RefreshBudget budget;  // a frame
  int mostPaths = 0;     // likewise; 0: no limit
  float clampDistance = 0.0f;
  float shadowBias = 0.0f;
  int antialias = 1;
  bool fillsCorners = false;  // with what the clamp takes away
  bool useVisibility = false;
  size_t visibilityBytes = 0;  // at most
  bool useLightMaps = false;   // besides
  float lightMapTexel = 0.1f;
  size_t lightMapBytes = 0;  // at most
  int lightsPerPass = 0;     // changes no picture
  bool mergePasses = false;
  int block = 1;  // pixels
  bool speculars = false;
  float leastRoughness = 0.1f;
  bool usePrt = false;  // besides
  PrtLights::Options prt;
  Refinement::Options refinement;
};

}  // namespace lamplighter
