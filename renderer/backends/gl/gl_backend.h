// The gl backend: rasterised G-buffer and full-screen passes. OpenGL 4.5 core without vendor
// extensions.
#pragma once

#include <filesystem>
#include <memory>

#include "renderer/backends/backend.h"
#include "renderer/backends/gbuffer_view.h"
#include "renderer/backends/gl/gl_composition.h"
#include "renderer/backends/gl/gl_gbuffer.h"
#include "renderer/gl/debug.h"
#include "renderer/gl/headless_context.h"
#include "renderer/gl/shader_source.h"
#include "renderer/gl/stage_clock.h"

namespace lamplighter {
namespace gl {

class GlBackend final : public Backend {
 public:
  // `context`: null, or its own context. Throws ShaderError.
  GlBackend(std::unique_ptr<HeadlessContext> context, const std::filesystem::path& shaders);
  ~GlBackend() override { dropKernels(); }

  const BackendInfo& info() const override { return info_; }
  void finish() override { waits().finish(); }
  void checkDevice() override { gl::takeErrors(); }
  GBufferView hostGBuffer() override;
  Image readNormals() override { return gbuffer_.readNormals(waits()); }
  Image readAlbedo() override { return gbuffer_.readAlbedo(waits()); }
  std::shared_ptr<RadianceImage> compose(const Image& irradiance, bool white) override {
    return composition_.compose(gbuffer_, scene_.scene().sky, irradiance, white);
  }
  std::shared_ptr<RadianceImage> multiplied(const std::shared_ptr<RadianceImage>& picture,
                                            const std::shared_ptr<const Image>& gains) override;
  std::shared_ptr<RadianceImage> difference(const std::shared_ptr<RadianceImage>& picture,
                                            const std::shared_ptr<RadianceImage>& taken) override;
  void beginStages() override { stageClock_.begin(); }
  void endStage(size_t stage) override { stageClock_.end(stage); }
  double stageSeconds(size_t stage) const override { return stageClock_.seconds(stage); }

  // For kernels. The textures of the G-buffer are bound by GlGBuffer::bind().
  const GlScene& scene() const { return scene_; }
  const GlGBuffer& gbuffer() const { return gbuffer_; }
  const std::filesystem::path& shaders() const { return shaders_; }  // the folder
  Waits& waits() { return passes_->waits(); }
  // Like compose() above, with E in the RGB of a float texture of the size of the G-buffer.
  // Negative values count as zero. Without emission: only the light that surfaces reflect.
  std::shared_ptr<RadianceTexture> compose(GLuint irradiance, bool white,
                                           bool withEmission = true) {
    return composition_.compose(gbuffer_, scene_.scene().sky, irradiance, white, withEmission);
  }

  // Compiles all shaders again, also those of kernels. If they have errors it throws ShaderError,
  // and what was not compiled yet keeps the previous ones.
  void reload(const std::filesystem::path& shaders);

 protected:
  BackendCounts ownCounts() const override;
  void takeScene(const RenderScene& scene, const RenderSceneChanges& changes,
                 const RayCaster& rays) override;
  void drawGBuffer(const View& view, vec2 jitter) override;

 private:
  // First member, because all others need it until they are destroyed.
  std::unique_ptr<HeadlessContext> context_;
  std::filesystem::path shaders_;
  BackendInfo info_;
  std::shared_ptr<PicturePasses> passes_;  // pictures share it
  StageClock stageClock_;
  GlScene scene_;
  GlGBuffer gbuffer_;
  GlComposition composition_;
  const RayCaster* rays_ = nullptr;
  cpu::GBuffer hostGBuffer_;  // for hostGBuffer()
  bool hostIsCurrent_ = false;
};

// Offers the kernels of all methods: renderer/registry/gl/gl_kernels.cpp, which lists them.
void offerKernels(GlBackend& backend);

}  // namespace gl

// With the kernels of all methods. Needs a current context, now and at each later call, including
// the destruction of the pictures that it returned. Throws gl::ShaderError, as does the first use
// of kernels.
std::unique_ptr<Backend> makeGlBackend(
    const std::filesystem::path& shaders = gl::defaultShaderFolder());

// The same with its own context, which stays current on this thread.
std::unique_ptr<Backend> makeGlBackend(
    std::unique_ptr<gl::HeadlessContext> context,
    const std::filesystem::path& shaders = gl::defaultShaderFolder());

// GlBackend::reload(). Does nothing to other backends.
void reloadShaders(Backend& backend, const std::filesystem::path& shaders);

}  // namespace lamplighter
