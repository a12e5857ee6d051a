#include "renderer/backends/gl/gl_backend.h"

#include "renderer/backends/gl/gl_lighting.h"
#include "renderer/backends/gl/gl_patches.h"
#include "renderer/backends/gl/gl_speculars.h"

namespace lamplighter {
namespace {

class GlBackend final : public Backend {
 public:
  GlBackend(std::unique_ptr<gl::HeadlessContext> context, const std::filesystem::path& shaders)
      : context_(std::move(context)),
        maps_(shaders, vpls_),
        gbuffer_(shaders),
        lighting_(shaders, vpls_),
        speculars_(shaders, vpls_) {
    info_.specularsTakeAllMaps = true;
    info_.name = "gl";
    info_.takesTransfer = true;
    info_.mostLightMapTexels = gl::GlPatches::mostTexels();
    info_.device = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  }

  const BackendInfo& info() const override { return info_; }

  KernelCounts counts() const override {
    KernelCounts counts = counts_;
    counts.mapBytes = maps_.bytes();
    counts.mapsHeld = static_cast<uint64_t>(maps_.held());
    counts.memoryBytes =
        scene_.bytes() + maps_.bytes() + gbuffer_.bytes() + lighting_.bytes() + speculars_.bytes();
    return counts;
  }

  void setScene(const RenderScene& scene, const RenderSceneChanges& changes,
                const RayCaster&) override {
    scene_.update(scene, changes);
  }

  void reserveShadowMaps(int slots, const MapRoom& coarse, const MapRoom& fine) override {
    maps_.reserve(slots, coarse, fine);
  }

  void renderShadowMaps(std::span<const shared::Vpl> vpls, MapSize size) override {
    maps_.render(scene_, vpls, size, vpls_);
    counts_.shadowMaps += vpls.size();
  }

  void dropShadowMaps(std::span<const int> slots) override { maps_.drop(slots); }

  void renderGBuffer(const View& view, vec2 jitter) override {
    gbuffer_.render(scene_, view, jitter);
    lighting_.clear(view.width, view.height);
    speculars_.clear();
  }

  void sumVpls(std::span<const shared::Vpl> vpls, const shared::ShadingParams& params,
               const PatchLights* patches) override {
    lighting_.sum(scene_, gbuffer_, maps_, vpls_, vpls, params, patches);
    speculars_.sum(scene_, gbuffer_, maps_, vpls_, vpls, params, patches);
    counts_.mergedPasses += static_cast<uint64_t>(lighting_.mergedPasses());
    counts_.passesSaved += static_cast<uint64_t>(lighting_.passesSaved());
    counts_.lightPixels +=
        vpls.size() * static_cast<uint64_t>(gbuffer_.width()) * gbuffer_.height();
  }

  std::shared_ptr<RadianceImage> compose(bool white) override {
    auto picture = lighting_.compose(gbuffer_, scene_.scene().sky, white);
    if (!white) speculars_.addTo(*picture, gbuffer_, lighting_.irradiance());
    return picture;
  }

  std::vector<float> readShadowMap(int slot) override { return maps_.read(slot); }
  Image readNormals() override { return gbuffer_.readNormals(); }
  Image readAlbedo() override { return gbuffer_.readAlbedo(); }
  std::vector<uint8_t> readInterpolated() override { return lighting_.readInterpolated(); }
  void finish() override { glFinish(); }

  void reload(const std::filesystem::path& shaders) {
    maps_.reload(shaders, vpls_);
    gbuffer_.reload(shaders);
    lighting_.reload(shaders, vpls_);
    speculars_.reload(shaders, vpls_);
  }

 private:
  // first member, because all others need it until they are destroyed
  std::unique_ptr<gl::HeadlessContext> context_;
  BackendInfo info_;
  KernelCounts counts_;
  gl::VplBuffer vpls_;
  gl::GlScene scene_;
  gl::GlShadowMaps maps_;
  gl::GlGBuffer gbuffer_;
  gl::GlLighting lighting_;
  gl::GlSpeculars speculars_;
};

}  // namespace

std::unique_ptr<Backend> makeGlBackend(const std::filesystem::path& shaders) {
  return makeGlBackend(nullptr, shaders);
}

std::unique_ptr<Backend> makeGlBackend(std::unique_ptr<gl::HeadlessContext> context,
                                       const std::filesystem::path& shaders) {
  return std::make_unique<GlBackend>(std::move(context), shaders);
}

void reloadShaders(Backend& backend, const std::filesystem::path& shaders) {
  if (auto* gl = dynamic_cast<GlBackend*>(&backend)) gl->reload(shaders);
}

}  // namespace lamplighter
