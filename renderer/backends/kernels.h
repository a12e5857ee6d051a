// The interface of a backend (docs/design/architecture.md): the kernels, that is, everything that
// processes each pixel or texel. It has two implementations (cpu/, gl/). The caller decides what to
// compute and does not know which backend runs.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "renderer/image/image.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

class PatchLights;

// The picture of a frame, in any memory. The gl backend keeps it in a texture and reads it back
// once, on the first call of pixels().
class RadianceImage {
 public:
  virtual ~RadianceImage() = default;
  virtual int width() const = 0;
  virtual int height() const = 0;
  virtual const Image& pixels() = 0;  // linear radiance [W/(m² sr)]
};

// A picture in main memory.
class HostImage final : public RadianceImage {
 public:
  explicit HostImage(Image image) : image_(std::move(image)) {}
  int width() const override { return image_.width; }
  int height() const override { return image_.height; }
  const Image& pixels() override { return image_; }

 private:
  Image image_;
};

struct BackendInfo {
  std::string name;                   // "cpu" or "gl"
  std::string device;                 // GL renderer string, or the instruction set
  bool tracesShadowMaps = false;      // one ray per texel
  bool takesTransfer = false;         // supports PatchLights with precomputed radiance transfer
  bool specularsTakeAllMaps = false;  // glossy pixels need the shadow maps of all lights
  uint64_t mostLightMapTexels = UINT64_MAX;  // upper bound of texels in PatchLights
};

// Counters since construction.
struct KernelCounts {
  uint64_t shadowMaps = 0;   // maps rendered
  uint64_t rays = 0;         // traced by the backend (cpu)
  uint64_t lightPixels = 0;  // VPL × pixel sums
  uint64_t lookUps = 0;      // of these, with a shadow map look-up (cpu; counted in whole packets)
  // Merged passes (gl, if enabled): the number drawn, and the number saved compared with one by
  // one.
  uint64_t mergedPasses = 0, passesSaved = 0;
  uint64_t pixelsInterpolated = 0;  // by the low-resolution pass (cpu)
  uint64_t memoryBytes = 0;         // memory in use: maps, G-buffer, scene copies
  uint64_t mapBytes = 0;            // of this, shadow maps
  uint64_t mapsHeld = 0;            // number of shadow maps in memory
};

// Shadow maps are coarse while things change; they become fine when nothing else is pending.
enum class MapSize : uint8_t { coarse, fine };

// Room for a number of shadow maps with resolution² texels each.
struct MapRoom {
  int resolution = 0, maps = 0;
  bool operator==(const MapRoom&) const = default;
};

class Backend {
 public:
  virtual ~Backend() = default;
  virtual const BackendInfo& info() const = 0;
  virtual KernelCounts counts() const = 0;

  // Applies the changes of the scene. `rays` is already up to date; only cpu uses it. Both must
  // outlive the next call of any kernel.
  virtual void setScene(const RenderScene& scene, const RenderSceneChanges& changes,
                        const RayCaster& rays) = 0;

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

  // Renders the primary visibility of the view into the G-buffer; `jitter` is the position of the
  // sample in the pixel, in pixels from its middle.
  virtual void renderGBuffer(const View& view, vec2 jitter) = 0;

  // Sums E at each G-buffer pixel over the VPLs, with shadows, into the irradiance image.
  // `patches`: the shadow mode of each light on each patch, by slot, and the map that each light
  // uses; null: every VPL with its shadow map at every pixel.
  virtual void sumVpls(std::span<const shared::Vpl> vpls, const shared::ShadingParams& params,
                       const PatchLights* patches) = 0;

  // Le + ρ/π · E, and the sky where nothing was hit. `white`: with ρ = 1, which shows only the
  // light.
  virtual std::shared_ptr<RadianceImage> compose(bool white) = 0;
  std::shared_ptr<RadianceImage> compose() { return compose(false); }

  // The content of a shadow map (resolution² texels of its size, 1/w), for tests and debug views;
  // empty: the slot has no map.
  virtual std::vector<float> readShadowMap(int slot) = 0;
  // The world-space shading normals and the albedo of the G-buffer, for tests and debug views.
  virtual Image readNormals() = 0;
  virtual Image readAlbedo() = 0;

  // By pixel of the last sum, row by row: 1 if the low-resolution pass interpolated it, 0 if it was
  // summed. Empty: there was no such pass. For debug views.
  virtual std::vector<uint8_t> readInterpolated() { return {}; }

  // Waits until all submitted work is done, for time measurements.
  virtual void finish() = 0;
};

}  // namespace lamplighter
