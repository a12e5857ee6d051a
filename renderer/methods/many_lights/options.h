// The parameters of the method in the form that its stages use.
#pragma once

#include "renderer/methods/imperfect_light/parameters.h"
#include "renderer/methods/many_lights/live_lights.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/methods/many_lights/refinement.h"
#include "renderer/prt/prt_lights.h"

namespace lamplighter {

// Read once per frame. Parameters that have no effect are set to the value that disables them, so
// that two options are equal if the picture and the work are equal.
struct ManyLightsOptions : ManyLightsParameters {
  // `refines`: the caller has time for refinement. `onProcessor`: the backend renders there.
  ManyLightsOptions(const Settings& settings, bool refines, bool onProcessor,
                    const RenderScene& scene);
  ManyLightsOptions() = default;

  // The chosen carrier of bounced light and the reason, if the choice is automatic; otherwise
  // empty.
  std::string carrierReason;
  // The direct light of emissive surfaces is computed elsewhere.
  bool withoutSurfaces = false;
  // Bounces of light that is stored on surface elements; 0: none. `bounces` is for light samples.
  int meshBounces = 0;
  // Bounces of light along links of texels; 0: none.
  int linkBounces = 0;
  bool useLinks() const { return linkBounces > 0; }
  // Bounces of light in a light field; 0: none.
  int fieldBounces = 0;
  // The field also carries the light of the sky without suns.
  bool useField() const { return indirect == ManyLightsIndirect::field; }
  // Bounces of light by samples with imperfect shadow maps; 0: none.
  int imperfectBounces = 0;
  bool useImperfect() const { return imperfectBounces > 0; }
  ImperfectParameters imperfect() const;
  // Light on surface elements includes that of the sky without suns.
  bool useMeshes() const { return indirect == ManyLightsIndirect::meshes; }

  bool useVisibility() const { return technique != ManyLightsTechnique::naive; }
  bool useLightMaps() const { return technique == ManyLightsTechnique::lightMaps; }
  // Disables everything that needs the visibility database, as in naive.
  void forgoVisibility();

  // The options for sums of light.
  const LightSumParameters& lightSums() const { return *this; }
  VplCounts counts() const;
  RefreshBudget budget() const;  // per frame
  PrtLights::Options transfer() const;
  Refinement::Options refinement() const;
  size_t visibilityBytes() const { return bytesOf(visibilityMemory); }
  size_t lightMapBytes() const { return bytesOf(lightMapMemory); }
  size_t shareBytes() const { return bytesOf(shareMemory); }

  // The map sizes for a number of slots. Fine maps have the largest resolution at which each slot
  // could have one within the memory limit, in addition to its coarse map.
  struct MapRooms {
    MapRoom coarse, fine;
    int scale() const { return fine.maps == 0 ? 1 : fine.resolution / coarse.resolution; }
    bool operator==(const MapRooms&) const = default;
  };
  MapRooms mapRooms(int slots) const;
  int mostMaps() const;  // coarse maps in memory, including those of refinement

 private:
  void choose(bool onProcessor, const RenderScene& scene);
  static size_t bytesOf(int mebibytes) { return static_cast<size_t>(mebibytes) << 20; }
};

}  // namespace lamplighter
