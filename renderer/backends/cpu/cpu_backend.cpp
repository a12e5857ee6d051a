#include "renderer/backends/cpu/cpu_backend.h"

#include <algorithm>
#include <atomic>
#include <new>

#include <tbb/parallel_for.h>

#include "renderer/backends/cpu/gbuffer.h"
#include "renderer/backends/cpu/shadow_maps.h"
#include "renderer/backends/cpu/sum_vpls.h"
#include "renderer/error.h"

namespace lamplighter {
namespace {

// Rows of a shadow map that are one task: enough rays to be worth it, and fixed, so that what is
// computed does not depend on the number of threads.
constexpr int kRowsPerTask = 32;

// Tiles that are summed together, so that each shadow map is fetched from memory once for all.
constexpr int kTilesPerTask = 16;

class CpuBackend final : public Backend {
 public:
  const BackendInfo& info() const override { return info_; }

  KernelCounts counts() const override {
    KernelCounts counts = counts_;
    counts.memoryBytes =
        maps_.size() * sizeof(float) + gbuffer_.bytes() + 3 * irradiance_.r.size() * sizeof(float);
    return counts;
  }

  void setScene(const RenderScene& scene, const RenderSceneChanges&,
                const RayCaster& rays) override {
    scene_ = &scene;
    rays_ = &rays;
  }

  void reserveShadowMaps(int slots, int resolution) override {
    if (slots == slots_ && resolution == resolution_) return;
    const size_t texels = static_cast<size_t>(slots) * resolution * resolution;
    try {
      // Free first: both would not fit where one does.
      std::vector<float>().swap(maps_);
      slots_ = 0;
      maps_.assign(texels, 0.0f);
    } catch (const std::bad_alloc&) {
      throw InputError("many_lights",
                       "no memory for " + std::to_string(slots) + " shadow maps of " +
                           std::to_string(resolution) + "² texels",
                       "lower vpls or map_resolution");
    }
    slots_ = slots;
    resolution_ = resolution;
  }

  void renderShadowMaps(std::span<const shared::Vpl> vpls) override {
    const int tasks = (resolution_ + kRowsPerTask - 1) / kRowsPerTask;
    tbb::parallel_for(0, static_cast<int>(vpls.size()) * tasks, [&](int task) {
      const shared::Vpl& vpl = vpls[task / tasks];
      const int firstRow = (task % tasks) * kRowsPerTask;
      const int lastRow = std::min(firstRow + kRowsPerTask, resolution_);
      cpu::traceShadowMap(*rays_, vpl, resolution_, firstRow, lastRow,
                          {mapOf(vpl), static_cast<size_t>(resolution_) * resolution_});
    });
    counts_.shadowMaps += vpls.size();
    counts_.rays += vpls.size() * static_cast<uint64_t>(resolution_) * resolution_;
  }

  void renderGBuffer(const View& view, vec2 jitter) override {
    counts_.rays += cpu::renderGBuffer(*scene_, *rays_, view, jitter, gbuffer_);
    for (auto* v : {&irradiance_.r, &irradiance_.g, &irradiance_.b}) {
      v->assign(gbuffer_.px.size(), 0.0f);
    }
  }

  void sumVpls(std::span<const shared::Vpl> vpls, const shared::ShadingParams& params,
               const PatchLights* patches) override {
    std::vector<cpu::LightRecord> lights;
    lights.reserve(vpls.size());
    for (const shared::Vpl& vpl : vpls) {
      lights.push_back(cpu::makeLightRecord(vpl, vpl.intensity.w < 0.0f ? nullptr : mapOf(vpl)));
    }
    const float d0 = params.clampAndBias.x;
    const cpu::SumConstants constants{d0 * d0, params.clampAndBias.y, resolution_};
    std::atomic<uint64_t> lookUps = 0;
    const int tasks = (gbuffer_.tiles() + kTilesPerTask - 1) / kTilesPerTask;
    tbb::parallel_for(0, tasks, [&](int task) {
      const int first = task * kTilesPerTask;
      const int last = std::min(first + kTilesPerTask, gbuffer_.tiles());
      lookUps += cpu::sumTiles(gbuffer_, first, last, lights, constants, patches, irradiance_);
    });
    counts_.lookUps += lookUps;
    counts_.lightPixels += vpls.size() * static_cast<uint64_t>(gbuffer_.width) * gbuffer_.height;
  }

  std::shared_ptr<RadianceImage> compose(bool white) override {
    Image image(gbuffer_.width, gbuffer_.height);
    const vec3 sky = scene_->sky;
    forEachPixel(image, [&](size_t i) {
      if (!gbuffer_.hit[i]) return sky;
      const vec3 e(irradiance_.r[i], irradiance_.g[i], irradiance_.b[i]);
      const vec3 albedo = white ? vec3(1.0f) : gbuffer_.albedo[i];
      return gbuffer_.emission[i] + albedo * (1.0f / kPi) * e;
    });
    return std::make_shared<HostImage>(std::move(image));
  }

  std::vector<float> readShadowMap(int slot) override {
    const size_t texels = static_cast<size_t>(resolution_) * resolution_;
    const auto first = maps_.begin() + static_cast<ptrdiff_t>(texels * slot);
    return {first, first + static_cast<ptrdiff_t>(texels)};
  }

  Image readNormals() override {
    Image image(gbuffer_.width, gbuffer_.height);
    forEachPixel(image,
                 [&](size_t i) { return vec3(gbuffer_.sx[i], gbuffer_.sy[i], gbuffer_.sz[i]); });
    return image;
  }

  Image readAlbedo() override {
    Image image(gbuffer_.width, gbuffer_.height);
    forEachPixel(image,
                 [&](size_t i) { return gbuffer_.hit[i] ? gbuffer_.albedo[i] : vec3(0.0f); });
    return image;
  }

  void finish() override {}

 private:
  float* mapOf(const shared::Vpl& vpl) {
    return &maps_[static_cast<size_t>(vpl.intensity.w) * resolution_ * resolution_];
  }

  template <typename F>
  void forEachPixel(Image& image, F&& value) const {
    tbb::parallel_for(0, image.height, [&](int y) {
      for (int x = 0; x < image.width; ++x) image.at(x, y) = value(gbuffer_.index(x, y));
    });
  }

  BackendInfo info_{"cpu", "x86-64-v3, 8 lanes", true};
  KernelCounts counts_;
  const RenderScene* scene_ = nullptr;
  const RayCaster* rays_ = nullptr;
  int slots_ = 0, resolution_ = 0;
  std::vector<float> maps_;  // slot after slot, row after row
  cpu::GBuffer gbuffer_;
  cpu::Irradiance irradiance_;
};

}  // namespace

std::unique_ptr<Backend> makeCpuBackend() { return std::make_unique<CpuBackend>(); }

}  // namespace lamplighter
