// The kernels behind which a backend stands (docs/design/architecture.md): everything that touches
// each pixel or texel, twice implemented (cpu/, gl/). Whoever calls them decides what to compute
// and does not know which one runs.
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

// A frame's picture, wherever it lies. A GL backend keeps it in a texture and reads it back once,
// on the first call of pixels().
class RadianceImage {
 public:
  virtual ~RadianceImage() = default;
  virtual int width() const = 0;
  virtual int height() const = 0;
  virtual const Image& pixels() = 0;  // linear radiance [W/(m² sr)]
};

// A picture that is in main memory already.
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
  bool tracesShadowMaps = false;      // by a ray a texel
  bool takesTransfer = false;         // PatchLights with light by precomputed transfer
  bool specularsTakeAllMaps = false;  // lights on glossy pixels are looked up wherever they are
  uint64_t mostLightMapTexels = UINT64_MAX;  // that PatchLights may have
};

// Counts of work since the backend was made.
struct KernelCounts {
  uint64_t shadowMaps = 0;   // maps rendered
  uint64_t rays = 0;         // traced by the backend (cpu)
  uint64_t lightPixels = 0;  // VPL × pixel sums
  uint64_t lookUps = 0;      // of those, with a look-up in a shadow map (cpu; in packets of pixels)
  // Merged passes (gl, where they are asked for): drawn, and fewer than object by object.
  uint64_t mergedPasses = 0, passesSaved = 0;
  uint64_t pixelsInterpolated = 0;  // by the low-resolution pass (cpu)
  uint64_t memoryBytes = 0;         // held now: maps, G-buffer, scene copies
  uint64_t mapBytes = 0;            // of these, shadow maps
  uint64_t mapsHeld = 0;            // so many
};

// A shadow map is coarse while things change, and fine once nothing else is left to do.
enum class MapSize : uint8_t { coarse, fine };

// Room for so many shadow maps of resolution² texels at a time.
struct MapRoom {
  int resolution = 0, maps = 0;
  bool operator==(const MapRoom&) const = default;
};

class Backend {
 public:
  virtual ~Backend() = default;
  virtual const BackendInfo& info() const = 0;
  virtual KernelCounts counts() const = 0;

  // Takes in what changed in the scene. `rays` is up to date already; only cpu uses it. Both must
  // outlive the next call of any kernel.
  virtual void setScene(const RenderScene& scene, const RenderSceneChanges& changes,
                        const RayCaster& rays) = 0;

  // Makes room for VPLs of `slots` slots with shadow maps of either size; all are lost when any of
  // the numbers changes. Throws InputError when the device can't hold so many.
  virtual void reserveShadowMaps(int slots, const MapRoom& coarse, const MapRoom& fine) = 0;
  void reserveShadowMaps(int slots, int resolution, int maps) {
    reserveShadowMaps(slots, {resolution, maps}, {});
  }
  void reserveShadowMaps(int slots, int resolution) { reserveShadowMaps(slots, resolution, slots); }

  // Renders the octahedral hemisphere shadow map of each VPL for the slot in its intensity.w
  // (directional: an orthographic map of the scene), which then has one of this size alone. Slots
  // are distinct. No more maps are held afterwards than were reserved: that is for the caller to
  // see to.
  virtual void renderShadowMaps(std::span<const shared::Vpl> vpls, MapSize size) = 0;
  void renderShadowMaps(std::span<const shared::Vpl> vpls) {
    renderShadowMaps(vpls, MapSize::coarse);
  }
  // Gives back the memory of these slots' maps, if they have any.
  virtual void dropShadowMaps(std::span<const int> slots) = 0;

  // Primary visibility of the view into the G-buffer; `jitter` moves the sample within the pixel,
  // in pixels from its middle.
  virtual void renderGBuffer(const View& view, vec2 jitter) = 0;

  // E at each G-buffer pixel: the sum over the VPLs, with shadows, into the irradiance image.
  // `patches`, if any, says by the VPLs' slots how the pixels of each patch come by each light, and
  // whose map each looks up; null: every VPL with its shadow map at every pixel.
  virtual void sumVpls(std::span<const shared::Vpl> vpls, const shared::ShadingParams& params,
                       const PatchLights* patches) = 0;

  // Le + ρ/π · E, and the sky where nothing was hit. `white`: with ρ = 1, so that it is the light
  // alone.
  virtual std::shared_ptr<RadianceImage> compose(bool white) = 0;
  std::shared_ptr<RadianceImage> compose() { return compose(false); }

  // What a shadow map holds (resolution² of its size, 1/w), for tests and views; empty: the slot
  // has none.
  virtual std::vector<float> readShadowMap(int slot) = 0;
  // The G-buffer's world-space shading normals, albedo: for tests and views.
  virtual Image readNormals() = 0;
  virtual Image readAlbedo() = 0;

  // By pixel of the last sum, row after row, whether its light was interpolated by the
  // low-resolution pass (1) or summed (0); empty: there was no such pass. For views.
  virtual std::vector<uint8_t> readInterpolated() { return {}; }

  // Waits until all submitted work is done, so that a clock around it measures it.
  virtual void finish() = 0;
};

}  // namespace lamplighter
