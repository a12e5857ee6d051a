#include "renderer/backends/cpu/cpu_backend.h"

#include <algorithm>

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include "renderer/backends/cpu/adaptive_antialiasing.h"
#include "renderer/backends/cpu/composition.h"
#include "renderer/backends/cpu/gbuffer/gbuffer.h"
#include "renderer/backends/cpu/irradiance/irradiance_accumulator.h"
#include "renderer/backends/cpu/irradiance/specular_accumulator.h"
#include "renderer/backends/cpu/low_resolution.h"
#include "renderer/backends/cpu/shadow_maps/map_store.h"
#include "renderer/backends/image_pool.h"
#include "shaders/shared/low_resolution.h"

namespace lamplighter {
namespace {

// The G-buffer of a view and its light.
struct Picture {
  cpu::GBuffer gbuffer;
  View view;  // of the G-buffer
  vec2 jitter{0.0f};
  // At the pixels of `gbuffer`; with blocks, only in cells that are not interpolated.
  cpu::IrradianceAccumulator sums;
  int block = 1;  // pixels per block of the last sum
  cpu::LowResolution low;
  // At the samples of `low`; in quick pictures, without the samples interpolated by `lowSamples`.
  cpu::IrradianceAccumulator sampleSums;
  cpu::LowResolution lowSamples;          // quick pictures: samples of the samples of `low`
  cpu::IrradianceAccumulator coarseSums;  // at the samples of `lowSamples`; summed from scratch
  cpu::SpecularAccumulator speculars;
  vec3 eye{0.0f};

  template <typename F>
  void forEachSums(F&& f) {
    f(sums);
    f(sampleSums);
    f(coarseSums);
  }
  cpu::PictureLight light() const { return {sums, block == 1 ? nullptr : &low, nullptr, {}}; }
  size_t bytes() const {
    return gbuffer.bytes() + sums.bytes() + low.bytes() + sampleSums.bytes() + lowSamples.bytes() +
           coarseSums.bytes() + speculars.bytes();
  }
};

class CpuBackend final : public Backend {
 public:
  CpuBackend() {
    still_.forEachSums([](cpu::IrradianceAccumulator& sums) { sums.cacheShadowMasks(); });
  }

  const BackendInfo& info() const override { return info_; }

  KernelCounts counts() const override {
    KernelCounts counts = counts_;
    counts.mapsHeld = maps_.held();
    counts.mapBytes = maps_.bytes();
    counts.memoryBytes = counts.mapBytes;
    for (const Picture* p : {&still_, &shifted_}) counts.memoryBytes += p->bytes();
    return counts;
  }

  void setScene(const RenderScene& scene, const RenderSceneChanges& changes,
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
    if (changes.rebuilt || changes.materials) {
      stillIsKnown_ = false;
      for (Picture* p : {&still_, &shifted_}) {
        p->forEachSums([](cpu::IrradianceAccumulator& sums) { sums.forgetPlaces(); });
        p->speculars.forgetPlaces();
      }
      return;
    }
    moves_.insert(moves_.end(), changes.movedBounds.begin(), changes.movedBounds.end());
    for (const uint32_t i : changes.movedObjects) moves_.push_back(scene.objects[i].bounds);
  }

  void reserveShadowMaps(int slots, const MapRoom& coarse, const MapRoom& fine) override {
    if (!maps_.reserve(slots, coarse, fine)) return;
    for (Picture* p : {&still_, &shifted_}) {
      p->forEachSums([](cpu::IrradianceAccumulator& sums) { sums.forgetMaps(); });
      p->speculars.mapsChange();
    }
  }

  void renderShadowMaps(std::span<const shared::Vpl> vpls, MapSize size) override {
    shifted_.forEachSums([](cpu::IrradianceAccumulator& sums) { sums.forgetMaps(); });
    for (Picture* p : {&still_, &shifted_}) p->speculars.mapsChange();
    const auto slotOf = [](const shared::Vpl& vpl) { return vpl.slot; };
    const auto tellOfOld = [&](cpu::IrradianceAccumulator& sums) {
      for (const shared::Vpl& vpl : vpls)
        if (const auto map = maps_.map(slotOf(vpl)); !map.empty())
          sums.mapChanges(slotOf(vpl), map);
    };
    tbb::parallel_invoke([&] { tellOfOld(still_.sums); }, [&] { tellOfOld(still_.sampleSums); });
    std::vector<cpu::ShadowMapDiff> changes(vpls.size());
    counts_.rays += maps_.render(*scene_, *rays_, vpls, size, changes);
    counts_.shadowMaps += vpls.size();
    still_.forEachSums([&](cpu::IrradianceAccumulator& sums) {
      for (size_t i = 0; i < vpls.size(); ++i) sums.mapChanged(slotOf(vpls[i]), changes[i]);
    });
  }

  void dropShadowMaps(std::span<const int> slots) override {
    for (const int slot : slots) {
      const std::span<const float> map = maps_.map(slot);
      if (map.empty()) continue;
      still_.forEachSums([&](cpu::IrradianceAccumulator& sums) { sums.mapChanges(slot, map); });
      shifted_.forEachSums([](cpu::IrradianceAccumulator& sums) { sums.forgetMaps(); });
      for (Picture* p : {&still_, &shifted_}) p->speculars.mapsChange();
      maps_.drop(slot);
    }
  }

  // The picture without jitter is kept, and traced again only where something moved.
  void renderGBuffer(const View& view, vec2 jitter) override {
    const bool isStill = jitter == vec2(0.0f);
    shown_ = isStill ? &still_ : &shifted_;
    shown_->eye = view.eye;
    if (isStill && stillIsKnown_ && view == stillView_) {
      counts_.rays += cpu::updateGBuffer(*scene_, *rays_, view, moves_, still_.gbuffer);
    } else {
      counts_.rays += cpu::renderGBuffer(*scene_, *rays_, view, jitter, shown_->gbuffer);
    }
    shown_->view = view;
    shown_->jitter = jitter;
    if (!isStill) return;
    stillIsKnown_ = true;
    stillView_ = view;
    moves_.clear();
  }

  void sumVpls(std::span<const shared::Vpl> vpls, const shared::ShadingParams& params,
               const PatchLights* patches) override {
    std::vector<cpu::LightRecord> lights;
    lights.reserve(vpls.size());
    for (const shared::Vpl& vpl : vpls) {
      const int slot = vpl.slot;
      const int mapSlot = patches == nullptr || slot < 0 ? slot : patches->mapSlot(slot);
      lights.push_back(cpu::makeLightRecord(vpl, mapOf(mapSlot), maps_.resolution(mapSlot)));
      lights.back().mapSlot = mapSlot;
    }
    const float d0 = params.clampAndBias.x;
    const cpu::SumConstants constants{d0 * d0, params.clampAndBias.y, 1.0f};
    const auto update = [&](cpu::IrradianceAccumulator& sums, const cpu::GBuffer& gbuffer,
                            std::span<const uint32_t> wanted) {
      const cpu::SumCounts counts =
          sums.update(gbuffer, lights, constants, patches, wanted, leftOutBy_);
      counts_.lookUps += counts.lookUps;
      counts_.lightPixels += counts.lightPixels;
    };
    Picture& p = *shown_;
    if (params.speculars.x == 0.0f) {
      p.speculars.clear();
    } else {
      std::vector<cpu::SpecularLight> speculars;
      speculars.reserve(vpls.size());
      for (size_t i = 0; i < vpls.size(); ++i)
        speculars.push_back({lights[i], vpls[i].footprint.x});
      counts_.lightPixels += p.speculars.update(*scene_, p.gbuffer, p.eye, std::move(speculars),
                                                constants, params.speculars.y, patches);
    }
    p.block = std::max(1, static_cast<int>(params.block.x));
    shared_ = {};
    if (shown_ == &still_) sharing_.forget();
    if (p.block != 1 && isStillOf(lights, constants, patches)) {
      if (!sharing_.isTaken()) sharing_.take(still_.gbuffer, still_.light());
      shared_ = sharing_.findOwn(still_.gbuffer, shifted_.gbuffer);
      counts_.pixelsInterpolated += still_.low.pixelsInterpolated();
      update(p.sums, p.gbuffer, shared_);
      return;
    }
    if (p.block == 1) {
      update(p.sums, p.gbuffer, {});
      return;
    }
    p.low.update(p.gbuffer, p.block, leftOutBy_);
    if (params.block.y != 0.0f) {
      p.lowSamples.update(p.low.samples(), shared::kSampleBlock, leftOutBy_);
      update(p.coarseSums, p.lowSamples.samples(), {});
      p.lowSamples.findEdges(p.low.samples(), {p.coarseSums});
      p.coarseSums.forgetMaps();
      update(p.sampleSums, p.low.samples(), p.lowSamples.edges());
      p.low.findEdges(p.gbuffer, {p.sampleSums, &p.lowSamples});
    } else {
      update(p.sampleSums, p.low.samples(), {});
      p.low.findEdges(p.gbuffer, {p.sampleSums});
    }
    counts_.pixelsInterpolated += p.low.pixelsInterpolated();
    update(p.sums, p.gbuffer, p.low.edges());
  }

  std::shared_ptr<RadianceImage> compose(bool white) override {
    const Picture& p = *shown_;
    const auto image = images_.take(p.gbuffer.width, p.gbuffer.height);
    const cpu::Background background{scene_->sky, p.view, p.jitter};
    const cpu::PictureLight still = still_.light();
    const cpu::PictureLight light =
        shared_.empty() ? p.light() : cpu::PictureLight{p.sums, nullptr, &still, shared_};
    cpu::compose(p.gbuffer, light, background, white, image->image);
    if (!white) p.speculars.addTo(p.gbuffer, image->image);
    return image;
  }

  std::vector<float> readShadowMap(int slot) override {
    const std::span<const float> map = maps_.map(slot);
    return {map.begin(), map.end()};
  }

  Image readNormals() override {
    const cpu::GBuffer& g = shown_->gbuffer;
    return makeImage([&](size_t i) { return vec3(g.sx[i], g.sy[i], g.sz[i]); });
  }

  Image readAlbedo() override {
    const cpu::GBuffer& g = shown_->gbuffer;
    return makeImage([&](size_t i) { return g.hit[i] ? g.albedo(i) : vec3(0.0f); });
  }

  std::vector<uint8_t> readInterpolated() override {
    const Picture& p = shared_.empty() ? *shown_ : still_;
    const cpu::GBuffer& g = p.gbuffer;
    if (p.block <= 1) return {};
    std::vector<uint8_t> interpolated;
    interpolated.reserve(static_cast<size_t>(g.width) * static_cast<size_t>(g.height));
    for (int y = 0; y < g.height; ++y) {
      for (int x = 0; x < g.width; ++x) {
        const size_t packet = g.index(x, y) / cpu::kLanes;
        const uint32_t edges = p.low.edges()[packet / cpu::kPacketsPerTile];
        interpolated.push_back((edges >> packet % cpu::kPacketsPerTile & 1) == 0 ? 1 : 0);
      }
    }
    return interpolated;
  }

  void finish() override {}

 private:
  // Whether the light of the unjittered picture is valid for these arguments.
  bool isStillOf(std::span<const cpu::LightRecord> lights, const cpu::SumConstants& constants,
                 const PatchLights* patches) const {
    return shown_ == &shifted_ && stillIsKnown_ && moves_.empty() && stillView_ == shifted_.view &&
           still_.block == shifted_.block &&
           still_.sums.isOf(still_.gbuffer, lights, constants, patches);
  }

  // Null: the slot has no map.
  const float* mapOf(int slot) const {
    const std::span<const float> map = maps_.map(slot);
    return map.empty() ? nullptr : map.data();
  }

  // An image of f(index into the G-buffer) for each pixel.
  template <typename F>
  Image makeImage(F&& f) const {
    const cpu::GBuffer& g = shown_->gbuffer;
    Image image(g.width, g.height);
    tbb::parallel_for(0, image.height, [&](int y) {
      for (int x = 0; x < image.width; ++x) image.at(x, y) = f(g.index(x, y));
    });
    return image;
  }

  ImagePool images_;
  BackendInfo info_{.name = "cpu",
                    .device = "x86-64-v3, 8 lanes",
                    .tracesShadowMaps = true,
                    .takesTransfer = true};
  KernelCounts counts_;
  const RenderScene* scene_ = nullptr;
  const RayCaster* rays_ = nullptr;
  cpu::MapStore maps_;
  Picture still_, shifted_;            // without jitter; with jitter for antialiasing
  Picture* shown_ = &still_;           // the picture rendered last
  cpu::AdaptiveAntialiasing sharing_;  // of still_
  std::span<const uint32_t> shared_;   // packets of shown_ that need their own light; empty: all
  bool stillIsKnown_ = false;          // still_ shows stillView_, except for later moves
  View stillView_;
  std::vector<uint32_t> leftOutBy_;  // by object, with light linking; else empty
  std::vector<Bounds> moves_;        // bounds before and after of objects that moved since
};

}  // namespace

std::unique_ptr<Backend> makeCpuBackend() { return std::make_unique<CpuBackend>(); }

}  // namespace lamplighter
