#include "renderer/backends/gl/many_lights/gl_many_lights.h"

#include "renderer/backends/gl/many_lights/gl_lighting.h"
#include "renderer/backends/gl/many_lights/gl_patches.h"
#include "renderer/backends/gl/many_lights/gl_speculars.h"

namespace lamplighter::gl {
namespace {

class GlManyLights final : public ManyLightsKernels {
 public:
  explicit GlManyLights(GlBackend& backend)
      : backend_(backend),
        maps_(backend.shaders(), vpls_),
        lighting_(backend.shaders(), vpls_),
        speculars_(backend.shaders(), vpls_) {}

  const ManyLightsTraits& traits() const override { return traits_; }

  ManyLightsCounts lightCounts() const override {
    ManyLightsCounts counts = counts_;
    counts.mapBytes = maps_.bytes();
    counts.mapsHeld = static_cast<uint64_t>(maps_.held());
    counts.bytesUploaded = lighting_.uploaded();
    return counts;
  }

  BackendCounts counts() const override {
    return {0, maps_.bytes() + lighting_.bytes() + speculars_.bytes()};
  }

  // The backend has the only copy of the scene.
  void takeScene(const RenderScene&, const RenderSceneChanges&, const RayCaster&) override {}

  void takeGBuffer() override {
    lighting_.clear(backend_.gbuffer().width(), backend_.gbuffer().height());
    speculars_.clear();
  }

  void reserveShadowMaps(int slots, const MapRoom& coarse, const MapRoom& fine) override {
    maps_.reserve(slots, coarse, fine);
  }

  void renderShadowMaps(std::span<const shared::Vpl> vpls, MapSize size) override {
    maps_.render(backend_.scene(), vpls, size, vpls_);
    counts_.shadowMaps += vpls.size();
  }

  void dropShadowMaps(std::span<const int> slots) override { maps_.drop(slots); }

  void sumVpls(std::span<const shared::Vpl> vpls, const shared::ShadingParams& params,
               const PatchLights* patches) override {
    const GlGBuffer& gbuffer = backend_.gbuffer();
    lighting_.sum(backend_.scene(), gbuffer, maps_, vpls_, vpls, params, patches);
    speculars_.sum(backend_.scene(), gbuffer, maps_, vpls_, vpls, params, patches);
    counts_.mergedPasses += static_cast<uint64_t>(lighting_.mergedPasses());
    counts_.passesSaved += static_cast<uint64_t>(lighting_.passesSaved());
    counts_.lightPixels += vpls.size() * static_cast<uint64_t>(gbuffer.width()) * gbuffer.height();
  }

  std::shared_ptr<RadianceImage> compose(bool white) override { return compose(white, true); }

  std::shared_ptr<RadianceImage> shareOf(size_t, std::span<const shared::Vpl> vpls,
                                         const shared::ShadingParams& params,
                                         const PatchLights* patches, bool white) override {
    sumVpls(vpls, params, patches);
    return compose(white, false);
  }

  std::vector<float> readShadowMap(int slot) override { return maps_.read(backend_.waits(), slot); }
  std::vector<uint8_t> readInterpolated() override {
    return lighting_.readInterpolated(backend_.waits());
  }

  void reloadShaders(const std::filesystem::path& folder) override {
    maps_.reload(folder, vpls_);
    lighting_.reload(folder, vpls_);
    speculars_.reload(folder, vpls_);
  }

 private:
  std::shared_ptr<RadianceImage> compose(bool white, bool withEmission) {
    auto picture = backend_.compose(lighting_.irradiance(), white, withEmission);
    if (!white) speculars_.addTo(*picture, backend_.gbuffer(), lighting_.irradiance());
    return picture;
  }

  GlBackend& backend_;
  const ManyLightsTraits traits_{.specularsTakeAllMaps = true,
                                 .mostLightMapTexels = GlPatches::mostTexels()};
  ManyLightsCounts counts_;
  VplBuffer vpls_;
  GlShadowMaps maps_;
  GlLighting lighting_;
  GlSpeculars speculars_;
};

}  // namespace

std::unique_ptr<ManyLightsKernels> makeManyLightsKernels(GlBackend& backend) {
  return std::make_unique<GlManyLights>(backend);
}

}  // namespace lamplighter::gl
