// The kernels of many_lights: shadow maps of VPLs, and sums of their light over the G-buffer.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "renderer/backends/method_kernels.h"
#include "renderer/backends/radiance_image.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

class PatchLights;

// How the implementation works, where the method must know.
struct ManyLightsTraits {
  bool tracesShadowMaps = false;             // one ray per texel
  bool specularsTakeAllMaps = false;         // glossy pixels need the shadow maps of all lights
  bool sharesNeedMiddle = false;             // shareOf() needs the pixels without jitter first
  uint64_t mostLightMapTexels = UINT64_MAX;  // upper bound of texels in PatchLights
};

// Counters since construction.
struct ManyLightsCounts {
  uint64_t shadowMaps = 0;   // maps rendered
  uint64_t lightPixels = 0;  // VPL × pixel sums
  uint64_t lookUps = 0;      // of these, with a shadow map look-up (cpu; counted in whole packets)
  // Merged passes (gl, if enabled): the number drawn, and the number saved compared with one by
  // one.
  uint64_t mergedPasses = 0, passesSaved = 0;
  uint64_t pixelsInterpolated = 0;  // by the low-resolution pass (cpu)
  uint64_t bytesUploaded = 0;       // of patches, light maps and light lists, to the GPU (gl)
  uint64_t mapBytes = 0;            // memory of shadow maps
  uint64_t mapsHeld = 0;            // number of shadow maps in memory
};

// Shadow maps are coarse while things change; they become fine when nothing else is pending.
enum class MapSize : uint8_t { coarse, fine };

// Room for a number of shadow maps with resolution² texels each.
struct MapRoom {
  int resolution = 0, maps = 0;
  bool operator==(const MapRoom&) const = default;
};

class ManyLightsKernels : public MethodKernels {
 public:
  virtual const ManyLightsTraits& traits() const = 0;
  virtual ManyLightsCounts lightCounts() const = 0;

  // Reserves `slots` slots and shadow maps of both sizes. If any of these numbers changes, all maps
  // are lost. Throws InputError if the device has too little memory.
  virtual void reserveShadowMaps(int slots, const MapRoom& coarse, const MapRoom& fine) = 0;
  void reserveShadowMaps(int slots, int resolution, int maps) {
    reserveShadowMaps(slots, {resolution, maps}, {});
  }
  void reserveShadowMaps(int slots, int resolution) { reserveShadowMaps(slots, resolution, slots); }

  // Renders the octahedral hemisphere shadow map of each VPL for its slot
  // (directional: an orthographic map of the scene). The slot keeps only the map of this size.
  // Slots must be distinct. The caller makes sure that no more maps exist afterwards than were
  // reserved.
  virtual void renderShadowMaps(std::span<const shared::Vpl> vpls, MapSize size) = 0;
  void renderShadowMaps(std::span<const shared::Vpl> vpls) {
    renderShadowMaps(vpls, MapSize::coarse);
  }
  // Frees the maps of these slots, if they have any.
  virtual void dropShadowMaps(std::span<const int> slots) = 0;

  // Sums E at each G-buffer pixel over the VPLs, with shadows. `patches`: the shadow mode of each
  // light on each patch, by slot, and the map that each light uses; null: every VPL with its shadow
  // map at every pixel.
  virtual void sumVpls(std::span<const shared::Vpl> vpls, const shared::ShadingParams& params,
                       const PatchLights* patches) = 0;

  // Whether the last sum left pixels to later calls, because of ShadingParams::block.z.
  virtual bool sumIsLimited() const { return false; }
  // Whether a sum from scratch would have to do so.
  virtual bool sumIsLong() const { return false; }

  // The picture of the last sum, as Backend::compose() makes it, with its specular light.
  virtual std::shared_ptr<RadianceImage> compose(bool white) = 0;
  std::shared_ptr<RadianceImage> compose() { return compose(false); }

  // Sums the lights of one of several groups, and composes only the light that surfaces reflect:
  // no emission, no sky. The groups of one view are numbered from 0; with sharesNeedMiddle, each of
  // them first at the pixels without jitter. Keeps the sums of sumVpls(), if it keeps any. Null:
  // the limit ShadingParams::block.z was reached; the next call must have the same G-buffer and
  // arguments, with any limit, and goes on.
  virtual std::shared_ptr<RadianceImage> shareOf(size_t group, std::span<const shared::Vpl> vpls,
                                                 const shared::ShadingParams& params,
                                                 const PatchLights* patches, bool white) = 0;
  // Frees what shareOf() keeps. weights: of the groups, if their weighted sum is the light of the
  // view, for pictures of the next views; otherwise empty.
  virtual void dropShares(std::span<const vec3> /*weights*/) {}

  // The content of a shadow map (resolution² texels of its size, 1/w), for tests and debug views;
  // empty: the slot has no map.
  virtual std::vector<float> readShadowMap(int slot) = 0;

  // By pixel of the last sum, row by row: 1 if the low-resolution pass interpolated it, 0 if it was
  // summed. Empty: there was no such pass. For debug views.
  virtual std::vector<uint8_t> readInterpolated() { return {}; }
};

}  // namespace lamplighter
