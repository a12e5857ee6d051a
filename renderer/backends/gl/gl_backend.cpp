#include "renderer/backends/gl/gl_backend.h"

namespace lamplighter {
namespace gl {

GlBackend::GlBackend(std::unique_ptr<HeadlessContext> context, const std::filesystem::path& shaders)
    : context_(std::move(context)),
      shaders_(shaders),
      info_{"gl", reinterpret_cast<const char*>(glGetString(GL_RENDERER))},
      passes_(std::make_shared<PicturePasses>(shaders)),
      gbuffer_(shaders),
      composition_(shaders, passes_) {}

BackendCounts GlBackend::ownCounts() const {
  return {0, scene_.bytes() + gbuffer_.bytes() + composition_.bytes() + hostGBuffer_.bytes(),
          passes_->waits().count()};
}

void GlBackend::takeScene(const RenderScene& scene, const RenderSceneChanges& changes,
                          const RayCaster& rays) {
  scene_.update(scene, changes);
  rays_ = &rays;
  hostIsCurrent_ = false;
}

void GlBackend::drawGBuffer(const View& view, vec2 jitter) {
  hostIsCurrent_ = false;
  gbuffer_.render(scene_, view, jitter);
}

GBufferView GlBackend::hostGBuffer() {
  if (!hostIsCurrent_) {
    cpu::renderGBuffer(scene_.scene(), *rays_, gbuffer_.view(), gbuffer_.jitter(), hostGBuffer_);
    hostIsCurrent_ = true;
  }
  return GBufferView(hostGBuffer_);
}

std::shared_ptr<RadianceImage> GlBackend::multiplied(const std::shared_ptr<RadianceImage>& picture,
                                                     const std::shared_ptr<const Image>& gains) {
  const auto* texture = dynamic_cast<const RadianceTexture*>(picture.get());
  if (texture == nullptr) return Backend::multiplied(picture, gains);
  return composition_.multiplied(*texture, gains);
}

std::shared_ptr<RadianceImage> GlBackend::difference(const std::shared_ptr<RadianceImage>& picture,
                                                     const std::shared_ptr<RadianceImage>& taken) {
  const auto* from = dynamic_cast<const RadianceTexture*>(picture.get());
  const auto* less = dynamic_cast<const RadianceTexture*>(taken.get());
  if (from == nullptr || less == nullptr) return Backend::difference(picture, taken);
  return composition_.difference(*from, *less);
}

void GlBackend::reload(const std::filesystem::path& shaders) {
  gbuffer_.reload(shaders);
  composition_.reload(shaders);
  passes_->reload(shaders);
  forEachKernels([&](MethodKernels& kernels) { kernels.reloadShaders(shaders); });
  shaders_ = shaders;
}

}  // namespace gl

std::unique_ptr<Backend> makeGlBackend(const std::filesystem::path& shaders) {
  return makeGlBackend(nullptr, shaders);
}

std::unique_ptr<Backend> makeGlBackend(std::unique_ptr<gl::HeadlessContext> context,
                                       const std::filesystem::path& shaders) {
  auto backend = std::make_unique<gl::GlBackend>(std::move(context), shaders);
  gl::offerKernels(*backend);
  return backend;
}

void reloadShaders(Backend& backend, const std::filesystem::path& shaders) {
  if (auto* gl = dynamic_cast<gl::GlBackend*>(&backend)) gl->reload(shaders);
}

}  // namespace lamplighter
