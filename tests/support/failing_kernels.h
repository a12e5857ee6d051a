// Kernels of many_lights on the cpu backend that fail when a test wants it.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "renderer/backends/cpu/many_lights/cpu_many_lights.h"

namespace lamplighter::test {

// Called before the kernels do the work of that name. They may throw.
struct KernelHooks {
  std::function<void(const MapRoom& coarse)> reserve = [](const MapRoom&) {};
  std::function<void()> compose = [] {};
};

class FailingKernels final : public ManyLightsKernels {
 public:
  FailingKernels(std::unique_ptr<ManyLightsKernels> inner, std::shared_ptr<const KernelHooks> hooks)
      : inner_(std::move(inner)), hooks_(std::move(hooks)) {}

  void takeScene(const RenderScene& scene, const RenderSceneChanges& changes,
                 const RayCaster& rays) override {
    inner_->takeScene(scene, changes, rays);
  }
  void takeGBuffer() override { inner_->takeGBuffer(); }
  BackendCounts counts() const override { return inner_->counts(); }
  const ManyLightsTraits& traits() const override { return inner_->traits(); }
  ManyLightsCounts lightCounts() const override { return inner_->lightCounts(); }
  void reserveShadowMaps(int slots, const MapRoom& coarse, const MapRoom& fine) override {
    hooks_->reserve(coarse);
    inner_->reserveShadowMaps(slots, coarse, fine);
  }
  void dropShadowMaps(std::span<const int> slots) override { inner_->dropShadowMaps(slots); }
  void renderShadowMaps(std::span<const shared::Vpl> vpls, MapSize size) override {
    inner_->renderShadowMaps(vpls, size);
  }
  void sumVpls(std::span<const shared::Vpl> vpls, const shared::ShadingParams& params,
               const PatchLights* patches) override {
    inner_->sumVpls(vpls, params, patches);
  }
  std::shared_ptr<RadianceImage> compose(bool white) override {
    hooks_->compose();
    return inner_->compose(white);
  }
  std::shared_ptr<RadianceImage> shareOf(size_t group, std::span<const shared::Vpl> vpls,
                                         const shared::ShadingParams& params,
                                         const PatchLights* patches, bool white) override {
    return inner_->shareOf(group, vpls, params, patches, white);
  }
  void dropShares(std::span<const vec3> weights) override { inner_->dropShares(weights); }
  std::vector<float> readShadowMap(int slot) override { return inner_->readShadowMap(slot); }

 private:
  std::unique_ptr<ManyLightsKernels> inner_;
  std::shared_ptr<const KernelHooks> hooks_;
};

// The cpu backend with these kernels.
inline std::unique_ptr<Backend> failingBackend(std::shared_ptr<const KernelHooks> hooks) {
  auto backend = std::make_unique<cpu::CpuBackend>();
  backend->offer<ManyLightsKernels>([b = backend.get(), hooks = std::move(hooks)] {
    return std::make_unique<FailingKernels>(cpu::makeManyLightsKernels(*b), hooks);
  });
  return backend;
}

// The same under the name of the gl backend.
class FailingGl final : public Backend {
 public:
  explicit FailingGl(std::shared_ptr<const KernelHooks> hooks) {
    offer<ManyLightsKernels>([this, hooks = std::move(hooks)] {
      return std::make_unique<FailingKernels>(cpu::makeManyLightsKernels(inner_), hooks);
    });
  }
  ~FailingGl() override { dropKernels(); }

  const BackendInfo& info() const override { return info_; }
  void finish() override {}
  GBufferView hostGBuffer() override { return inner_.hostGBuffer(); }
  Image readNormals() override { return inner_.readNormals(); }
  Image readAlbedo() override { return inner_.readAlbedo(); }
  std::shared_ptr<RadianceImage> compose(const Image& irradiance, bool white) override {
    return inner_.compose(irradiance, white);
  }

 protected:
  BackendCounts ownCounts() const override { return inner_.counts(); }
  void takeScene(const RenderScene& scene, const RenderSceneChanges& changes,
                 const RayCaster& rays) override {
    inner_.setScene(scene, changes, rays);
  }
  void drawGBuffer(const View& view, vec2 jitter) override { inner_.renderGBuffer(view, jitter); }

 private:
  BackendInfo info_{.name = "gl", .device = "a test"};
  cpu::CpuBackend inner_;
};

}  // namespace lamplighter::test
