#include "renderer/backends/cpu/many_lights/cpu_many_lights.h"

#include <algorithm>

#include <tbb/parallel_invoke.h>

#include "renderer/backends/cpu/composition.h"
#include "renderer/backends/cpu/irradiance/irradiance_accumulator.h"
#include "renderer/backends/cpu/irradiance/specular_accumulator.h"
#include "renderer/backends/cpu/many_lights/adaptive_antialiasing.h"
#include "renderer/backends/cpu/many_lights/low_resolution.h"
#include "renderer/backends/cpu/shadow_maps/map_store.h"
#include "shaders/shared/low_resolution.h"

namespace lamplighter::cpu {
namespace {

// The light of a picture of the backend.
struct Light {
  // At the pixels of the G-buffer; with blocks, only in cells that are not interpolated.
  IrradianceAccumulator sums;
  int block = 1;  // pixels per block of the last sum
  LowResolution low;
  // At the samples of `low`; in quick pictures, without the samples interpolated by `lowSamples`.
  IrradianceAccumulator sampleSums;
  LowResolution lowSamples;          // quick pictures: samples of the samples of `low`
  IrradianceAccumulator coarseSums;  // at the samples of `lowSamples`; summed from scratch
  SpecularAccumulator speculars;

  template <typename F>
  void forEachSums(F&& f) {
    f(sums);
    f(sampleSums);
    f(coarseSums);
  }
  PictureLight diffuse() const { return {sums, block == 1 ? nullptr : &low, nullptr, {}}; }
  size_t bytes() const {
    return sums.bytes() + low.bytes() + sampleSums.bytes() + lowSamples.bytes() +
           coarseSums.bytes() + speculars.bytes();
  }
};

class CpuManyLights final : public ManyLightsKernels {
 public:
  explicit CpuManyLights(CpuBackend& backend) : backend_(backend) {
    still_.forEachSums([](IrradianceAccumulator& sums) { sums.cacheShadowMasks(); });
  }

  const ManyLightsTraits& traits() const override { return traits_; }

  ManyLightsCounts lightCounts() const override {
    ManyLightsCounts counts = counts_;
    counts.mapsHeld = maps_.held();
    counts.mapBytes = maps_.bytes();
    return counts;
  }

  BackendCounts counts() const override {
    return {rayCount_, maps_.bytes() + still_.bytes() + shifted_.bytes()};
  }

  void takeScene(const RenderScene& scene, const RenderSceneChanges& changes,
                 const RayCaster& rays) override {
    const bool isOther = changes.rebuilt || scene_ != &scene;
    scene_ = &scene;
    rays_ = &rays;
    if (isOther || changes.rebuilt || changes.materials)
      maps_.castersChange();
    else
      maps_.castersMove(scene, changes);
    if (isOther) {
      leftOutBy_.clear();
      for (const RenderObject& o : scene.objects)
        if (scene.hasLinks) leftOutBy_.push_back(o.leftOutBy);
    }
    if (!changes.rebuilt && !changes.materials) return;
    for (Light* light : {&still_, &shifted_}) {
      light->forEachSums([](IrradianceAccumulator& sums) { sums.forgetPlaces(); });
      light->speculars.forgetPlaces();
    }
  }

  void reserveShadowMaps(int slots, const MapRoom& coarse, const MapRoom& fine) override {
    if (!maps_.reserve(slots, coarse, fine)) return;
    for (Light* light : {&still_, &shifted_}) {
      light->forEachSums([](IrradianceAccumulator& sums) { sums.forgetMaps(); });
      light->speculars.forgetMaps();
    }
  }

  void renderShadowMaps(std::span<const shared::Vpl> vpls, MapSize size) override {
    shifted_.forEachSums([](IrradianceAccumulator& sums) { sums.forgetMaps(); });
    shifted_.speculars.forgetMaps();
    const auto slotOf = [](const shared::Vpl& vpl) { return vpl.slot; };
    const auto tellOfOld = [&](auto& sums) {
      for (const shared::Vpl& vpl : vpls)
        if (const auto map = maps_.map(slotOf(vpl)); !map.empty())
          sums.mapChanges(slotOf(vpl), map);
    };
    tbb::parallel_invoke([&] { tellOfOld(still_.sums); }, [&] { tellOfOld(still_.sampleSums); },
                         [&] { tellOfOld(still_.speculars); });
    std::vector<ShadowMapDiff> changes(vpls.size());
    rayCount_ += maps_.render(*scene_, *rays_, vpls, size, changes);
    counts_.shadowMaps += vpls.size();
    still_.forEachSums([&](IrradianceAccumulator& sums) {
      for (size_t i = 0; i < vpls.size(); ++i) sums.mapChanged(slotOf(vpls[i]), changes[i]);
    });
  }

  void dropShadowMaps(std::span<const int> slots) override {
    for (const int slot : slots) {
      const std::span<const float> map = maps_.map(slot);
      if (map.empty()) continue;
      still_.forEachSums([&](IrradianceAccumulator& sums) { sums.mapChanges(slot, map); });
      shifted_.forEachSums([](IrradianceAccumulator& sums) { sums.forgetMaps(); });
      still_.speculars.mapChanges(slot, map);
      shifted_.speculars.forgetMaps();
      maps_.drop(slot);
    }
  }

  void sumVpls(std::span<const shared::Vpl> vpls, const shared::ShadingParams& params,
               const PatchLights* patches) override {
    std::vector<LightRecord> lights;
    lights.reserve(vpls.size());
    for (const shared::Vpl& vpl : vpls) {
      const int slot = vpl.slot;
      const int mapSlot = patches == nullptr || slot < 0 ? slot : patches->mapSlot(slot);
      lights.push_back(makeLightRecord(vpl, mapOf(mapSlot), maps_.resolution(mapSlot)));
      lights.back().mapSlot = mapSlot;
    }
    const float d0 = params.clampAndBias.x;
    const SumConstants constants{d0 * d0, params.clampAndBias.y, 1.0f};
    const auto update = [&](IrradianceAccumulator& sums, const GBuffer& points,
                            std::span<const uint32_t> wanted) {
      const SumCounts counts = sums.update(points, lights, constants, patches, wanted, leftOutBy_);
      counts_.lookUps += counts.lookUps;
      counts_.lightPixels += counts.lightPixels;
    };
    const GBuffer& gbuffer = backend_.shown().gbuffer;
    Light& p = shown();
    if (params.speculars.x == 0.0f) {
      p.speculars.clear();
    } else {
      std::vector<SpecularLight> speculars;
      speculars.reserve(vpls.size());
      for (size_t i = 0; i < vpls.size(); ++i)
        speculars.push_back({lights[i], vpls[i].footprint.x});
      counts_.lightPixels += p.speculars.update(*scene_, gbuffer, backend_.shown().view.eye,
                                                std::move(speculars), constants, params.speculars.y,
                                                patches, showsStill() && params.block.y == 0.0f);
    }
    p.block = std::max(1, static_cast<int>(params.block.x));
    shared_ = {};
    if (showsStill()) sharing_.forget();
    if (p.block != 1 && isStillOf(lights, constants, patches)) {
      if (!sharing_.isTaken()) sharing_.take(backend_.still().gbuffer, still_.diffuse());
      shared_ = sharing_.findOwn(backend_.still().gbuffer, backend_.shifted().gbuffer);
      counts_.pixelsInterpolated += still_.low.pixelsInterpolated();
      update(p.sums, gbuffer, shared_);
      return;
    }
    if (p.block == 1) {
      update(p.sums, gbuffer, {});
      return;
    }
    p.low.update(gbuffer, p.block, leftOutBy_);
    if (params.block.y != 0.0f) {
      p.lowSamples.update(p.low.samples(), shared::kSampleBlock, leftOutBy_);
      update(p.coarseSums, p.lowSamples.samples(), {});
      p.lowSamples.findEdges(p.low.samples(), {p.coarseSums});
      p.coarseSums.forgetMaps();
      update(p.sampleSums, p.low.samples(), p.lowSamples.edges());
      p.low.findEdges(gbuffer, {p.sampleSums, &p.lowSamples});
    } else {
      update(p.sampleSums, p.low.samples(), {});
      p.low.findEdges(gbuffer, {p.sampleSums});
    }
    counts_.pixelsInterpolated += p.low.pixelsInterpolated();
    update(p.sums, gbuffer, p.low.edges());
  }

  std::shared_ptr<RadianceImage> compose(bool white) override {
    const GBuffer& gbuffer = backend_.shown().gbuffer;
    const Light& p = shown();
    const auto image = backend_.takeImage();
    const PictureLight still = still_.diffuse();
    const PictureLight light =
        shared_.empty() ? p.diffuse() : PictureLight{p.sums, nullptr, &still, shared_};
    const auto lightAt = [&](int tile, int packet, PacketIrradiance& room) {
      return light.at(tile, packet, room);
    };
    cpu::compose(gbuffer, lightAt, backend_.background(), white, image->image);
    if (!white) p.speculars.addTo(gbuffer, image->image);
    return image;
  }

  std::vector<float> readShadowMap(int slot) override {
    const std::span<const float> map = maps_.map(slot);
    return {map.begin(), map.end()};
  }

  std::vector<uint8_t> readInterpolated() override {
    const Light& p = shared_.empty() ? shown() : still_;
    const GBuffer& g = (shared_.empty() ? backend_.shown() : backend_.still()).gbuffer;
    if (p.block <= 1) return {};
    std::vector<uint8_t> interpolated;
    interpolated.reserve(static_cast<size_t>(g.width) * static_cast<size_t>(g.height));
    for (int y = 0; y < g.height; ++y) {
      for (int x = 0; x < g.width; ++x) {
        const size_t packet = g.index(x, y) / kLanes;
        const uint32_t edges = p.low.edges()[packet / kPacketsPerTile];
        interpolated.push_back((edges >> packet % kPacketsPerTile & 1) == 0 ? 1 : 0);
      }
    }
    return interpolated;
  }

 private:
  bool showsStill() const { return &backend_.shown() == &backend_.still(); }
  Light& shown() { return showsStill() ? still_ : shifted_; }

  // Whether the light of the unjittered picture is valid for these arguments.
  bool isStillOf(std::span<const LightRecord> lights, const SumConstants& constants,
                 const PatchLights* patches) const {
    return !showsStill() && backend_.stillIsCurrent() && still_.block == shifted_.block &&
           still_.sums.isOf(backend_.still().gbuffer, lights, constants, patches);
  }

  // Null: the slot has no map.
  const float* mapOf(int slot) const {
    const std::span<const float> map = maps_.map(slot);
    return map.empty() ? nullptr : map.data();
  }

  CpuBackend& backend_;
  const ManyLightsTraits traits_{.tracesShadowMaps = true};
  ManyLightsCounts counts_;
  uint64_t rayCount_ = 0;
  const RenderScene* scene_ = nullptr;
  const RayCaster* rays_ = nullptr;
  MapStore maps_;
  Light still_, shifted_;             // of the pictures of the backend
  AdaptiveAntialiasing sharing_;      // of still_
  std::span<const uint32_t> shared_;  // packets shown that need their own light; empty: all
  std::vector<uint32_t> leftOutBy_;   // by object, with light linking; else empty
};

}  // namespace

std::unique_ptr<ManyLightsKernels> makeManyLightsKernels(CpuBackend& backend) {
  return std::make_unique<CpuManyLights>(backend);
}

}  // namespace lamplighter::cpu
